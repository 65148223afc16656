"""What an evaluation found, for programs: the same files, whatever the number of methods."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import zipfile
from collections.abc import Mapping
from dataclasses import asdict, fields
from pathlib import Path

import numpy as np

from skyline_viz.detector import Detector
from skyline_viz.evaluation.dealing import SPLIT, write_split
from skyline_viz.evaluation.evaluated import Evaluation
from skyline_viz.evaluation.paired import all_paired
from skyline_viz.evaluation.results import PhotoResult, Summary, mean_interval
from skyline_viz.evaluation.seen import in_titles
from skyline_viz.files import replacing, write_text
from skyline_viz.method import Method

FILES = (
    "summary.json", "photos.csv", "histogram.png", "curves.csv", "curves.png", "column_errors.npz",
)  # fmt: skip
"""Names of the files."""


def write_evaluation(
    folder: str | os.PathLike[str],
    found: Evaluation,
    *,
    about: Mapping[str, object],
    title: str,
    groups: Mapping[str, str] | None = None,
) -> None:
    """Write all `FILES`, each whole or not at all; of a cross-validation its split, too.

    Args:
        folder: Where to.
        found: The results.
        about: What they were found on; written before the figures.
        title: Of the pictures.
        groups: The group of each photo, as `paired` takes it.
    """
    from skyline_viz.evaluation.curves import draw_curves, write_curves  # noqa: PLC0415  # likewise
    from skyline_viz.evaluation.histogram import write_histogram  # noqa: PLC0415  # half a second

    folder = Path(folder)
    seen = in_titles(found.results)
    title = f"{title}\n{seen}" if seen else title
    write_summary(folder / "summary.json", found, about, groups)
    write_photos(folder / "photos.csv", found)
    write_histogram(folder / "histogram.png", found.results, title)
    write_curves(folder / "curves.csv", found.results)
    draw_curves(folder / "curves.png", found.results, title)
    write_errors(folder / "column_errors.npz", found)
    if found.fold_of:
        write_split(folder / SPLIT, found.fold_of)


def write_summary(
    path: str | os.PathLike[str],
    found: Evaluation,
    about: Mapping[str, object],
    groups: Mapping[str, str] | None = None,
) -> None:
    """Write the figures of each method as JSON; figures that do not exist are null.

    Args:
        path: Where to.
        found: The results.
        about: What they were found on; written before the figures.
        groups: The group of each photo, as `paired` takes it.
    """
    document = {
        **about,
        "folds": found.folds,
        "seed": found.seed,
        "summary": {name: _without_nan(one) for name, one in found.summaries.items()},
        "mean_intervals": {
            name: [*mean_interval(results, groups)]
            for name, results in found.results.items()
            if results
        },
        "seen_in_training": {
            name: {one.name: one.seen for one in results if one.seen}
            for name, results in found.results.items()
        },
        "notes": found.notes,
        "compared": [asdict(one) for one in all_paired(found.results, groups) if one.photos],
        "settings": {name: _settings(one) for name, one in found.methods.items()},
        "failed": [asdict(failure) for failure in found.failures],
    }
    write_text(path, json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def write_photos(path: str | os.PathLike[str], found: Evaluation) -> None:
    """Write a line of CSV for each photo and method; the header names the fields."""
    names = [field.name for field in fields(PhotoResult) if field.name != "errors"]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*names, "fold", "method"])
    for method, results in found.results.items():
        for result in results:
            cells = [_cell(getattr(result, name)) for name in names]
            writer.writerow([*cells, found.fold_of.get(result.name, ""), method])
    write_text(path, text.getvalue())


def write_errors(path: str | os.PathLike[str], found: Evaluation) -> None:
    """Write the error of each column as ``.npz``: an array ``METHOD/PHOTO`` for each of both.

    It holds row minus true row of each column, float32 in pixels, NaN where the truth is not
    visible.
    """
    arrays = {
        f"{method}/{result.name}".encode(errors="backslashreplace").decode(): result.errors
        for method, results in found.results.items()
        for result in results
        if result.errors is not None
    }
    with (
        replacing(path) as temporary,
        zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as file,
    ):
        for name, errors in arrays.items():  # numpy's own takes names as Python's arguments
            with file.open(zipfile.ZipInfo(f"{name}.npy"), "w") as array:
                np.lib.format.write_array(array, errors)


def _settings(method: Method) -> dict[str, object]:
    """Settings, bank and sky model, if it runs, of our detector; of another its name says all."""
    if not isinstance(method, Detector):
        return {}
    about = {"config": asdict(method.config), "bank": asdict(method.bank.provenance)}
    return {**about, "sky": method.sky.name if method.config.sky_weight else None}


def _without_nan(summary: Summary) -> dict[str, object]:
    return {
        name: None if isinstance(value, float) and math.isnan(value) else value
        for name, value in asdict(summary).items()
    }


def _cell(value: object) -> str:
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.6g}"
    return str(value)
