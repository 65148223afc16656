"""Stage 5, cost: scores and gradient strength fused into the nodal cost of every pixel."""

import cv2
import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Bool, Int

CLEAR_SKY_ROWS = 3
"""Edge pixels this near above a pixel, in rows, do not count against it."""

CLEAR_SKY_COLUMNS = 9
"""Columns over which the edge pixels above a pixel are averaged."""


def normalised(strength: F32, percentile: float) -> F32:
    """Gradient strength ``(n,)`` in [0, 1]; 1 is the given percentile of this photo's edges."""
    if len(strength) == 0:
        return strength
    top = np.percentile(strength, percentile)
    return np.clip(strength, 0.0, top) / top if top > 0 else np.zeros_like(strength)


def edge_cost(scores: F32, strength: F32, v: float) -> F32:
    """Nodal cost of edge pixels, the last equation of the paper.

    ``v (1 - score) + (1 - v) (1 - strength)``

    Args:
        scores: ``(n,)`` in [0, 1].
        strength: ``(n,)`` in [0, 1], see `normalised`.
        v: Weight of the score, in [0, 1].
    """
    cost: F32 = np.float32(v) * (1 - scores) + np.float32(1 - v) * (1 - strength)
    return cost


def nodal_cost(edges: Bool, at_edges: F32, non_edge: float, clear_sky: float) -> F32:
    """Nodal cost of every pixel.

    Args:
        edges: ``(H, W)`` edge map.
        at_edges: ``(n,)`` cost of the edge pixels, row by row.
        non_edge: Cost of all other pixels.
        clear_sky: What each edge pixel above a pixel in its column adds to its cost; nothing but
            sky lies above a skyline.

    Returns:
        ``(H, W)`` float32, a transposed view: the path search goes down columns.
    """
    across = np.full(edges.shape, non_edge, np.float32)
    across.ravel()[np.flatnonzero(edges)] = at_edges  # thrice as fast as across[edges]
    cost: F32 = cv2.transpose(across)  # by tiles: numpy's own copy of a transpose misses the cache
    if clear_sky > 0:
        _add_clear_sky(cost, cv2.transpose(edges.view(np.uint8)), np.float32(clear_sky))
    return cost.T


def add_blocks(cost: F32, blocks: F32, weight: float, side: int) -> None:
    """Add a weighted map of blocks to the nodal cost, in place, interpolated between centres.

    Args:
        cost: ``(H, W)`` as `nodal_cost` gives it.
        blocks: ``(h, w)`` one value a block.
        weight: Its weight.
        side: Side of a block, in pixels.
    """
    _add_blocks(cost.T, np.ascontiguousarray(blocks.T), np.float32(weight), side)


@numba.njit(cache=True, nogil=True)
def _add_blocks(cost: F32, blocks: F32, weight: float, side: int) -> None:
    """`add_blocks` with both arrays column by column, ``(W, H)`` and ``(w, h)``."""
    width, height = cost.shape
    left, right, sideways = _between_centres(width, blocks.shape[0], side)
    above, below, downwards = _between_centres(height, blocks.shape[1], side)
    line = np.empty(blocks.shape[1], np.float32)
    for column in range(width):
        here = blocks[left[column]]
        there = blocks[right[column]]
        for block in range(line.size):
            line[block] = weight * (here[block] + sideways[column] * (there[block] - here[block]))
        for row in range(height):
            over = line[above[row]]
            cost[column, row] += over + downwards[row] * (line[below[row]] - over)


@numba.njit(cache=True, nogil=True)
def _between_centres(length: int, blocks: int, side: int) -> tuple[Int, Int, F32]:
    """For each pixel of an axis the blocks before and after it, and how far it is on the way."""
    before = np.empty(length, np.int32)
    after = np.empty(length, np.int32)
    share = np.empty(length, np.float32)
    for pixel in range(length):
        place = min(max((pixel + 0.5) / side - 0.5, 0.0), blocks - 1.0)
        before[pixel] = int(place)
        after[pixel] = min(before[pixel] + 1, blocks - 1)
        share[pixel] = place - before[pixel]
    return before, after, share


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
