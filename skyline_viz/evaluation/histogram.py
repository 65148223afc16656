"""How A_err is distributed, as a picture."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

from skyline_viz.arrays import F64
from skyline_viz.evaluation.distribution import TOP, shares
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.files import replacing
from skyline_viz.system.names import shortened, shown_in_viewer, told_in_picture

_GREY = "#595959"
_MAGENTA = "#FF2D95"
_WIDTH = 0.9  # of the bars of a bin, in pixels of A_err


def histogram(results: Sequence[PhotoResult]) -> F64:
    """Share of photos ``(TOP + 1,)`` in bins one pixel of A_err wide; the last is open.

    >>> from skyline_viz.skyline import Skyline
    >>> results = [PhotoResult.of("a", Skyline([9]), Skyline([rows]), 20) for rows in (9, 8, 8)]
    >>> histogram(results)[:3].round(2)
    array([0.33, 0.67, 0.  ])
    """
    return shares([result.a_err for result in results])


def write_histogram(
    path: str | os.PathLike[str], results: Mapping[str, Sequence[PhotoResult]], title: str
) -> None:
    """Draw the normalised histogram of A_err as a picture, as in the paper's figure 4.

    Several methods stand side by side in each bin, and a legend names them.

    Args:
        path: Where to.
        results: The results by the name of the method.
        title: What the picture shows.
    """
    figure = Figure(figsize=(6.4 + 0.4 * (len(results) - 1), 3.8), dpi=150, layout="constrained")
    axes = figure.add_subplot()
    drawn = {name: histogram(found) for name, found in results.items()}
    if len(drawn) == 1:
        _draw_one(axes, *drawn.values())
    elif drawn:
        _draw_several(axes, drawn)
        figure.legend(loc="outside right upper", frameon=False, fontsize=8)
    highest = max((float(one.max()) for one in drawn.values()), default=0.0)
    axes.set_title(told_in_picture(title), parse_math=False, loc="left", fontsize=11)
    far_off = f"; magenta: {TOP} or more" if len(drawn) == 1 else ""
    axes.set_xlabel(f"$A_{{err}}$ (pixels), in bins of one{far_off}")
    axes.set_ylabel("share of photos")
    axes.set_xticks([*range(TOP), TOP + 0.5], [*map(str, range(TOP)), f"{TOP} or more"])
    axes.tick_params(length=0)
    axes.set_xlim(0, TOP + 1)
    axes.set_ylim(0, max(highest * 1.12, 0.1))
    axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    axes.yaxis.grid(True, color="#E0E0E0", linewidth=0.8)
    axes.set_axisbelow(True)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    with replacing(path) as temporary:
        FigureCanvasAgg(figure).print_figure(temporary)


def _draw_one(axes: Axes, heights: F64) -> None:
    """Bars with their figures; what is far off stands out."""
    bars = axes.bar(np.arange(len(heights)) + 0.5, heights, width=_WIDTH, color=_GREY)
    bars[-1].set_color(_MAGENTA)
    axes.bar_label(
        bars,
        [f"{100 * share:.3g}%" if share else "" for share in heights],
        padding=2,
        fontsize=8,
        color=_GREY,
    )


def _draw_several(axes: Axes, drawn: Mapping[str, F64]) -> None:
    """Bars of all methods beside each other in each bin, from dark to light."""
    width = _WIDTH / len(drawn)
    colours = colormaps["viridis"](np.linspace(0, 0.9, len(drawn)))
    for place, (name, one) in enumerate(drawn.items()):
        left = (1 - _WIDTH) / 2 + place * width
        label = shown_in_viewer(shortened(name)).replace("$", r"\$")
        axes.bar(
            np.arange(len(one)) + left, one, width, align="edge", color=colours[place], label=label
        )
