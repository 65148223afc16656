"""Which columns of a line are fixed, which runs between them are solved, and what is stale."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from annotate.engine.edits import Edits
from annotate.engine.steering import Steering, clearings
from skyline_viz.arrays import Bool, Int, read_only, runs
from skyline_viz.constraints import Anchor, Constraints, StraightSpan


@dataclass(frozen=True)
class Run:
    """Free columns between two fixed ones, or between a fixed one and an edge of the photo."""

    left: int
    """The fixed column left of it; -1 at the left edge."""

    left_row: int | None
    """Its row; None at the left edge."""

    right: int
    """The fixed column right of it; the photo's width at the right edge."""

    right_row: int | None
    """Its row; None at the right edge."""


@dataclass(frozen=True)
class Stale:
    """Columns of a run that are to be swept again."""

    run: Run
    """The run."""

    first: int
    """Where the sweep begins."""

    last: int
    """Where it ends: the run's last column, or its first one."""

    forward: bool
    """Whether it is the table of costs from the left, which is swept to the right."""


@dataclass(frozen=True, eq=False)
class Plan:
    """What there is to solve."""

    fixed: Int
    """``(W,)`` row of each fixed column; -1 where it is free."""

    straight: Bool
    """``(W,)`` columns of straight lines between anchors that are too steep to be solved, or that
    are not solved because the photo is labelled blind."""

    strokes: tuple[Steering, ...]
    """Where the line must not go, and where it may again."""

    def __eq__(self, other: object) -> bool:
        """Equal fixed rows and strokes: equal problems."""
        if not isinstance(other, Plan):
            return NotImplemented
        return self.strokes == other.strokes and np.array_equal(self.fixed, other.fixed)

    __hash__ = None  # type: ignore[assignment]

    @cached_property
    def free(self) -> Bool:
        """``(W,)`` columns that are to be solved."""
        return self.fixed < 0

    @cached_property
    def runs(self) -> tuple[Run, ...]:
        """Runs of free columns, from left to right."""
        width = len(self.fixed)
        return tuple(
            Run(
                first - 1,
                int(self.fixed[first - 1]) if first > 0 else None,
                last + 1,
                int(self.fixed[last + 1]) if last + 1 < width else None,
            )
            for first, last in runs(self.free)
        )

    def run_at(self, column: int) -> Run | None:
        """The run that holds a column; None where it is fixed."""
        return next((run for run in self.runs if run.left < column < run.right), None)

    def constraints(self, delta: int) -> Constraints | None:
        """What is fixed, for a search of whole lines; None where nothing is.

        Args:
            delta: Largest change of row between neighbouring columns that are not fixed.
        """
        fixed = [Anchor(at, int(self.fixed[at])) for at in np.flatnonzero(~self.free).tolist()]
        steep = [
            StraightSpan(one, other)
            for one, other in pairwise(fixed)
            if other.column == one.column + 1 and abs(other.row - one.row) > delta
        ]
        return Constraints(tuple(fixed), tuple(steep)) if fixed else None

    def stale(self, tabled: Plan | None, changed: tuple[int, int] | None) -> list[Stale]:
        """Columns that have to be swept again, run by run.

        Args:
            tabled: The plan that the tables belong to; None when they are empty.
            changed: First and last column whose costs are other ones now.

        Returns:
            At most two parts of each run, one of each table.
        """
        old = tabled.runs if tabled else ()
        lefts = {(run.left, run.left_row): run for run in old}
        rights = {(run.right, run.right_row): run for run in old}
        stale = []
        for run in self.runs:
            same = lefts.get((run.left, run.left_row))
            first = min(same.right, run.right) if same else run.left + 1
            same = rights.get((run.right, run.right_row))
            last = max(same.left, run.left) if same else run.right - 1
            if changed and changed[0] < run.right and changed[1] > run.left:
                first = min(first, max(changed[0], run.left + 1))
                last = max(last, min(changed[1], run.right - 1))
            if first < run.right:
                stale.append(Stale(run, first, run.right - 1, forward=True))
            if last > run.left:
                stale.append(Stale(run, last, run.left + 1, forward=False))
        return stale


def painted_between(
    before: tuple[Steering, ...], after: tuple[Steering, ...], width: int
) -> tuple[int, int] | None:
    """First and last column that some strokes may forbid otherwise than others; None for none."""
    same = 0
    for one, other in zip(before, after, strict=False):
        if one is not other and one != other:
            break
        same += 1
    touched = [stroke.columns for stroke in (*before[same:], *after[same:])]
    if not touched:
        return None
    return max(min(one for one, _ in touched), 0), min(max(one for _, one in touched), width - 1)


def make_plan(edits: Edits, delta: int | None) -> Plan:
    """Fix what the annotator has fixed.

    Args:
        edits: What has been asked for.
        delta: Largest change of row between neighbouring columns: fixed pixels that are steeper
            are joined by a straight line. None joins all of them, and goes on level to the edges.
    """
    fixed = np.full(edits.width, -1, np.int32)
    straight: Bool = np.zeros(edits.width, np.bool_)
    for span in edits.spans:
        fixed[span.first : span.last + 1] = span.rows
    fixed[list(edits.anchors)] = list(edits.anchors.values())
    columns = np.flatnonzero(fixed >= 0)
    if len(columns):
        steps, climbs = np.diff(columns), np.abs(np.diff(fixed[columns]))
        joined = steps > 1 if delta is None else (steps > 1) & (climbs > delta * steps)
        for place in np.flatnonzero(joined).tolist():
            start, end = columns[place : place + 2].tolist()
            line = StraightSpan(Anchor(start, int(fixed[start])), Anchor(end, int(fixed[end])))
            fixed[start : end + 1] = line.rows()
            straight[start + 1 : end] = True
        if delta is None:
            first, last = columns[[0, -1]].tolist()
            fixed[:first], fixed[last + 1 :] = fixed[first], fixed[last]
            straight[:first] = straight[last + 1 :] = True
    read_only(fixed)
    read_only(straight)
    cleared = clearings(edits.anchors, edits.strokes, (edits.height, edits.width))
    return Plan(fixed, straight, (*edits.strokes, *cleared))
