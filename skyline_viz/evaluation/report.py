"""What an evaluation found, for people and for programs: table, JSON, CSV and histogram."""

import csv
import io
import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from skyline_viz.arrays import F64
from skyline_viz.evaluation.results import PhotoResult, Summary
from skyline_viz.files import replacing, write_text
from skyline_viz.system.names import cell, printable, shown_in_viewer

if TYPE_CHECKING:
    from rich.table import Table

HISTOGRAM_TOP = 10
"""A_err in pixels from which on photos share the histogram's last bin."""

_GREY = "#595959"
_MAGENTA = "#FF2D95"


def summary_table(summary: Summary) -> "Table":
    """The summary as a table of two columns, for a terminal."""
    from rich.table import Table  # noqa: PLC0415  # not needed for files

    table = Table(show_header=False)
    table.add_column("figure")
    table.add_column("value", justify="right")
    for name, value in _figures(summary):
        table.add_row(name, value)
    return table


def worst_table(results: Sequence[PhotoResult]) -> "Table":
    """Photos and where they went wrong as a table, in the order given."""
    from rich.table import Table  # noqa: PLC0415

    table = Table(title="Worst photos", title_justify="left")
    table.add_column("photo", overflow="fold")
    for heading in ("A_err", "largest error", "in column", "segmentation accuracy"):
        table.add_column(heading, justify="right")
    for one in results:
        table.add_row(
            cell(one.name),
            f"{one.a_err:.2f} px" + (" (gross miss)" if one.gross_miss else ""),
            f"{one.worst_error:.1f} px",
            f"{one.worst_column}",
            f"{one.segmentation_accuracy:.2%}",
        )
    return table


def methods_table(results: Mapping[str, Sequence[PhotoResult]]) -> "Table":
    """A line for each method, for a terminal."""
    from rich.table import Table  # noqa: PLC0415

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("method")
    for heading in (
        "mean",
        "st. dev.",
        "median",
        "min",
        "max",
        "< 4 px",
        "gross",
        "accuracy",
        "ms",
    ):
        table.add_column(heading, justify="right")
    for name, found in results.items():
        if not found:
            table.add_row(cell(name), *["-"] * 9)
            continue
        one = Summary.of(found)
        errors = (one.mean, one.standard_deviation, one.median, one.minimum, one.maximum)
        good = f"{round(one.under_4_px * one.photos)}/{one.photos}"
        table.add_row(
            cell(name),
            *(f"{error:.2f}" for error in errors),
            good,
            f"{one.gross_misses}",
            f"{one.segmentation_accuracy:.2%}",
            f"{1000 * one.seconds:.0f}",
        )
    return table


