"""What steers a line without fixing it: the brush, guides, sides to keep to, and lines left behind.

Most of them forbid pixels. They hold in their order: a guide and the eraser allow again what was
forbidden before. An anchor is stronger than all of them, see `clearings`.

A line that a click left is not forbidden, but dearer: near the click the photo has another ridge,
and the line had better follow that. Where nothing else leads on, it still may come back.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

import cv2
import numpy as np

from annotate.engine.guide import Guide
from skyline_viz.arrays import U8

_AROUND = 4  # pixels that are cleared around an anchor, beyond what it takes to get there

FREE, FORBIDDEN, DEARER = 0, 1, 2
"""What is marked in a mask: nothing, pixels that the line must not visit, pixels that cost more."""

Ground: TypeAlias = Literal["sky", "terrain"]
"""What an annotator says of all pixels on one side of a stroke."""


@dataclass(frozen=True)
class _Thick:
    """A thick line."""

    points: tuple[tuple[int, int], ...]
    """Column and row of each point of its centre line."""

    radius: int
    """Half its width, in pixels."""

    @cached_property
    def columns(self) -> tuple[int, int]:
        """First and last column that it may touch."""
        across = [column for column, _ in self.points]
        return min(across) - self.radius - 1, max(across) + self.radius + 1

    @cached_property
    def rows(self) -> tuple[int, int]:
        """First and last row that it may touch."""
        down = [row for _, row in self.points]
        return min(down) - self.radius - 1, max(down) + self.radius + 1

    def _draw(self, mask: U8, left: int, value: int) -> None:
        # x runs down a column here
        points = [(row, column - left) for column, row in self.points]
        for start, end in zip(points, [*points[1:], points[-1]], strict=True):
            cv2.line(mask, start, end, value, 2 * self.radius + 1)
            cv2.circle(mask, end, self.radius, value, -1)


@dataclass(frozen=True)
class Stroke(_Thick):
    """A stroke of the brush: where the line must not go, or, of the eraser, may go again."""

    allow: bool = False
    """Whether it is the eraser's."""

    def may_forbid(self, column: int, row: int) -> bool:
        """Whether it may forbid a pixel: a quick look at what lies far off."""
        (left, right), (top, bottom) = self.columns, self.rows
        return not self.allow and left <= column <= right and top <= row <= bottom

    def without(self, first: int, last: int) -> list[Stroke]:
        """Itself, unless it begins in the columns from `first` to `last`."""
        return [] if first <= self.points[0][0] <= last else [self]

    def paint(self, mask: U8, left: int) -> None:
        """Mark what it forbids, and unmark what it allows, in some columns ``(n, H)``.

        Args:
            mask: What is marked there, column by column.
            left: The first of the columns.
        """
        self._draw(mask, left, FREE if self.allow else FORBIDDEN)


@dataclass(frozen=True)
class Left(_Thick):
    """A piece of the line that a click has left for another ridge: it costs more from then on."""

    of: int
    """Column of the anchor; the piece goes with it."""

    def may_forbid(self, *_: int) -> bool:
        """It forbids nothing."""
        return False

    def without(self, first: int, last: int) -> list[Left]:
        """What is left of it when the columns from `first` to `last` are cut out."""
        parts = (
            tuple(point for point in self.points if point[0] < first),
            tuple(point for point in self.points if point[0] > last),
        )
        return [Left(points, self.radius, self.of) for points in parts if points]

    def paint(self, mask: U8, left: int) -> None:
        """Mark what it makes dearer, but for what is forbidden, see `Stroke.paint`."""
        drawn = np.zeros_like(mask)
        self._draw(drawn, left, DEARER)
        np.copyto(mask, drawn, where=(mask == FREE))


