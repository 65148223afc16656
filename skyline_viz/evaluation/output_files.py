"""What an evaluation found, for programs: the same files, whatever the number of methods."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections.abc import Mapping
from dataclasses import asdict, fields
from pathlib import Path

from skyline_viz.detector import Detector
from skyline_viz.evaluation.evaluated import Evaluation
from skyline_viz.evaluation.results import PhotoResult, Summary
from skyline_viz.files import write_text
from skyline_viz.method import Method

FILES = ("summary.json", "photos.csv", "histogram.png")
"""Names of the files."""


def write_evaluation(
    folder: str | os.PathLike[str],
    found: Evaluation,
    *,
    about: Mapping[str, object],
    title: str,
) -> None:
    """Write all `FILES`, each whole or not at all.

    Args:
        folder: Where to.
        found: The results.
        about: What they were found on; written before the figures.
        title: Of the histogram.
    """
    from skyline_viz.evaluation.histogram import write_histogram  # noqa: PLC0415  # half a second

    folder = Path(folder)
    write_summary(folder / "summary.json", found, about)
    write_photos(folder / "photos.csv", found)
    write_histogram(folder / "histogram.png", found.results, title)


def write_summary(
    path: str | os.PathLike[str], found: Evaluation, about: Mapping[str, object]
) -> None:
    """Write the figures of each method as JSON; figures that do not exist are null.

    Args:
        path: Where to.
        found: The results.
        about: What they were found on; written before the figures.
    """
    document = {
        **about,
        "folds": found.folds,
        "seed": found.seed,
        "summary": {name: _without_nan(one) for name, one in found.summaries.items()},
        "settings": {name: _settings(one) for name, one in found.methods.items()},
        "failed": [asdict(failure) for failure in found.failures],
    }
    write_text(path, json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def write_photos(path: str | os.PathLike[str], found: Evaluation) -> None:
    """Write a line of CSV for each photo and method; the header names the fields."""
    names = [field.name for field in fields(PhotoResult)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*names, "method"])
    for method, results in found.results.items():
        for result in results:
            writer.writerow([*(_cell(getattr(result, name)) for name in names), method])
    write_text(path, text.getvalue())


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
