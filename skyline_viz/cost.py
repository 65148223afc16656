"""Stage 5, cost: scores and gradient strength fused into the nodal cost of every pixel."""

import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Bool, Int

CLEAR_SKY_ROWS = 3
"""Edge pixels this near above a pixel, in rows, do not count against it."""

CLEAR_SKY_COLUMNS = 9
"""Columns over which the edge pixels above a pixel are averaged."""


def normalised(strength: F32, percentile: float) -> F32:
    """Gradient strength ``(n,)`` in [0, 1], where 1 is the given percentile of this photo's edges."""
    if len(strength) == 0:
        return strength
    top = np.percentile(strength, percentile)
    return np.clip(strength / top, 0.0, 1.0) if top > 0 else np.zeros_like(strength)


def edge_cost(scores: F32, strength: F32, v: float) -> F32:
    """Nodal cost of edge pixels, ``v (1 - score) + (1 - v) (1 - strength)``, the paper's last equation.

    Args:
        scores: ``(n,)`` in [0, 1].
        strength: ``(n,)`` in [0, 1], see `normalised`.
        v: Weight of the score, in [0, 1].
    """
    cost: F32 = np.float32(v) * (1 - scores) + np.float32(1 - v) * (1 - strength)
    return cost


def nodal_cost(
    edges: Bool, rows: Int, columns: Int, at_edges: F32, non_edge: float, clear_sky: float
) -> F32:
    """Nodal cost of every pixel.

    Args:
        edges: ``(H, W)`` edge map.
        rows: ``(n,)`` rows of the edge pixels.
        columns: ``(n,)`` columns of the edge pixels.
        at_edges: ``(n,)`` cost of the edge pixels.
        non_edge: Cost of all other pixels.
        clear_sky: What each edge pixel above a pixel in its column adds to its cost; nothing but
            sky lies above a skyline.

    Returns:
        ``(H, W)`` float32, a transposed view: the path search goes down columns.
    """
    height, width = edges.shape
    cost = np.full((width, height), non_edge, np.float32)
    cost[columns, rows] = at_edges
    if clear_sky > 0:
        _add_clear_sky(cost, np.ascontiguousarray(edges.T).view(np.uint8), np.float32(clear_sky))
    return cost.T


@numba.njit(cache=True, nogil=True)
def _add_clear_sky(cost: F32, edges: U8, weight: float) -> None:
    """Add the weighted number of edge pixels above, averaged over columns; both ``(W, H)``."""
    width, height = cost.shape
    half = CLEAR_SKY_COLUMNS // 2
    window = np.zeros(height, np.int32)
    for column in range(min(half, width)):
        window += edges[column]
    for column in range(width):
        if column + half < width:
            window += edges[column + half]
        if column - half - 1 >= 0:
            window -= edges[column - half - 1]
        in_window = min(column + half, width - 1) - max(column - half, 0) + 1
        step = weight / np.float32(in_window)
        above = 0
        for row in range(CLEAR_SKY_ROWS + 1, height):
            above += window[row - CLEAR_SKY_ROWS - 1]
            cost[column, row] += step * above
