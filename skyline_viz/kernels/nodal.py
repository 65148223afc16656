"""The nodal costs of a photo in one pass: edges, clear sky and sky.

What each term is, `skyline_viz.terms` says. All of them run along rows here, where each of a row's
pixels is worked out from the same few numbers above it, many at once. But the costs are wanted
column by column. So `BAND` rows are made, which stay in the cache, and are then turned: the pixels
of a column that are written together fill a line of the cache.
"""

from __future__ import annotations

from typing import NamedTuple

import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Bool, Int

BAND = 16
"""Rows that are turned together: as many float32 as there are in a line of the cache."""


class Clear(NamedTuple):
    """What pixels pay for the edge pixels above them."""

    weight: np.float32
    """For each of them."""

    cap: np.float32
    """At the most."""

    rows: int
    """Edge pixels so near above do not count."""

    columns: int
    """An odd number of columns over which their number is averaged."""


class Improbable(NamedTuple):
    """What pixels pay for what a map finds improbable."""

    borders: F32
    """``(w, h + 1)`` by column of the map and border of its rows."""

    left: Int
    """``(W,)`` column of the map before each column of the photo."""

    right: Int
    """``(W,)`` and after it."""

    sideways: F32
    """``(W,)`` how far it is from the one to the other, in [0, 1]."""

    cap: np.float32
    """What a pixel pays at the most, above the least of its column."""


NOTHING = np.zeros((0, 0), np.float32)
"""The borders of a map that is not asked."""


def nodal_costs(
    edges: Bool, at_edges: F32, elsewhere: float, clear: Clear | None, sky: Improbable | None
) -> F32:
    """Nodal costs ``(W, H)`` float32, column by column.

    Args:
        edges: ``(H, W)`` edge map.
        at_edges: ``(n,)`` what edge pixels pay as such, row by row.
        elsewhere: What the others pay.
        clear: What they pay for the edges above; None for nothing.
        sky: What they pay for what is improbable; None for nothing.

    Examples:
        >>> edges = np.array([[False, True], [False, False]])
        >>> nodal_costs(edges, np.float32([0.5]), 2.0, None, None)
        array([[2. , 2. ],
               [0.5, 2. ]], dtype=float32)
    """
    height, width = edges.shape
    costs = np.empty((width, height), np.float32)
    values = np.append(at_edges, np.float32(0)).astype(np.float32)
    clear = clear or Clear(np.float32(0), np.float32(0), 0, 1)
    lines, least = NOTHING, np.zeros(0, np.float32)
    if sky is not None:
        here, there = sky.borders[sky.left], sky.borders[sky.right]
        lines = np.ascontiguousarray((here + sky.sideways[:, None] * (there - here)).T)
        least = _least(lines, height)
    cap = np.float32(0) if sky is None else sky.cap
    bytes_ = np.ascontiguousarray(edges).view(np.uint8)
    _fill(bytes_, values, np.float32(elsewhere), clear, lines, least, cap, costs)
    return costs


def _least(lines: F32, height: int) -> F32:
    """The least that any pixel of a column pays, ``(W,)``.

    Between two borders it changes one way only: it is enough to look at the first and the last row
    of each region.
    """
    count = len(lines) - 1
    row = np.arange(height)
    region = (row * count / height).astype(np.int32)
    ends = np.flatnonzero(np.diff(region, prepend=-1, append=count))
    rows = np.unique(np.concatenate([ends[:-1], ends[1:] - 1]))
    regions, inside = _places(rows, count, height)
    upper = lines[regions]
    pays = upper + inside[:, None] * (lines[regions + 1] - upper)
    return pays.min(axis=0)


def _places(rows: Int, count: int, height: int) -> tuple[Int, F32]:
    """Region of rows of a photo, and how far down in it they are; a line lies on a row's top."""
    places = rows * count / height
    regions = places.astype(np.int32)
    return regions, (places - regions).astype(np.float32)


@numba.njit(cache=True, nogil=True)
def _fill(
    edges: U8,
    values: F32,
    elsewhere: float,
    clear: Clear,
    lines: F32,
    least: F32,
    cap: float,
    costs: F32,
) -> None:
    """Fill the costs band by band; see `nodal_costs`.

    Args:
        edges: ``(H, W)``.
        values: ``(n + 1,)`` what edge pixels pay, and one more.
        elsewhere: What the others pay.
        clear: See `Clear`.
        lines: ``(h + 1, W)`` improbable shares at the borders of regions; of no size for none.
        least: ``(W,)`` the least of each column.
        cap: See `Improbable`.
        costs: ``(W, H)`` is filled.
    """
    height, width = edges.shape
    half = clear.columns // 2
    steps = np.empty(width, np.float32)  # what one edge in the window adds
    for column in range(width):
        inside = min(column + half, width - 1) - max(column - half, 0) + 1
        steps[column] = clear.weight / np.float32(inside)
    padded = np.zeros(width + 2 * half, np.uint8)
    above = np.zeros(width, np.int32)
    count = len(lines) - 1
    band = np.empty((BAND, width), np.float32)
    place = 0
    for top in range(0, height, BAND):
        rows = min(BAND, height - top)
        for at in range(rows):
            row = top + at
            line = band[at]
            place = _put_edges(edges[row], values, place, elsewhere, line)
            if clear.weight > 0 and row > clear.rows:
                padded[half : half + width] = edges[row - clear.rows - 1]
                _count(padded, clear.columns, above)
                _add_clear(above, steps, clear.cap, line)
            if count > 0:
                down = row * count / height
                region = int(down)
                inside_region = np.float32(down - region)
                _add_sky(lines[region], lines[region + 1], inside_region, least, cap, line)
        _turn(band, rows, costs, top)


@numba.njit(cache=True, nogil=True)
def _put_edges(edges: U8, values: F32, place: int, elsewhere: float, line: F32) -> int:
    """Write the costs of a row before all others, and tell how many values have been used.

    Without a branch, which would be guessed wrongly at every other edge.
    """
    for column in range(len(line)):
        line[column] = values[place] if edges[column] else elsewhere
        place += edges[column]
    return place


@numba.njit(cache=True, nogil=True)
def _count(padded: U8, window: int, above: Int) -> None:
    """Add the edge pixels of a row, in a window around each column, to those of the rows above."""
    for shift in range(window):
        for column in range(len(above)):
            above[column] += padded[column + shift]


@numba.njit(cache=True, nogil=True)
def _add_clear(above: Int, steps: F32, cap: float, line: F32) -> None:
    """Add what pixels pay for edges above them: in float64, and rounded once."""
    for column in range(len(line)):
        pays = min(np.float64(steps[column]) * above[column], np.float64(cap))
        line[column] = np.float32(line[column] + pays)


@numba.njit(cache=True, nogil=True)
def _add_sky(upper: F32, lower: F32, inside: float, least: F32, cap: float, line: F32) -> None:
    """Add what pixels of a row pay between two borders of regions."""
    for column in range(len(line)):
        pays = upper[column] + inside * (lower[column] - upper[column])
        line[column] += min(pays - least[column], cap)


@numba.njit(cache=True, nogil=True)
def _turn(band: F32, rows: int, costs: F32, top: int) -> None:
    """Write the rows of a band as parts of columns."""
    if rows == BAND:
        for column in range(band.shape[1]):
            for row in range(BAND):
                costs[column, top + row] = band[row, column]
    else:
        for column in range(band.shape[1]):
            for row in range(rows):
                costs[column, top + row] = band[row, column]
