"""What an annotator has asked of a skyline: anchors, spans, the forbidden brush, hidden columns.

`Edits` is a value: each change gives a new one, and the order of changes does not need to be known
to solve it. Where two changes contradict each other, the later one holds: an anchor takes the place
of the straight span in whose columns it lies, and of a piece of any other; a span takes the place
of anchors and cuts other spans; a guide takes the place of both. Anchors and spans are stronger
than the brush, guides and sides, which only steer what is solved: what they forbid is allowed again
around an anchor, see `steering.clearings`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Literal, get_args

import numpy as np

from annotate.engine.guide import guide_along
from annotate.engine.hidden import Hidden, hidden_too, shown_again
from annotate.engine.steering import Ground, Left, Steering, Stroke, side_of
from skyline_viz.arrays import Bool
from skyline_viz.constraints import Anchor, StraightSpan

Origin = Literal["proposal", "solved", "straight", "drawn"]
ORIGINS: tuple[Origin, ...] = get_args(Origin)
"""Where the row of a column is from: offered by the detector and not changed since; solved under
what the annotator asked for; on a straight span; drawn by hand."""


class EditError(ValueError):
    """An edit does not make sense for the photo; the message is one sentence that says why."""


@dataclass(frozen=True)
class Span:
    """Columns in which the annotator has fixed the row of the line."""

    kind: Origin
    """How its rows came about: straight between two pixels, drawn by hand, or, where they are taken
    from another pass, as in that one."""

    first: int
    """Its first column."""

    rows: tuple[int, ...]
    """Row in each of its columns."""

    @property
    def last(self) -> int:
        """Its last column."""
        return self.first + len(self.rows) - 1

    def without(self, first: int, last: int) -> list[Span]:
        """What is left of it when the columns from `first` to `last` are cut out."""
        left = self.rows[: max(first - self.first, 0)]
        right = self.rows[max(last + 1 - self.first, 0) :]
        parts = [(self.first, left), (self.last + 1 - len(right), right)]
        return [Span(self.kind, start, rows) for start, rows in parts if rows]


@dataclass(frozen=True)
class Edits:
    """All that an annotator has asked for on one photo of `height` rows and `width` columns."""

    height: int
    width: int
    anchors: Mapping[int, int] = field(default_factory=lambda: MappingProxyType({}))
    """Row of the anchor of each column that has one."""

    spans: tuple[Span, ...] = ()
    """Columns with fixed rows; no two of them share a column."""

    strokes: tuple[Steering, ...] = ()
    """Strokes of the brush and of its eraser, guides, and sides, in their order."""

    hidden: tuple[Hidden, ...] = ()
    """Runs of columns in which the line cannot be seen, from left to right."""

    def anchor(self, column: int, row: int, left: Left | None = None) -> Edits:
        """Let the line pass through a pixel.

        Args:
            column: Its column.
            row: Its row.
            left: The piece of the line that is left for the ridge of the pixel.
        """
        self._require_inside(column, row)
        around = self._around
        spans: list[Span] = []
        for span in self.spans:
            if not span.first <= column <= span.last:
                spans.append(span)
            elif span.kind != "straight":
                spans += span.without(column - around, column + around)
        strokes = (*self.strokes, left) if left else self.strokes
        return self._with(anchors={**self.anchors, column: row}, spans=spans, strokes=strokes)

    def move(self, from_column: int, column: int, row: int, left: Left | None = None) -> Edits:
        """Move an anchor to another pixel; what was left for it counts no more."""
        return self.remove(from_column).anchor(column, row, left)

    def remove(self, column: int) -> Edits:
        """Take an anchor away."""
        if column not in self.anchors:
            raise EditError(f"there is no anchor in column {column}.")
        return self._with(anchors={one: row for one, row in self.anchors.items() if one != column})

    def straight(self, column: int, row: int, to_column: int, to_row: int) -> Edits:
        """Let the line be straight between two pixels, which may be given in either order."""
        self._require_inside(column, row)
        self._require_inside(to_column, to_row)
        if column == to_column:
            raise EditError("a straight span begins and ends in different columns.")
        start, end = sorted([Anchor(column, row), Anchor(to_column, to_row)])
        rows = tuple(StraightSpan(start, end).rows().tolist())
        return self._span(Span("straight", start.column, rows))

    def draw(self, first: int, rows: Iterable[int]) -> Edits:
        """Let the line be what was drawn by hand, a row a column from column `first` on."""
        span = Span("drawn", first, tuple(rows))
        if not span.rows:
            raise EditError("a drawn span has at least one column.")
        for column, row in ((first, min(span.rows)), (span.last, max(span.rows))):
            self._require_inside(column, row)
        return self._span(span)

    def take(
        self,
        first: int,
        rows: Sequence[int],
        origins: Iterable[tuple[Origin, int]],
        hidden: Iterable[tuple[int, int]],
    ) -> Edits:
        """Let the line be what other passes have, a row a column from column `first` on.

        Args:
            first: The first column.
            rows: A row for each column.
            origins: Where these are from: an origin, and in how many columns, from left to right.
            hidden: First and last column of each run in which the line cannot be seen.
        """
        origins, last = list(origins), first + len(rows) - 1
        if not rows or sum(many for _, many in origins) != len(rows):
            raise EditError("what is taken over has an origin for each of its columns.")
        for column, row in ((first, min(rows)), (last, max(rows))):
            self._require_inside(column, row)
        taken, start = self, 0
        for origin, many in origins:
            taken = taken._span(Span(origin, first + start, tuple(rows[start : start + many])))
            start += many
        taken = taken.hide(first, last, hidden=False)
        for one, other in hidden:
            if not first <= one <= other <= last:
                raise EditError("what is taken over is hidden in columns that it does not have.")
            taken = taken.hide(one, other)
        return taken

    def forbid(
        self, points: Iterable[tuple[int, int]], radius: int, *, allow: bool = False
    ) -> Edits:
        """Keep the line out of a stroke of the brush; with `allow`, erase what was forbidden."""
        stroke = Stroke(tuple((column, row) for column, row in points), radius, allow)
        if not stroke.points or radius < 0:
            raise EditError("a stroke has at least one point, and a radius of 0 or more.")
        if stroke.columns[1] < 0 or stroke.columns[0] >= self.width:
            raise EditError("the stroke lies outside the photo.")
        return self._with(strokes=(*self.strokes, stroke))

    def guide(
        self,
        points: Sequence[tuple[int, int]],
        radius: int | None = None,
        times: Sequence[int] = (),
    ) -> Edits:
        """Let the line lie along a rough stroke, see `guide.guide_along`.

        Args:
            points: Column and row of each vertex of the stroke, in its order.
            radius: What the hand is uncertain by, in pixels; `guide_radius` unless given.
            times: When each vertex was reached, in milliseconds; empty where nobody knows.
        """
        radius = self.guide_radius if radius is None else radius
        if not len(points) or radius < 1:
            raise EditError("a guide has at least one point, and a radius of 1 or more.")
        if len(times) not in (0, len(points)):
            raise EditError("a guide has a time for each of its points, or none.")
        guide = guide_along(points, radius, times, (self.height, self.width))
        if guide is None:
            raise EditError("the guide lies outside the photo.")
        around = self._around  # a line leads from the guide to what is left of a span
        parts = (one.without(guide.first - around, guide.last + around) for one in self.spans)
        spans = [part for several in parts for part in several]
        kept = {at: row for at, row in self.anchors.items() if not guide.first <= at <= guide.last}
        return self._with(anchors=kept, spans=spans, strokes=(*self.strokes, guide))

    def side(self, points: Sequence[tuple[int, int]], ground: Ground) -> Edits:
        """Say that all above a stroke is sky, or that all below it is terrain.

        Args:
            points: Column and row of each vertex of the stroke; the line may still lie on it.
            ground: Which of the two.
        """
        if not len(points):
            raise EditError("a side has at least one point.")
        side = side_of(points, ground, (self.height, self.width))
        if side is None:
            raise EditError("the stroke lies outside the photo.")
        return self._with(strokes=(*self.strokes, side))

    @property
    def _around(self) -> int:
        """Columns that are free beside something new, so that a line leads there."""
        return max(self.width // 50, 8)

    @property
    def guide_radius(self) -> int:
        """What a hand is uncertain by where nobody says it, in pixels."""
        return max(self.height // 50, 12)

    def hide(self, first: int, last: int, *, hidden: bool = True, why: str = "") -> Edits:
        """Say that the line cannot be seen in columns `first` to `last`, or can be seen again.

        Args:
            first: First column.
            last: Last column.
            hidden: Whether it cannot be seen.
            why: What hides it, in a word or two; said again, it takes the place of what was said.
        """
        first, last = self._require_columns(first, last)
        if not hidden:
            return self._with(hidden=shown_again(self.hidden, first, last))
        return self._with(hidden=hidden_too(self.hidden, Hidden(first, last, why)))

    def release(self, first: int, last: int) -> Edits:
        """Drop what was asked for in columns `first` to `last`, and strokes that begin there."""
        first, last = self._require_columns(first, last)
        kept = {one: row for one, row in self.anchors.items() if not first <= one <= last}
        spans = [part for span in self.spans for part in span.without(first, last)]
        steering = [part for one in self.strokes for part in one.without(first, last)]
        return self._with(anchors=kept, spans=spans, strokes=steering).hide(
            first, last, hidden=False
        )

    def one_anchor_after(self, before: Edits) -> tuple[int, int, int | None] | None:
        """Column and row of the anchor by which these edits differ, where that is all.

        Returns:
            Its column, its row, and the column of the anchor that was moved there, None for a new
            anchor. None when something else differs, too.
        """
        if (self.spans, self.strokes) != (before.spans, before.strokes):
            return None
        new = dict(self.anchors.items() - before.anchors.items())
        old = dict(before.anchors.items() - self.anchors.items())
        if len(new) != 1 or len(old) > 1:
            return None
        return (*new.popitem(), next(iter(old), None))

    def left_after(self, before: Edits) -> int | None:
        """Column of the anchor for which a piece of the line was left, where that is all there is.

        None when something else differs, too.
        """
        left = self.strokes[len(before.strokes) :]
        if self.spans != before.spans or self.strokes != (*before.strokes, *left):
            return None
        new = self.anchors.items() - before.anchors.items()
        if len(new) != 1 or before.anchors.items() - self.anchors.items():
            return None
        return new.pop()[0] if len(left) == 1 and isinstance(left[0], Left) else None

    def hidden_mask(self) -> Bool:
        """``(W,)`` True where the line cannot be seen."""
        mask: Bool = np.zeros(self.width, np.bool_)
        for first, last, _ in self.hidden:
            mask[first : last + 1] = True
        return mask

    def _span(self, span: Span) -> Edits:
        spans = [part for one in self.spans for part in one.without(span.first, span.last)]
        kept = {at: row for at, row in self.anchors.items() if not span.first <= at <= span.last}
        return self._with(anchors=kept, spans=[*spans, span])

    def _with(
        self,
        anchors: Mapping[int, int] | None = None,
        spans: Iterable[Span] | None = None,
        strokes: Iterable[Steering] | None = None,
        hidden: tuple[Hidden, ...] | None = None,
    ) -> Edits:
        held = self.anchors if anchors is None else MappingProxyType(dict(anchors))
        steering = self.strokes if strokes is None else tuple(strokes)
        return replace(
            self,
            anchors=held,
            spans=self.spans if spans is None else tuple(spans),
            strokes=tuple(one for one in steering if not isinstance(one, Left) or one.of in held),
            hidden=self.hidden if hidden is None else hidden,
        )

    def _require_inside(self, column: int, row: int) -> None:
        if not (0 <= column < self.width and 0 <= row < self.height):
            raise EditError(
                f"column {column}, row {row} lies outside the photo of "
                f"{self.width}x{self.height} pixels."
            )

    def _require_columns(self, first: int, last: int) -> tuple[int, int]:
        first, last = min(first, last), max(first, last)
        if last < 0 or first >= self.width:
            raise EditError(f"columns {first} to {last} lie outside the photo.")
        return max(first, 0), min(last, self.width - 1)
