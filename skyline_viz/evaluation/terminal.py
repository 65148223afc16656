"""Results of an evaluation as tables, for a terminal and for a notebook."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape

from rich.console import Console, RenderableType
from rich.table import Table

from skyline_viz.evaluation.intervals import Interval, wilson
from skyline_viz.evaluation.results import PhotoResult, Summary
from skyline_viz.system.names import cell, shortened

_HEADINGS = (
    "mean", "st. dev.", "median", "min", "max", "< 4 px", "gross", "accuracy", "ms",
)  # fmt: skip
_CELL = "padding:2px 10px;text-align:"


def summary_table(summary: Summary, interval: Interval | None = None) -> Table:
    """The summary as a table of two columns, with the interval of the mean where it is known."""
    table = Table(show_header=False)
    table.add_column("figure")
    table.add_column("value", justify="right")
    for name, value in _figures(summary, interval):
        table.add_row(name, value)
    return table


def worst_table(results: Sequence[PhotoResult]) -> Table:
    """Photos and where they went wrong as a table, in the order given."""
    table = Table(
        title="Worst photos", title_justify="left", box=None, pad_edge=False, header_style="bold"
    )
    table.add_column("photo", overflow="fold")
    for heading in ("A_err", "gross", "largest", "in column", "accuracy"):
        table.add_column(heading, justify="right", no_wrap=True)
    for one in results:
        table.add_row(
            cell(one.name),
            f"{one.a_err:.2f} px",
            "miss" if one.gross_miss else "",
            f"{one.worst_error:.1f} px",
            f"{one.worst_column}",
            f"{one.segmentation_accuracy:.2%}",
        )
    return table


def methods_table(results: Mapping[str, Sequence[PhotoResult]]) -> Table:
    """A line for each method; errors are in pixels."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("method")
    for heading in _HEADINGS:
        table.add_column(heading, justify="right")
    for name, found in results.items():
        table.add_row(cell(name), *_line(found))
    return table


def methods_html(results: Mapping[str, Sequence[PhotoResult]], notes: Sequence[str] = ()) -> str:
    """`methods_table` as HTML, and sentences below it."""
    head = "".join(
        f'<th style="{_CELL}{"right" if place else "left"}">{escape(heading)}</th>'
        for place, heading in enumerate(("method", *_HEADINGS))
    )
    rows = [
        f'<tr><td style="{_CELL}left">{escape(shortened(name))}</td>'
        + "".join(f'<td style="{_CELL}right">{escape(text)}</td>' for text in _line(found))
        + "</tr>"
        for name, found in results.items()
    ]
    below = "".join(f"<div>{escape(note)}</div>" for note in notes)
    return f"<table><tr>{head}</tr>{''.join(rows)}</table>{below}"


def drawn(table: RenderableType, width: int) -> str:
    """What rich draws, as plain text of so many columns."""
    console = Console(width=width, highlight=False, color_system=None)
    with console.capture() as captured:
        console.print(table)
    return "\n".join(line.rstrip() for line in captured.get().rstrip("\n").splitlines())


def _line(results: Sequence[PhotoResult]) -> list[str]:
    if not results:
        return ["-"] * len(_HEADINGS)
    one = Summary.of(results)
    errors = (one.mean, one.standard_deviation, one.median, one.minimum, one.maximum)
    return [
        *(f"{error:.2f}" for error in errors),
        f"{round(one.under_4_px * one.photos)}/{one.photos}",
        f"{one.gross_misses}",
        f"{one.segmentation_accuracy:.2%}",
        "-" if math.isnan(one.seconds) else f"{1000 * one.seconds:.0f}",
    ]


def _figures(summary: Summary, interval: Interval | None) -> list[tuple[str, str]]:
    sure = []
    if interval:
        told = f"{interval.low:.2f} to {interval.high:.2f} px"
        sure = [("A_err, 95 % interval of the mean", told)]
    return [
        ("photos", f"{summary.photos}"),
        ("A_err, mean", f"{summary.mean:.2f} px"),
        *sure,
        ("A_err, standard deviation", f"{summary.standard_deviation:.2f} px"),
        ("A_err, median", f"{summary.median:.2f} px"),
        ("A_err, 75th, 90th and 95th percentile", _percentiles(summary)),
        ("A_err, minimum", f"{summary.minimum:.2f} px"),
        ("A_err, maximum", f"{summary.maximum:.2f} px"),
        ("photos under 4 px", _share(summary.under_4_px, summary.photos)),
        ("photos under 5 px", _share(summary.under_5_px, summary.photos)),
        ("gross misses (over 5 % of the height)", f"{summary.gross_misses}"),
        ("segmentation accuracy", f"{summary.segmentation_accuracy:.2%}"),
        ("visible columns called invisible", f"{summary.called_invisible:.2%}"),
        *_time(summary.seconds),
    ]


def _percentiles(summary: Summary) -> str:
    found = (summary.percentile_75, summary.percentile_90, summary.percentile_95)
    return ", ".join(f"{one:.2f}" for one in found) + " px"


def _time(seconds: float) -> list[tuple[str, str]]:
    """Nothing for lines that somebody else found, in a time that nobody told."""
    return [] if math.isnan(seconds) else [("time of a detection, median", f"{seconds:.3f} s")]


def _share(share: float, photos: int) -> str:
    """A share of photos, and how sure it is: other photos of the kind would give another one."""
    low, high = wilson(round(share * photos), photos)
    return f"{share:.1%} (95 % interval: {low:.0%} to {high:.0%})"