@dataclass(frozen=True)
class Side:
    """Columns in which all above a stroke is sky, or all below it is terrain."""

    first: int
    """Its first column."""

    rows: tuple[int, ...]
    """Row of the stroke in each of its columns, in which the line may still lie."""

    ground: Ground = "sky"
    """``sky``: of all above it; ``terrain``: of all below it."""

    @property
    def last(self) -> int:
        """Its last column."""
        return self.first + len(self.rows) - 1

    @property
    def columns(self) -> tuple[int, int]:
        """First and last column."""
        return self.first, self.last

    def may_forbid(self, column: int, row: int) -> bool:
        """Whether it forbids a pixel."""
        at = column - self.first
        if not 0 <= at < len(self.rows):
            return False
        return row < self.rows[at] if self.ground == "sky" else row > self.rows[at]

    def without(self, first: int, last: int) -> list[Side]:
        """What is left of it when the columns from `first` to `last` are cut out."""
        until, start = max(first - self.first, 0), max(last + 1 - self.first, 0)
        parts = [(self.first, self.rows[:until]), (self.first + start, self.rows[start:])]
        return [Side(*part, self.ground) for part in parts if part[1]]

    def paint(self, mask: U8, left: int) -> None:
        """Mark what it forbids, see `Stroke.paint`."""
        for column in range(max(self.first, left), min(self.last + 1, left + len(mask))):
            row = self.rows[column - self.first]
            mask[column - left, slice(0, row) if self.ground == "sky" else slice(row + 1, None)] = (
                FORBIDDEN
            )


def side_of(
    points: Sequence[tuple[int, int]], ground: Ground, size: tuple[int, int]
) -> Side | None:
    """The side of a stroke; None where it lies beside the photo.

    Where the stroke comes back over its columns, all of its rows count: what lies above any of them
    is sky.

    Args:
        points: Column and row of each vertex of the stroke, in its order.
        ground: Which side: sky above, or terrain below.
        size: Height and width of the photo.

    Examples:
        >>> side_of([(2, 5), (4, 7), (3, 9)], "sky", (20, 20))
        Side(first=2, rows=(5, 9, 7), ground='sky')
    """
    height, width = size
    found = np.full(width, -1 if ground == "sky" else height, np.int32)
    pick = np.maximum if ground == "sky" else np.minimum
    for (column, row), (to_column, to_row) in zip(points, [*points[1:], points[-1]], strict=True):
        start, end = sorted([(column, row), (to_column, to_row)])
        places = np.arange(max(start[0], 0), min(end[0], width - 1) + 1)
        ends = [start[0], end[0]], [start[1], end[1]]
        rows = np.rint(np.interp(places, *ends)).astype(np.int32)
        if start[0] == end[0]:
            rows[:] = pick(row, to_row)
        found[places] = pick(found[places], rows)
    across = [column for column, _ in points]
    first, last = max(min(across), 0), min(max(across), width - 1)
    if first > last:
        return None
    return Side(first, tuple(found[first : last + 1].clip(0, height - 1).tolist()), ground)


Steering: TypeAlias = Stroke | Guide | Side | Left
"""What steers the line: it forbids pixels, makes them dearer, or allows them again."""


def clearings(
    anchors: Mapping[int, int], strokes: Sequence[Steering], size: tuple[int, int]
) -> tuple[Stroke, ...]:
    """Strokes of an eraser around anchors that lie where the line must not go.

    They are round, and reach past what is forbidden above or below, so that a line leads to each of
    them. What is cleared is not kept: it is forbidden again when the anchor is gone.

    Args:
        anchors: Row of the anchor of each column that has one.
        strokes: What steers the line.
        size: Height and width of the photo.
    """
    height, width = size
    found = []
    for column, row in anchors.items():
        if not any(one.may_forbid(column, row) for one in strokes):
            continue
        near = [one for one in strokes if one.columns[0] <= column <= one.columns[1]]
        forbidden = paint(near, height, width, only=column)[0] == FORBIDDEN
        if forbidden[row]:
            allowed = np.flatnonzero(~forbidden)
            away = int(np.abs(allowed - row).min()) if len(allowed) else height
            found.append(Stroke(((column, row),), away + away // 2 + _AROUND, allow=True))
    return tuple(found)


def paint(
    strokes: Iterable[Steering],
    height: int,
    width: int,
    onto: U8 | None = None,
    *,
    delta: int = 1,
    only: int | None = None,
) -> U8:
    """What strokes mark, ``(W, H)``, column by column as path tables are.

    Args:
        strokes: What steers, in its order.
        height: Rows of the photo.
        width: Its columns.
        onto: What earlier ones have marked; it is painted on.
        delta: Largest change of row between neighbouring columns, in pixels.
        only: The only column to paint; the result is ``(1, H)`` then.
    """
    left, count = (0, width) if only is None else (only, 1)
    mask: U8 = np.zeros((count, height), np.uint8) if onto is None else onto
    for one in strokes:
        if isinstance(one, Guide):
            one.paint(mask, left, delta)
        else:
            one.paint(mask, left)
    return mask
