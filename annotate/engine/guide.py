"""A guide: a rough stroke along a ridge, and the corridor in which the line then lies.

A stroke is a thick line that a hand has drawn: a disc is led along it, and what it covers of each
column is the corridor there. The disc is as wide as the hand is uncertain, and wider where the hand
was fast. On steep ridges a corridor is higher than the disc is wide, as it has to be: a hand that
is a few columns off is many rows off there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numba
import numpy as np

from skyline_viz.arrays import F64, U8, Int

_FAST = 40.0  # radii a second: a hand that moves so fast is led by a disc of twice the radius
_BESIDE = 4.0  # pixels that a guide is wide to either side where it chooses a line
_MOST = 5000  # points of a stroke, as operations take them


@dataclass(frozen=True)
class Guide:
    """Columns in which the line lies between two rows."""

    first: int
    """Its first column."""

    tops: tuple[int, ...]
    """First row that is allowed, in each of its columns."""

    bottoms: tuple[int, ...]
    """Last row that is allowed, in each of its columns."""

    @property
    def last(self) -> int:
        """Its last column."""
        return self.first + len(self.tops) - 1

    @property
    def columns(self) -> tuple[int, int]:
        """First and last column."""
        return self.first, self.last

    def may_forbid(self, column: int, row: int) -> bool:
        """Whether it forbids a pixel, unless it is widened there."""
        at = column - self.first
        return 0 <= at < len(self.tops) and not self.tops[at] <= row <= self.bottoms[at]

    def without(self, first: int, last: int) -> list[Guide]:
        """What is left of it when the columns from `first` to `last` are cut out."""
        until, start = max(first - self.first, 0), max(last + 1 - self.first, 0)
        parts = [
            (self.first, self.tops[:until], self.bottoms[:until]),
            (self.first + start, self.tops[start:], self.bottoms[start:]),
        ]
        return [Guide(*part) for part in parts if part[1]]

    def paint(self, mask: U8, left: int, delta: int) -> None:
        """Mark all but the corridor in some columns ``(n, H)``, and unmark the corridor.

        Args:
            mask: 1 for what is forbidden there, column by column.
            left: The first of the columns.
            delta: Largest change of row between neighbouring columns, in pixels.
        """
        tops, bottoms = self.bounds(delta)
        start, stop = max(self.first, left), min(self.last + 1, left + len(mask))
        mask[max(start - left, 0) : max(stop - left, 0)] = 1
        for column in range(start, stop):
            at = column - self.first
            mask[column - left, tops[at] : bottoms[at] + 1] = 0

    def bounds(self, delta: int) -> tuple[Int, Int]:
        """First and last row ``(n,)`` of each column, wider where the stroke is too steep.

        From every pixel between them a line leads on to both ends, however steep the stroke is.

        Args:
            delta: Largest change of row between neighbouring columns, in pixels.
        """
        tops, bottoms = np.array(self.tops, np.int32), np.array(self.bottoms, np.int32)
        climb = delta * np.arange(len(tops), dtype=np.int32)
        for turn in (slice(None), slice(None, None, -1)):  # from either side
            low, high = tops[turn], bottoms[turn]
            low[:] = np.minimum.accumulate(low - climb) + climb
            high[:] = np.maximum.accumulate(high + climb) - climb
        return tops, bottoms


def guide_along(
    points: Sequence[tuple[int, int]],
    radius: int,
    times: Sequence[int],
    size: tuple[int, int],
) -> Guide | None:
    """The corridor along a stroke; None where it lies beside the photo.

    Args:
        points: Column and row of each vertex of the stroke, in its order.
        radius: What the hand is uncertain by, in pixels of the photo.
        times: When each vertex was reached, in milliseconds; empty where nobody knows.
        size: Height and width of the photo.

    Examples:
        >>> guide_along([(2, 5), (4, 7)], 1, [], (20, 20))
        Guide(first=2, tops=(4, 5, 6), bottoms=(6, 7, 8))
    """
    height, width = size
    vertices = np.array(points, np.float64)
    low, high = vertices.min(axis=0) - radius, vertices.max(axis=0) + radius
    if (high < 0).any() or (low > (width - 1, height - 1)).any():
        return None
    radii = radii_of(vertices, radius, times)
    vertices = vertices.clip((0, -radius), (width - 1, height - 1 + radius))
    first, last = int(vertices[:, 0].min()), int(vertices[:, 0].max())
    tops, bottoms = np.full(last - first + 1, np.inf), np.full(last - first + 1, -np.inf)
    _lead(vertices[:, 0] - first, vertices[:, 1].copy(), radii, tops, bottoms)
    tops, bottoms = np.rint(tops).clip(0, height - 1), np.rint(bottoms).clip(0, height - 1)
    return Guide(first, tuple(tops.astype(int).tolist()), tuple(bottoms.astype(int).tolist()))


def along(rows: Int) -> tuple[list[tuple[int, int]], int]:
    """Points and radius of a guide that chooses a line ``(W,)``: no point a column, few are enough.

    Examples:
        >>> along(np.array([5, 6, 7, 8, 8, 8]))
        ([(0, 5), (5, 8)], 4)
    """
    for within in (_BESIDE / 2, _BESIDE, 2 * _BESIDE, 4 * _BESIDE):
        points = thinned(0, rows, within)
        if len(points) <= _MOST:
            break
    return list(points), int(2 * within)


def thinned(first: int, rows: Int, within: float) -> tuple[tuple[int, int], ...]:
    """Points of a line that lies no more than some pixels beside them (Douglas and Peucker).

    Args:
        first: Its first column.
        rows: Row in each of its columns.
        within: How many pixels.
    """
    line = np.column_stack([np.arange(first, first + len(rows)), rows]).astype(np.int32)
    points = cv2.approxPolyDP(line.reshape(-1, 1, 2), within, closed=False).reshape(-1, 2)
    return tuple((int(column), int(row)) for column, row in points)


def radii_of(vertices: F64, radius: float, times: Sequence[int]) -> F64:
    """``(n,)`` radius of the disc at each vertex: up to twice the given one where the hand is fast.

    Args:
        vertices: ``(n, 2)`` column and row.
        radius: That of a slow hand, in pixels.
        times: ``(n,)`` when each vertex was reached, in milliseconds; empty where nobody knows.

    Examples:
        >>> radii_of(np.array([[0.0, 0.0], [10.0, 0.0], [410.0, 0.0]]), 10, [0, 1000, 2000])
        array([10.25, 20.  , 20.  ])
    """
    radii = np.full(len(vertices), float(radius))
    if len(times) < 2:
        return radii
    lengths = np.hypot(*np.diff(vertices, axis=0).T)
    seconds = np.maximum(np.diff(np.array(times, np.float64)), 1.0) / 1000
    speeds = np.minimum(lengths / seconds / (_FAST * radius), 1.0)
    beside = np.concatenate([speeds[:1], speeds]), np.concatenate([speeds, speeds[-1:]])
    wider: F64 = radii * (1 + np.maximum(*beside))
    return wider


@numba.njit(cache=True, nogil=True)
def _lead(columns: F64, rows: F64, radii: F64, tops: F64, bottoms: F64) -> None:
    """Lead a disc along a stroke, and note the highest and lowest row it covers of each column.

    It is put down at every pixel of the stroke, or every quarter of its radius: between two such
    places the corridor is narrower by less than a hundredth of the radius.
    """
    _put(columns[0], rows[0], radii[0], tops, bottoms)
    for place in range(1, len(columns)):
        across, down = columns[place] - columns[place - 1], rows[place] - rows[place - 1]
        wider = radii[place] - radii[place - 1]
        stride = max(min(radii[place], radii[place - 1]) / 4, 1.0)
        steps = int(np.ceil(max(abs(across), abs(down)) / stride))
        for step in range(1, steps + 1):
            done = step / steps - 1
            _put(
                columns[place] + done * across,
                rows[place] + done * down,
                radii[place] + done * wider,
                tops,
                bottoms,
            )


@numba.njit(cache=True, nogil=True)
def _put(column: float, row: float, radius: float, tops: F64, bottoms: F64) -> None:
    """Put a disc down."""
    start = max(int(np.ceil(column - radius)), 0)
    stop = min(int(np.floor(column + radius)), len(tops) - 1)
    for place in range(start, stop + 1):
        away = place - column
        half = np.sqrt(radius * radius - away * away)
        tops[place] = min(tops[place], row - half)
        bottoms[place] = max(bottoms[place], row + half)
