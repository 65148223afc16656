"""Lines and curves as paths of SVG, which stay sharp at any size, with few points.

A line runs where the sky ends: at the upper side of the first terrain pixel of each column. The
centre of column ``j`` is at ``j + 0.5``, and a photo reaches from 0 to its width.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt
from skimage.measure import approximate_polygon

from skyline_viz.arrays import F64, Bool, runs
from skyline_viz.skyline import Skyline


def line_path(line: Skyline, tolerance: float) -> str:
    """Path of a line in pixels of its photo, where it is visible.

    >>> line_path(Skyline([4, 4, 6], visible=[True, True, False]), tolerance=0.1)
    'M0 4L2 4'

    Args:
        line: The line.
        tolerance: By how much it may be off, in pixels of the photo.
    """
    return rows_path(line.rows, line.visible, tolerance)


def rows_path(rows: npt.NDArray[np.floating | np.integer], visible: Bool, tolerance: float) -> str:
    """The same of rows ``(W,)`` and where they can be seen ``(W,)``."""
    parts = []
    for first, last in runs(visible):
        x = [first, *(np.arange(first, last + 1) + 0.5), last + 1]
        y = rows[first : last + 1].astype(np.float64)
        points = np.column_stack([x, [y[0], *y, y[-1]]])
        parts.append(path_of(approximate_polygon(points, tolerance)))
    return "".join(parts)


def curve_path(values: F64, low: float, high: float, size: tuple[int, int]) -> str:
    """Path of values ``(n,)`` that share a width, from `low` at the bottom to `high` at the top.

    >>> curve_path(np.array([0.0, 1.0, np.nan, 1.0, 1.0]), 0, 1, (50, 10))
    'M5 10L15 0M35 0L45 0'

    Args:
        values: The values; NaN leaves a gap.
        low: Value at the bottom.
        high: Value at the top.
        size: Width and height of the plot.
    """
    width, height = size
    step = width / max(len(values), 1)
    parts = []
    for first, last in runs(~np.isnan(values)):
        x = (np.arange(first, last + 1) + 0.5) * step
        y = height * (1 - (values[first : last + 1] - low) / max(high - low, 1e-9))
        parts.append(path_of(approximate_polygon(np.column_stack([x, y]), height / 400)))
    return "".join(parts)


def path_of(points: Iterable[Iterable[float]]) -> str:
    """Path through points (x, y), to a tenth.

    >>> path_of([(0, 1), (2.04, 3.26)])
    'M0 1L2 3.3'
    """
    spelt = [" ".join(f"{round(float(one), 1):g}" for one in point) for point in points]
    return "M" + "L".join(spelt) if spelt else ""