def write_summary(
    path: str | os.PathLike[str], summary: Summary, about: Mapping[str, object]
) -> None:
    """Write the summary as JSON, whole or not at all; figures that do not exist are null.

    Args:
        path: Where to.
        summary: The figures.
        about: What was evaluated and how; written before the figures.
    """
    document = {**about, "summary": _without_nan(summary)}
    write_text(path, json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def write_comparison(
    folder: Path, results: Mapping[str, Sequence[PhotoResult]], about: Mapping[str, object]
) -> None:
    """Write ``methods.json``, summaries by method, and ``methods.csv``, a line a photo and method.

    Args:
        folder: Where to.
        results: The results of each method.
        about: What was evaluated and how; written before the figures.
    """
    summaries = {name: _without_nan(Summary.of(found)) for name, found in results.items()}
    document = {**about, "methods": summaries}
    text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
    write_text(folder / "methods.json", text + "\n")
    names = [field.name for field in fields(PhotoResult)]
    lines = io.StringIO()
    writer = csv.writer(lines, lineterminator="\n")
    writer.writerow(["method", *names])
    for method, found in results.items():
        writer.writerows([method, *(getattr(one, name) for name in names)] for one in found)
    write_text(folder / "methods.csv", lines.getvalue())


def write_results(path: str | os.PathLike[str], results: Sequence[PhotoResult]) -> None:
    """Write a line of CSV for each photo, whole or not at all; its header names the fields."""
    names = [field.name for field in fields(PhotoResult)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    for result in results:
        values = [getattr(result, name) for name in names]
        writer.writerow([_cell(value) for value in values])
    write_text(path, text.getvalue())


def histogram(results: Sequence[PhotoResult]) -> F64:
    """Share of photos ``(HISTOGRAM_TOP + 1,)`` in bins one pixel of A_err wide; the last is open.

    >>> from skyline_viz.skyline import Skyline
    >>> results = [PhotoResult.of("a", Skyline([9]), Skyline([rows]), 20) for rows in (9, 8, 8)]
    >>> histogram(results)[:3].round(2)
    array([0.33, 0.67, 0.  ])
    """
    bins = [min(int(result.a_err), HISTOGRAM_TOP) for result in results]
    counts = np.bincount(bins, minlength=HISTOGRAM_TOP + 1).astype(np.float64)
    return counts / max(len(results), 1)


def write_histogram(
    path: str | os.PathLike[str], results: Sequence[PhotoResult], title: str
) -> None:
    """Draw the normalised histogram of A_err as a picture, as in the paper's figure 4."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: PLC0415  # half a second
    from matplotlib.figure import Figure  # noqa: PLC0415
    from matplotlib.ticker import PercentFormatter  # noqa: PLC0415

    shares = histogram(results)
    figure = Figure(figsize=(6.4, 3.8), dpi=150, layout="constrained")
    axes = figure.add_subplot()
    bars = axes.bar(np.arange(len(shares)) + 0.5, shares, width=0.9, color=_GREY)
    bars[-1].set_color(_MAGENTA)
    axes.bar_label(
        bars,
        [f"{100 * share:.3g}%" if share else "" for share in shares],
        padding=2,
        fontsize=8,
        color=_GREY,
    )
    axes.set_title(shown_in_viewer(printable(title)), parse_math=False, loc="left", fontsize=11)
    axes.set_xlabel("$A_{err}$ (pixels)")
    axes.set_ylabel("share of photos")
    edges = range(HISTOGRAM_TOP)
    axes.set_xticks([*edges, HISTOGRAM_TOP + 0.5], [*map(str, edges), f"{HISTOGRAM_TOP} or more"])
    axes.tick_params(length=0)
    axes.set_xlim(0, HISTOGRAM_TOP + 1)
    axes.set_ylim(0, max(float(shares.max()) * 1.12, 0.1))
    axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    axes.yaxis.grid(True, color="#E0E0E0", linewidth=0.8)
    axes.set_axisbelow(True)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    with replacing(path) as temporary:
        FigureCanvasAgg(figure).print_figure(temporary)


def _without_nan(summary: Summary) -> dict[str, object]:
    return {
        name: None if isinstance(value, float) and math.isnan(value) else value
        for name, value in asdict(summary).items()
    }


def _figures(summary: Summary) -> list[tuple[str, str]]:
    return [
        ("photos", f"{summary.photos}"),
        ("A_err, mean", f"{summary.mean:.2f} px"),
        ("A_err, standard deviation", f"{summary.standard_deviation:.2f} px"),
        ("A_err, median", f"{summary.median:.2f} px"),
        ("A_err, minimum", f"{summary.minimum:.2f} px"),
        ("A_err, maximum", f"{summary.maximum:.2f} px"),
        ("photos under 4 px", f"{summary.under_4_px:.1%}"),
        ("photos under 5 px", f"{summary.under_5_px:.1%}"),
        ("gross misses (over 5 % of the height)", f"{summary.gross_misses}"),
        ("segmentation accuracy", f"{summary.segmentation_accuracy:.2%}"),
        ("time of a detection, median", f"{summary.seconds:.3f} s"),
    ]


def _cell(value: object) -> str:
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.6g}"
    return str(value)
