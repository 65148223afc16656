"""The live wire: constraints in, skyline out, fast enough to follow the cursor.

The line is the cheapest whole path under everything that the annotator has asked for. A column
whose row is fixed (by an anchor or a span) splits the problem, so two tables of the cheapest costs,
from the left and from the right, are kept for each run of free columns:

- the cheapest line through any pixel is two walks through them: a preview needs no search;
- an anchor leaves the tables on its far sides valid: only the run in which it lies is swept again,
  and only when the next question is asked;
- the line itself needs the table from the left alone: the other one waits for the next preview;
- their sum tells the min-marginals, and those the margins, which are
  measured when somebody asks for them, a piece at a time, so that a click need not wait for all.

Two anchors that are steeper than `delta` allows are joined by a straight line: a cliff can be
labelled, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np
import numpy.typing as npt

from annotate.engine.clicks import piece_left, price_of
from annotate.engine.edits import ORIGINS, Edits
from annotate.engine.guide import Guide
from annotate.engine.plan import Plan, Run, make_plan
from annotate.engine.steering import Ground, Left
from annotate.engine.tables import BACKWARD, FORWARD, Tables
from skyline_viz.arrays import F32, F64, U8, Int, check_photo
from skyline_viz.certainty.other_lines import OtherLine, beside, other_lines, unlike
from skyline_viz.constraints import Anchor, PathError, StraightSpan
from skyline_viz.detection import Detection
from skyline_viz.method import Method
from skyline_viz.path import trace
from skyline_viz.skyline import Skyline


class LiveWire:
    """A photo's skyline while it is labelled.

    Examples:
        >>> photo = np.full((40, 60, 3), 200, np.uint8)
        >>> photo[25:] = 60
        >>> from skyline_viz import Detector
        >>> wire = LiveWire(photo, Detector())
        >>> wire.skyline.rows[:3]
        array([25., 25., 25.], dtype=float32)
        >>> float(wire.anchor(30, 20).rows[30])
        20.0
    """

    def __init__(self, photo: U8, detector: Method | None, *, keep: bool = False) -> None:
        """Find the proposal.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.
            detector: What proposes; None to label blind: nothing is proposed and nothing solved,
                and anchors are joined by straight lines.
            keep: Whether `detection` stays, for whoever shows the stages of the photo.
        """
        check_photo(photo)
        self.height, self.width = photo.shape[:2]
        self.blind = detector is None
        self.proposal: Skyline | None = None
        self.doubt = ""
        """What the detector says of its proposal where it is no skyline, or not everywhere; which
        columns are visible is for the annotator to say."""
        self.confidence = 0.0
        """Probability that the proposal is no gross miss; 0 without one."""
        self.detection: Detection | None = None
        """What the proposal is from, where it was to be kept."""
        if detector is None:
            cost, self._delta, link_weight = np.zeros((self.height, 0), np.float32), 0, 0.0
        else:
            detection = detector.detect(photo)
            cost = detection.cost
            self.proposal = detection.skyline
            self.doubt = detection.visibility.doubt if detection.visibility else ""
            self.confidence = detection.confidence
            self._delta = min(detection.delta, self.height - 1)
            link_weight = float(detection.link_weight)
            self.detection = detection if keep else None
            del detection  # its other planes, before there are tables
        columns: F32 = np.ascontiguousarray(cost.T)
        del cost
        paid = price_of(columns, self.proposal, link_weight) if self.proposal else 0.0
        self._tables = Tables(columns, self._delta, link_weight, paid)
        self._edits = Edits(self.height, self.width)
        self._plan = self._planned(self._edits)
        self._rows: Int | None = None
        if self.proposal is not None:
            self._rows = self.proposal.rows.astype(np.int32)

    @property
    def edits(self) -> Edits:
        """Everything that has been asked for. Set it to undo, or to go on where one stopped.

        Raises:
            PathError: No line is possible under it; nothing has changed then.
        """
        return self._edits

    @edits.setter
    def edits(self, edits: Edits) -> None:
        plan = self._planned(edits)
        rows: Int | None
        if plan == self._plan:
            rows = self._rows
        elif self.blind and plan.free.any():
            rows = None
        elif (new := edits.left_after(self._edits)) is not None:
            rows = self._past(edits, plan, new)
        elif (moved := edits.one_anchor_after(self._edits)) is not None:
            rows = self._through(*moved)
        elif edits.strokes[:-1] == self._edits.strokes and edits.strokes:
            rows = self._guided(edits, plan)
        else:
            rows = self._tables.solved(plan)
        self._edits, self._plan, self._rows = edits, plan, rows

    @property
    def skyline(self) -> Skyline:
        """The line as it is.

        Raises:
            PathError: The photo is labelled blind, and nothing has been drawn.
        """
        if self._rows is None:
            raise PathError("nothing has been drawn on this photo yet.")
        return self._line(self._rows)

    @property
    def empty(self) -> bool:
        """Whether there is no line yet, because the photo is labelled blind."""
        return self._rows is None

    @property
    def origin(self) -> npt.NDArray[np.uint8]:
        """``(W,)`` where the row of each column is from, as an index into `edits.ORIGINS`."""
        origin = np.full(self.width, ORIGINS.index("solved"), np.uint8)
        if self.proposal is not None and self._rows is not None:
            origin[self._rows == self.proposal.rows] = ORIGINS.index("proposal")
        origin[self._plan.straight] = ORIGINS.index("straight")
        for span in self._edits.spans:
            origin[span.first : span.last + 1] = ORIGINS.index(span.kind)
        return origin

    @property
    def margin(self) -> F64:
        """``(W,)`` margin of each column; infinite where its row is fixed, or nothing is solved."""
        return np.full(self.width, np.inf) if self.blind else self._tables.margins(self._plan)

    def measure(self, most: int) -> int:
        """Measure the margins of some columns, and return how many are left then.

        Args:
            most: How many columns at the most: at 24 megapixels 100 of them take 2 ms.
        """
        return 0 if self.blind else self._tables.measure(self._plan, most)

    def anchor(self, column: int, row: int, within: int = 0) -> Skyline:
        """Let the line pass through a pixel, and on along its ridge, and return it.

        Args:
            column: Its column.
            row: Its row.
            within: It is the best edge no more than so many rows away; 0 for exactly here.

        Raises:
            EditError: Outside the photo.
            PathError: Nothing leads there past what is forbidden.
        """
        column, row = int(column), int(row)
        row, left = self.clicked(column, row, within)
        return self._change(lambda edits: edits.anchor(column, row, left))

    def clicked(
        self, column: int, row: int, within: int = 0, lifted: int | None = None
    ) -> tuple[int, Left | None]:
        """Row of the anchor that a click sets, and the piece of the line that it leaves behind.

        Args:
            column: Column of the click.
            row: Its row.
            within: The anchor is the best edge no more than so many rows away; 0 for exactly here.
            lifted: Column of an anchor that is being dragged, and counts no more.

        Raises:
            EditError: There is no anchor in column `lifted`.
        """
        plan, rows = self._plan, self._rows
        if lifted is not None:
            plan = self._planned(self._edits.remove(lifted))
        if self.blind or not (0 <= column < self.width and 0 <= row < self.height):
            return row, None
        if within:
            row = self._tables.best_near(column, row, within)
        if lifted is not None:
            rows = self._tables.solved(plan)
        return row, None if rows is None else piece_left(self._tables, plan, rows, column, row)

    def straight(self, column: int, row: int, to_column: int, to_row: int) -> Skyline:
        """Let the line be straight between two pixels, see `Edits.straight`."""
        return self._change(lambda edits: edits.straight(column, row, to_column, to_row))

    def draw(self, first: int, rows: Iterable[int]) -> Skyline:
        """Let the line be what was drawn by hand, see `Edits.draw`."""
        return self._change(lambda edits: edits.draw(first, rows))

    def forbid(
        self, points: Iterable[tuple[int, int]], radius: int, *, allow: bool = False
    ) -> Skyline:
        """Keep the line out of a stroke of the brush, see `Edits.forbid`."""
        return self._change(lambda edits: edits.forbid(points, radius, allow=allow))

    def guide(
        self,
        points: Sequence[tuple[int, int]],
        radius: int | None = None,
        times: Sequence[int] = (),
    ) -> Skyline:
        """Let the line snap to the cheapest path along a rough stroke, and return it.

        Args:
            points: Column and row of each vertex of the stroke, in its order.
            radius: What the hand is uncertain by, in pixels; see `Edits.guide_radius`.
            times: When each vertex was reached, in milliseconds: a fast hand is less certain.

        Raises:
            EditError: Outside the photo.
            PathError: No line leads from the guide to what is fixed beside it, or the photo is
                labelled blind, and no line can snap.
        """
        return self._change(lambda edits: edits.guide(points, radius, times))

    def side(self, points: Sequence[tuple[int, int]], ground: Ground) -> Skyline:
        """Say that all above a stroke is sky, or all below it terrain, see `Edits.side`."""
        return self._change(lambda edits: edits.side(points, ground))

    def hide(self, first: int, last: int, *, hidden: bool = True, why: str = "") -> Skyline:
        """Say where the line cannot be seen, and why, see `Edits.hide`."""
        return self._change(lambda edits: edits.hide(first, last, hidden=hidden, why=why))

    def preview(self, column: int, row: int, lifted: int | None = None, within: int = 0) -> Skyline:
        """The line as it would be with one more anchor; nothing changes.

        Args:
            column: Column of the anchor.
            row: Its row.
            lifted: Column of an anchor that is being dragged, and counts no more.
            within: As for `anchor`.

        Raises:
            EditError: Outside the photo, or there is no anchor in column `lifted`.
            PathError: Nothing leads there past what is forbidden.
        """
        column, row = int(column), int(row)
        row, left = self.clicked(column, row, within, lifted)
        if left is not None and lifted is not None:
            moved = self._edits.move(lifted, column, row, left)
            return self._line(self._tables.solved(self._planned(moved)))
        if left is not None:
            edits = self._edits.anchor(column, row, left)
            return self._line(self._past(edits, self._planned(edits), column))
        return self._line(self._through(column, row, lifted))

    def preview_guide(
        self,
        points: Sequence[tuple[int, int]],
        radius: int | None = None,
        times: Sequence[int] = (),
    ) -> Skyline:
        """The line as it would be with one more guide; nothing changes. See `guide`."""
        edits = self._edits.guide(points, radius, times)
        return self._line(self._guided(edits, self._planned(edits)))

    def alternatives(self, second: Iterable[Int] = (), most: int = 4) -> list[OtherLine]:
        """Whole lines along other ridges: second opinions first, then the cheapest of its own.

        Args:
            second: Rows ``(W,)`` of lines that others have found, see `opinions`.
            most: How many at the most.
        """
        if self._rows is None or self.blind:
            return []
        cost, constraints = self._tables.costs_for(self._plan), self._plan.constraints(self._delta)
        weight = self._tables.link_weight
        theirs = beside(cost, weight, self._rows, second)
        own = other_lines(cost, self._delta, weight, self._rows, constraints, most)
        return unlike([*theirs, *own], self.height, most)

    def refresh(self, plan: Plan | None = None) -> None:
        """Bring the tables up to date: what would else be done when the next question is asked."""
        if not self.blind:
            self._tables.sweep_for(plan or self._plan, FORWARD, BACKWARD)

    def _change(self, how: Callable[[Edits], Edits]) -> Skyline:
        self.edits = how(self._edits)
        return self.skyline

    def _guided(self, edits: Edits, plan: Plan) -> Int:
        """Rows of the line with one more stroke at the end; of a guide only its columns are new.

        All else that the line may do is in the tables as they are, unless the guide takes something
        away that reaches beyond its columns.
        """
        guide, before = edits.strokes[-1], self._plan
        if (
            self._rows is None
            or not isinstance(guide, Guide)
            or plan.strokes != (*before.strokes, guide)
        ):
            return self._tables.solved(plan)
        beside = np.ones(self.width, np.bool_)
        beside[guide.first : guide.last + 1] = False
        if (
            not np.array_equal(plan.fixed[beside], before.fixed[beside])
            or not plan.free[~beside].all()
        ):
            return self._tables.solved(plan)
        rows = self._rows.copy()
        if not self._tables.follow(guide, before, rows):
            raise PathError("no line leads from the guide to what is fixed beside it.")
        return self._joined(rows, guide.first, guide.last, before)

    def _past(self, edits: Edits, plan: Plan, column: int) -> Int:
        """Rows of the line with one more anchor, for which a piece of the line is left behind."""
        left, before = edits.strokes[-1], self._plan
        run = before.run_at(column)
        if (
            self._rows is None
            or not isinstance(left, Left)
            or plan.strokes != (*before.strokes, left)
            or run is None
            or not run.left < left.columns[0] <= left.columns[1] < run.right
            or np.count_nonzero(plan.fixed != before.fixed) != 1
        ):
            return self._tables.solved(plan)
        rows = self._rows.copy()
        if not self._tables.follow_past(left, column, edits.anchors[column], before, rows):
            return self._tables.solved(plan)  # a cliff
        return self._joined(rows, *left.columns, before)

    def _joined(self, rows: Int, first: int, last: int, plan: Plan) -> Int:
        """Rows of the line when those of some columns are given, and lead on to both sides."""
        first, last = max(first, 0), min(last, self.width - 1)
        for column, table, step in (
            (first, self._tables.forward, -1),
            (last, self._tables.backward, 1),
        ):
            run = plan.run_at(column + step)
            if run is not None:
                end = run.left + 1 if step < 0 else run.right - 1
                trace(table, self._tables.reach, self._tables.link_weight, rows, column, end)
        return rows

    def _planned(self, edits: Edits) -> Plan:
        if self.blind and any(isinstance(one, Guide) for one in edits.strokes):
            raise PathError("the photo is labelled blind, so a guide has nothing to snap to.")
        return make_plan(edits, None if self.blind else self._delta)

    def _line(self, rows: Int) -> Skyline:
        return Skyline(rows=rows.astype(np.float32), visible=~self._edits.hidden_mask())

    def _through(self, column: int, row: int, lifted: int | None) -> Int:
        """Rows of the line with one more anchor; walks where the column is free."""
        edits = self._edits if lifted is None else self._edits.remove(lifted)
        anchored = edits.anchor(column, row)  # drops the span in which it lies
        plan = self._planned(anchored)
        if self.blind or plan.strokes != edits.strokes:  # something is cleared around an anchor
            return self._tables.solved(plan)
        free = self._planned(anchored.remove(column))
        base = self._rows if free == self._plan else None
        rows = self._tables.solved(free).copy() if base is None else base.copy()
        self.refresh(free)
        run = free.run_at(column)
        if run is None:  # a cliff between two anchors
            return self._tables.solved(plan)
        rows[column] = row
        self._walk(rows, column, run, self._tables.forward, run.left)
        self._walk(rows, column, run, self._tables.backward, run.right)
        return rows

    def _walk(self, rows: Int, column: int, run: Run, table: F64, end: int) -> None:
        """Fill the rows between a pixel and the end of its run, on one side."""
        step = 1 if end > column else -1
        end_row = run.left_row if step < 0 else run.right_row
        row = int(rows[column])
        if end_row is not None and abs(row - end_row) > self._delta * abs(end - column):
            start, stop = sorted([Anchor(column, row), Anchor(end, end_row)])
            rows[start.column : stop.column + 1] = StraightSpan(start, stop).rows()
            return
        if end == column + step:  # nothing between them
            return
        near = slice(max(row - self._delta, 0), row + self._delta + 1)
        if not np.isfinite(table[column + step, near]).any():
            raise PathError(f"nothing leads to column {column}, row {row} past what is forbidden.")
        trace(table, self._tables.reach, self._tables.link_weight, rows, column, end - step)
