"""The nodal costs of a photo in one pass: edges, clear sky and sky.

What each term is, `skyline_viz.terms` says. All of them run along rows here, where each of a row's
pixels is worked out from the same few numbers above it, many at once. But the costs are wanted
column by column. So `BAND` rows are made, which stay in the cache, and are then turned.
"""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Bool, Int

BAND = 64
"""Rows that are turned together: of each column they fill four lines of the cache."""


class Own(NamedTuple):
    """What edge pixels pay for themselves."""

    rows: Int
    """``(n,)`` of the edge pixels, in ascending order."""

    columns: Int
    """``(n,)`` likewise."""

    costs: F32
    """``(n,)`` what they pay."""


WINDOW = 9
"""Columns over which the edge pixels above a pixel are averaged."""


class Clear(NamedTuple):
    """What pixels pay for the edge pixels above them, averaged over `WINDOW` columns."""

    weight: np.float32
    """For each of them."""

    cap: np.float32
    """At the most."""

    rows: int
    """Edge pixels so near above do not count."""


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


NOTHING = np.zeros((1, 0), np.float32)
"""The borders of a map that is not asked."""


def nodal_costs(
    edges: Bool,
    own: Own | None,
    elsewhere: float,
    clear: Clear | None = None,
    sky: Improbable | None = None,
) -> F32:
    """Nodal costs ``(W, H)`` float32, column by column.

    Args:
        edges: ``(H, W)`` edge map.
        own: What edge pixels pay as such; None if that is what the others pay.
        elsewhere: What the others pay.
        clear: What they pay for the edges above; None for nothing.
        sky: What they pay for what is improbable; None for nothing.

    Examples:
        >>> edges = np.array([[False, True], [False, False]])
        >>> own = Own(np.int32([0]), np.int32([1]), np.float32([0.5]))
        >>> nodal_costs(edges, own, 2.0)
        array([[2. , 2. ],
               [0.5, 2. ]], dtype=float32)
    """
    height, width = edges.shape
    costs = np.empty((width, height), np.float32)
    own = own or Own(np.zeros(0, np.int32), np.zeros(0, np.int32), np.zeros(0, np.float32))
    first = np.searchsorted(own.rows, np.arange(height + 1, dtype=np.int32))
    clear = clear or Clear(np.float32(0), np.float32(0), 0)
    lines, least, cap = NOTHING, NOTHING[0], np.float32(0)
    if sky is not None:
        lines, least = (
            np.empty((sky.borders.shape[1], width), np.float32),
            np.empty(width, np.float32),
        )
        borders = np.ascontiguousarray(sky.borders.T)
        _prepare(borders, sky.left, sky.right, sky.sideways, height, lines, least)
        cap = sky.cap
    flags = np.ascontiguousarray(edges).view(np.uint8)
    pays = own.columns, own.costs, np.float32(elsewhere), first
    above = np.zeros(width, np.int32)
    band = np.empty((BAND, width), np.float32)
    for top in range(0, height, BAND):
        part = band[: height - top]
        _fill(flags, *pays, clear, above, lines, least, cap, top, part)
        cv2.transpose(part, costs[:, top : top + BAND])
    return costs


@numba.njit(cache=True, nogil=True)
def _prepare(
    borders: F32, left: Int, right: Int, sideways: F32, height: int, lines: F32, least: F32
) -> None:
    """Fill in what all rows need of a map, see `_lines` and `_least`."""
    _lines(borders, left, right, sideways, lines)
    _least(lines, height, least)


@numba.njit(cache=True, nogil=True)
def _lines(borders: F32, left: Int, right: Int, sideways: F32, lines: F32) -> None:
    """Interpolate what is paid at the borders of regions ``(h + 1, w)`` between their columns."""
    for border in range(len(borders)):
        regions, line = borders[border], lines[border]
        for column in range(np.uintp(len(line))):  # unsigned: none is counted from the end
            here = regions[np.uintp(left[column])]
            there = regions[np.uintp(right[column])]
            line[column] = here + sideways[column] * (there - here)


@numba.njit(cache=True, nogil=True)
def _least(lines: F32, height: int, least: F32) -> None:
    """Find the least that any pixel of a column would pay.

    Between two borders it changes one way only, rounded or not: it is enough to look at the first
    and the last row of each region.
    """
    least[:] = np.inf
    count = len(lines) - 1
    for row in range(height):
        down = row * count / height
        region = int(down)
        if row > 0 and row < height - 1:
            before, after = (row - 1) * count / height, (row + 1) * count / height
            if int(before) == region and int(after) == region:
                continue
        within = np.float32(down - region)
        upper, lower = lines[region], lines[region + 1]
        for column in range(len(least)):
            pays = upper[column] + within * (lower[column] - upper[column])
            least[column] = min(least[column], pays)


@numba.njit(cache=True, nogil=True)
def _fill(
    edges: U8,
    columns: Int,
    values: F32,
    elsewhere: float,
    first: Int,
    clear: Clear,
    above: Int,
    lines: F32,
    least: F32,
    cap: float,
    top: int,
    band: F32,
) -> None:
    """Fill a band of rows; see `nodal_costs`.

    Args:
        edges: ``(H, W)``.
        columns: ``(n,)`` columns of the edge pixels.
        values: ``(n,)`` what they pay.
        elsewhere: What the others pay.
        first: ``(H + 1,)`` place of each row's first edge pixel.
        clear: See `Clear`.
        above: ``(W,)`` edge pixels above the row before, in the window of each column; brought on.
        lines: ``(h + 1, W)`` improbable shares at the borders of regions; of no size for none.
        least: ``(W,)`` the least of each column.
        cap: See `Improbable`.
        top: First row of the band.
        band: ``(rows, W)`` is filled.
    """
    height, width = edges.shape
    half = WINDOW // 2
    steps = np.empty(width, np.float32)  # what one edge in the window adds
    for column in range(width):
        inside = min(column + half, width - 1) - max(column - half, 0) + 1
        steps[column] = clear.weight / np.float32(inside)
    padded = np.zeros(width + 2 * half, np.uint8)
    threes = np.empty(width + 2 * half - 2, np.uint8)
    count = len(lines) - 1
    for at in range(len(band)):
        row = top + at
        line = band[at]
        line[:] = elsewhere
        for place in range(np.uintp(first[row]), np.uintp(first[row + 1])):
            line[columns[place]] = values[place]
        if clear.weight > 0 and row > clear.rows:
            _copy(edges[row - clear.rows - 1], padded[half : half + width])
            _count(padded, threes, above)
            _add_clear(above, steps, clear.cap, line)
        if count > 0:
            down = row * count / height
            region = int(down)
            within = np.float32(down - region)
            _add_sky(lines[region], lines[region + 1], within, least, cap, line)


@numba.njit(cache=True, nogil=True)
def _copy(line: U8, padded: U8) -> None:
    """Copy a row: numba's own assignment of arrays takes several times as long."""
    for column in range(len(line)):
        padded[column] = line[column]


@numba.njit(cache=True, nogil=True)
def _count(padded: U8, threes: U8, above: Int) -> None:
    """Add the edge pixels of a row, in a window around each column, to those of the rows above.

    The window has nine columns: three times three are summed in bytes.
    """
    for column in range(len(threes)):
        two = np.uint8(padded[column] + padded[column + 1])
        threes[column] = np.uint8(two + padded[column + 2])
    for column in range(len(above)):
        two = np.uint8(threes[column] + threes[column + 3])
        above[column] += np.int32(np.uint8(two + threes[column + 6]))


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
