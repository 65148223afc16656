"""Error curves: how many photos, and how many columns, are right within each tolerance."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

from skyline_viz.arrays import F64
from skyline_viz.evaluation.distribution import cumulative
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.files import replacing, write_text
from skyline_viz.system.names import shortened, shown_in_viewer, told_in_picture

TOLERANCES = tuple(range(1, 21))
"""Tolerances in pixels."""

_HEADER = ("method", "tolerance", "photos", "columns")


def curve(results: Sequence[PhotoResult]) -> tuple[F64, F64]:
    """Shares of photos and of columns ``(20,)`` that are within each of `TOLERANCES`.

    A photo is within a tolerance by its A_err, a column by its own error. Photos count alike,
    whatever their width: the share of columns is the mean of theirs.

    >>> from skyline_viz.skyline import Skyline
    >>> photos, columns = curve([PhotoResult.of("a", Skyline([4, 8]), Skyline([4, 4]), 9)])
    >>> photos[:3], columns[:5]
    (array([0., 1., 1.]), array([0.5, 0.5, 0.5, 1. , 1. ]))

    Returns:
        Both shares; that of columns is NaN where no errors of columns are known.
    """
    photos = cumulative([one.a_err for one in results], TOLERANCES)
    errors = [one.errors for one in results if one.errors is not None]
    if not errors:
        return photos, np.full(len(TOLERANCES), np.nan)
    shares = [cumulative(np.abs(one[np.isfinite(one)]).tolist(), TOLERANCES) for one in errors]
    return photos, np.mean(shares, axis=0)


def write_curves(
    path: str | os.PathLike[str], results: Mapping[str, Sequence[PhotoResult]]
) -> None:
    """Write the curves as CSV: for each method and tolerance the shares, in [0, 1]."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_HEADER)
    for name, found in results.items():
        for tolerance, *shares in zip(TOLERANCES, *curve(found), strict=True):
            told = ["" if np.isnan(share) else f"{share:.6g}" for share in shares]
            writer.writerow([name, tolerance, *told])
    write_text(path, text.getvalue())


def draw_curves(
    path: str | os.PathLike[str], results: Mapping[str, Sequence[PhotoResult]], title: str
) -> None:
    """Draw the curves side by side, photos and columns, a line for each method.

    Args:
        path: Where to.
        results: The results by the name of the method.
        title: What the picture shows.
    """
    figure = Figure(figsize=(8.4, 3.8), dpi=150, layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    colours = colormaps["viridis"](np.linspace(0, 0.8, max(len(results), 1)))
    for colour, (name, found) in zip(colours, results.items(), strict=False):
        label = shown_in_viewer(shortened(name)).replace("$", r"\$")
        for axes, shares in zip((left, right), curve(found), strict=True):
            axes.plot(TOLERANCES, shares, color=colour, label=label, linewidth=1.8)
    _dress(left, "photos with an $A_{err}$ of at most", "share")
    _dress(right, "columns with an error of at most", "")
    figure.suptitle(told_in_picture(title), parse_math=False, x=0.01, ha="left", size=11)
    if len(results) > 1:
        right.legend(loc="lower right", frameon=False, fontsize=8)
    with replacing(path) as temporary:
        FigureCanvasAgg(figure).print_figure(temporary)


def _dress(axes: Axes, what: str, share: str) -> None:
    axes.set_xlabel(f"{what} (pixels)")
    axes.set_ylabel(share)
    axes.set_xlim(TOLERANCES[0], TOLERANCES[-1])
    axes.set_xticks([1, 5, 10, 15, 20])
    axes.set_ylim(0, 1.01)
    axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    axes.grid(True, color="#E0E0E0", linewidth=0.8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
