"""What each cause costs a data set, and what would mend it, as a picture."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from skyline_viz.files import replacing
from skyline_viz.system.names import printable, shortened, shown_in_viewer

MOST = 12
"""So many causes are drawn, those that cost most."""

_GREY = "#595959"
_MAGENTA = "#FF2D95"


@dataclass(frozen=True)
class CauseBar:
    """A cause, as it is drawn."""

    title: str
    """What it is called."""

    photos: int
    """Photos in which it is."""

    a_err: float
    """What it adds to the mean A_err of the data set, in pixels."""

    remedy: str
    """What helps most, and what that does elsewhere, in words."""


def write_cause_bars(path: str | os.PathLike[str], bars: Sequence[CauseBar], title: str) -> None:
    """Draw a bar for each cause, that which costs most first, with the remedy under it.

    Args:
        path: Where to.
        bars: The causes, in order. Those beyond `MOST` are counted in the last line.
        title: What the picture shows.
    """
    shown = bars[:MOST]
    figure = Figure(figsize=(9.6, 1.4 + 0.62 * max(len(shown), 1)), dpi=150, layout="constrained")
    axes = figure.add_subplot()
    places = range(len(shown))
    drawn = axes.barh(places, [one.a_err for one in shown], height=0.42, color=_GREY)
    if shown:
        drawn[0].set_color(_MAGENTA)
    most = max((one.a_err for one in shown), default=0.0) or 1.0
    for place, one in zip(places, shown, strict=True):
        photos = "1 photo" if one.photos == 1 else f"{one.photos} photos"
        cost = f" {one.a_err:.2f} px, {photos}"
        axes.text(one.a_err, place, cost, va="center", fontsize=8, color=_GREY)
        axes.text(
            0, place + 0.42, one.remedy, va="center", fontsize=7, color=_GREY, parse_math=False
        )
    axes.set_yticks([*places], [one.title for one in shown], fontsize=9)
    axes.set_ylim(len(shown) - 0.3, -0.5)
    axes.set_xlim(0, most * 1.25)
    axes.tick_params(length=0)
    left = len(bars) - len(shown)
    axes.set_xlabel(
        "what it adds to the mean $A_{err}$ (pixels)"
        + (f"; {left} more causes add less" if left else "")
    )
    heading = shown_in_viewer(printable(shortened(title)))
    axes.set_title(f"Causes of {heading}", parse_math=False, loc="left", fontsize=11)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    with replacing(path) as temporary:
        FigureCanvasAgg(figure).print_figure(temporary)
