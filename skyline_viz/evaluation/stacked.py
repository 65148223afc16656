"""A picture of what lines pay in each column, stacked by what they pay for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from skyline_viz.arrays import F64, U8

_SMOOTH = 9  # columns over which values are averaged
_STYLE: dict[Any, Any] = {
    "axes.facecolor": "#0c0c0c",
    "figure.facecolor": "#0c0c0c",
    "text.color": "#dddddd",
    "axes.labelcolor": "#dddddd",
    "xtick.color": "#dddddd",
    "ytick.color": "#dddddd",
    "axes.edgecolor": "#555555",
    "font.size": 11,
}


def stacked_columns(panels: Mapping[str, Mapping[str, F64]], colours: Mapping[str, str]) -> U8:
    """Draw areas stacked over the columns of a photo, ``(h, w, 3)`` uint8 RGB.

    Args:
        panels: Title of each panel, and its values ``(W,)`` by name; negative ones go below the
            axis. All panels have the same names.
        colours: Colour of each name, as ``#RRGGBB``.
    """
    with rc_context(_STYLE):
        figure = Figure(figsize=(12.6, 3.6), dpi=100, layout="constrained")
        canvas: Any = FigureCanvasAgg(figure)
        both = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
        for axes, (title, values) in zip(both, panels.items(), strict=True):
            costs = np.array([_smooth(one) for one in values.values()])
            columns = np.arange(costs.shape[1])
            shades = [colours[name] for name in values]
            for sign in (np.maximum, np.minimum):  # gains go below the axis
                axes.stackplot(columns, sign(costs, 0), colors=shades, linewidth=0)
            axes.plot(columns, costs.sum(axis=0), color="white", linewidth=0.8)
            axes.set_title(title)
            axes.margins(x=0)
            axes.set_xlabel("column")
        names = list(next(iter(panels.values())))
        handles = [both[0].collections[at] for at in range(len(names))]
        figure.legend(handles, names, loc="outside lower center", ncols=len(names), frameon=False)
        canvas.draw()
        picture: U8 = np.asarray(canvas.buffer_rgba())[..., :3].copy()
    return picture


def _smooth(values: F64) -> F64:
    padded = np.pad(values, _SMOOTH // 2, mode="edge")  # or it would droop at the rims
    return np.convolve(padded, np.full(_SMOOTH, 1 / _SMOOTH), mode="valid")
