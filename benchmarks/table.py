"""Tables in Markdown."""

from collections.abc import Iterable, Sequence

from skyline_viz.evaluation.intervals import Interval
from skyline_viz.evaluation.results import Summary

A_ERR_HEADER = (
    "mean", "standard deviation", "median", "min", "max", "< 4 px", "< 5 px", "gross misses",
)  # fmt: skip


def markdown(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table whose first column is text and whose others are figures."""
    lines = [" | ".join(header), " | ".join(["---", *["---:"] * (len(header) - 1)])]
    lines += [" | ".join(row) for row in rows]
    return "\n".join(f"| {line} |" for line in lines)


def a_err_cells(summary: Summary) -> list[str]:
    """Cells under `A_ERR_HEADER`, in pixels."""
    count = summary.photos
    return [
        *(
            f"{value:.2f}"
            for value in (
                summary.mean,
                summary.standard_deviation,
                summary.median,
                summary.minimum,
                summary.maximum,
            )
        ),
        f"{round(summary.under_4_px * count)}/{count}",
        f"{round(summary.under_5_px * count)}/{count}",
        str(summary.gross_misses),
    ]


def percent(interval: Interval) -> str:
    """An interval of a share, in percent.

    >>> percent(Interval(0.912, 1.0))
    '91 to 100'
    """
    return f"{100 * interval.low:.0f} to {100 * interval.high:.0f}"
