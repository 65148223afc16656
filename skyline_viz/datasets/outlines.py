"""Geometry of drawn labels: lines and regions in, rows of a skyline out.

A pixel belongs to a region if its centre does, and a column sees a line where its centre does;
with that, what we write comes back exactly. The library functions for polygons ask about each
pixel of the box, or take the border for inside; here each edge is asked for the columns it
crosses.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Points: TypeAlias = npt.NDArray[np.float64]
"""Corners ``(n, 2)``, each x rightwards and y downwards from the photo's corner, in pixels."""

_MOST_CROSSINGS = 50_000_000


class FormatError(ValueError):
    """A file or what it draws is not of its format; the message is one sentence that says why."""


@dataclass(frozen=True)
class Runs:
    """A run-length encoded region in a box of a photo: runs outside and inside by turns."""

    lengths: tuple[int, ...]
    height: int
    width: int
    """Of the box."""
    left: int = 0
    top: int = 0
    """Where the box lies in the photo."""
    by_column: bool = True
    """Whether runs go down the columns of the whole photo, as in COCO, or along the rows, as in
    CVAT."""

    def check(self) -> None:
        """Refuse runs that are no region.

        Raises:
            FormatError: They do not fill the box.
        """
        if sum(self.lengths) != self.height * self.width or min(self.lengths, default=0) < 0:
            raise FormatError(f"run lengths do not fill {self.width}x{self.height} pixels")

    def mask(self, height: int, width: int) -> npt.NDArray[np.bool_]:
        """The region in a photo of this size, ``(height, width)``.

        Raises:
            FormatError: The runs do not fill the box, or the box lies outside.
        """
        if self.by_column and (self.height, self.width) != (height, width):
            raise FormatError(f"its run lengths are for {self.width}x{self.height} pixels")
        inside = 0 <= self.left <= self.left + self.width <= width
        if not inside or not 0 <= self.top <= self.top + self.height <= height:
            raise FormatError("a mask lies outside the photo")
        self.check()
        runs = np.repeat(np.arange(len(self.lengths)) % 2 == 1, self.lengths)
        box = (
            runs.reshape(self.width, self.height).T
            if self.by_column
            else runs.reshape(self.height, self.width)
        )
        mask: npt.NDArray[np.bool_] = np.zeros((height, width), np.bool_)
        mask[self.top : self.top + self.height, self.left : self.left + self.width] = box
        return mask


def points_of(told: Any) -> Points:  # noqa: ANN401
    """Pairs of numbers as points.

    Raises:
        FormatError: They are none, or far outside any photo.
    """
    try:
        points = np.array(told, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise FormatError("points are no pairs of numbers") from None
    if points.ndim != 2 or points.shape[1] != 2:
        raise FormatError("points are no pairs of numbers")
    if not np.isfinite(points).all() or np.abs(points).max(initial=0) > 1e6:
        raise FormatError("a point is not finite, or far outside any photo")
    return points


def check_pixels(rings: Sequence[Points]) -> None:
    """Refuse a shape whose coordinates are shares of the photo's sides.

    Raises:
        FormatError: All points lie within a pixel of the corner, and are not one point.
    """
    points = np.concatenate([np.zeros((0, 2)), *rings])
    if np.abs(points).max(initial=0) <= 1 and np.ptp(points, axis=0).any():
        raise FormatError(
            "its points lie within one pixel of the corner: coordinates must be in pixels"
        )


def polygon_mask(
    rings: Iterable[Points], height: int, width: int
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """The union of polygons.

    Returns:
        The pixels inside ``(height, width)``, and the columns ``(width,)`` that a polygon reaches,
        if only as an edge along the top.

    Raises:
        FormatError: A polygon has too many edges.
    """
    mask: npt.NDArray[np.bool_] = np.zeros((height, width), np.bool_)
    reached: npt.NDArray[np.bool_] = np.zeros(width, np.bool_)
    for ring in rings:
        columns, rows = _crossings(ring, np.roll(ring, -1, axis=0), width, closed=False)
        toggles: npt.NDArray[np.int32] = np.zeros((height + 1, width), np.int32)
        np.add.at(toggles, (np.ceil(rows - 0.5).clip(0, height).astype(np.intp), columns), 1)
        mask |= np.cumsum(toggles[:-1], axis=0) % 2 == 1
        reached[columns] = True
    return mask, reached


def line_rows(
    lines: Sequence[Points], height: int, width: int
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.bool_]]:
    """Rows of lines: straight between points, the upper one where a line runs back over itself.

    Returns:
        Rows ``(width,)``, whole ones, and the columns that a line reaches.

    Raises:
        FormatError: A line leaves the photo by more than a hand does, or never reaches it.
    """
    rows = np.full(width, np.inf)
    for line in lines:
        columns, ys = _crossings(line[:-1], line[1:], width, closed=True)
        np.minimum.at(rows, columns, ys)
        for end in (line[:, 0].min(), line[:, 0].max()):  # half a pixel of its first and last
            column = int(np.floor(end))
            if 0 <= column < width and not np.isfinite(rows[column]):
                rows[column] = line[line[:, 0] == end, 1].min()
    reached = np.isfinite(rows)
    if not reached.any():
        raise FormatError("no point of the line lies inside the photo")
    rows = np.floor(np.where(reached, rows, 0) + 0.5)
    beyond = max(3.0, 0.01 * height)
    if rows.min() < -beyond or rows.max() > height + beyond:
        outside = rows.min() if rows.min() < -beyond else rows.max()
        raise FormatError(f"row {outside:g} of the line lies outside a height of {height}")
    return rows.clip(0, height), reached


def own_rows(line: Points, width: int) -> npt.NDArray[np.float64]:
    """Rows ``(width,)`` of one line, the upper ones; infinite in columns that it does not cross."""
    rows = np.full(width, np.inf)
    columns, ys = _crossings(line[:-1], line[1:], width, closed=True)
    np.minimum.at(rows, columns, ys)
    return rows


def _crossings(
    starts: Points, ends: Points, width: int, *, closed: bool
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.float64]]:
    """Where edges cross the centres of columns: the columns, and y of each.

    An edge owns its left end, and its right end only if it is `closed`: of two edges that meet at
    a centre one crosses it, where crossings are counted.
    """
    order = (starts[:, 0] <= ends[:, 0])[:, None]
    left, right = np.where(order, starts, ends), np.where(order, ends, starts)
    first = np.ceil(left[:, 0] - 0.5).clip(0, width).astype(np.int64)
    stop = (np.floor(right[:, 0] + 0.5) if closed else np.ceil(right[:, 0] - 0.5)).clip(0, width)
    counts = np.maximum(stop.astype(np.int64) - first, 0)
    if counts.sum() > _MOST_CROSSINGS:
        raise FormatError("a shape has too many corners")
    edge = np.repeat(np.arange(len(counts)), counts)
    offset = np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts)
    columns = (first[edge] + offset).astype(np.intp)
    span = right[edge, 0] - left[edge, 0]
    share = (columns + 0.5 - left[edge, 0]) / np.where(span == 0, 1, span)
    ys = left[edge, 1] + share * (right[edge, 1] - left[edge, 1])
    upright = span == 0
    ys[upright] = np.minimum(left[edge, 1], right[edge, 1])[upright]
    return columns, ys
