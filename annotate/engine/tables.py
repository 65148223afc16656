"""The tables of the cheapest costs, from the left and from the right, and what is stale of them.

They belong to a plan. When another one is asked for, only what it changes is swept again: in a run
whose costs or whose end have changed, from there on. Far from a change all costs differ from those
before by one and the same amount, and a sweep ends there: nothing that is asked of a table depends
on an amount that is the same for a whole column.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np

from annotate.engine.corridor import follow
from annotate.engine.guide import Guide
from annotate.engine.plan import Plan, Stale, painted_between
from annotate.engine.steering import DEARER, FORBIDDEN, FREE, Left, Steering, paint
from skyline_viz.arrays import F32, F64, U8, Int, runs
from skyline_viz.constraints import PathError
from skyline_viz.path import APART, cheapest_end, column_margin, min_marginals, sweep, trace

FORWARD, BACKWARD = True, False
"""The table of costs from the left, and the one from the right."""

_POOL = ThreadPoolExecutor(2, "sweep")
_PIECE = 12  # columns to either side that tell an edge of a ridge from one of a stone
_FIRM = np.float32(8)  # how much more a piece costs that is left for good than one that is tried
_NEAR = 3  # where it is tried, rows count within a part of the height: one of so many
_STRIDE = 64  # columns that are swept before it is looked at whether more of them change


class Tables:
    """Costs of a photo's pixels, and tables of the cheapest lines to them from either side."""

    def __init__(self, cost: F32, delta: int, link_weight: float, price: float = 0.0) -> None:
        """Begin with nothing swept.

        Args:
            cost: ``(W, H)`` nodal costs, column by column.
            delta: Largest change of row between neighbouring columns, in pixels.
            link_weight: Link cost of one pixel of row change.
            price: What a pixel costs more along a line that a click has left.
        """
        self._cost = cost
        self.allowed = cost
        """``(W, H)`` the costs, infinite where the brush forbids, and more along lines that a click
        has left; a copy where there is any."""
        self._price = np.float32(price)
        self.link_weight = float(np.float32(link_weight))
        """Link cost of one pixel of row change, a float32 as nodal costs are: sums of some thousand
        are exact in float64, so that tables do not depend on how they came about."""
        self._delta = delta
        self.reach = np.full(max(len(cost) - 1, 0), delta, np.int32)
        """``(W - 1,)`` largest change of row on each link."""
        self.forward: F64 = np.empty(cost.shape)
        """``(W, H)`` cost of the cheapest line from the left end of its run to each pixel."""
        self.backward: F64 = np.empty(cost.shape)
        """``(W, H)`` the same from the right end."""
        self._painted: tuple[Steering, ...] = ()  # what is forbidden in `allowed`
        self._tabled: dict[bool, Plan | None] = {FORWARD: None, BACKWARD: None}
        self._margins = np.full(len(cost), np.inf)
        self._measured = np.zeros(len(cost), np.bool_)  # columns whose margins are right

    def sweep_for(self, plan: Plan, *tables: bool) -> None:
        """Bring `FORWARD`, `BACKWARD` or both up to date with a plan."""
        self._paint(plan.strokes)
        jobs = []
        for forward in tables:
            tabled = self._tabled[forward]
            if plan == tabled:
                continue
            changed = painted_between(
                tabled.strokes if tabled else (), plan.strokes, len(self._cost)
            )
            jobs += [
                _POOL.submit(self._sweep, part, tabled, changed)
                for part in plan.stale(tabled, changed)
                if part.forward == forward
            ]
            self._tabled[forward] = plan
        for job in jobs:
            job.result()

    def solved(self, plan: Plan) -> Int:
        """Rows ``(W,)`` of the cheapest line of a plan.

        Raises:
            PathError: No line is possible past what is forbidden.
        """
        rows = plan.fixed.copy()
        if plan.runs:  # none of a photo that is labelled blind
            self.sweep_for(plan, FORWARD)
        forward, reach, weight = self.forward, self.reach, self.link_weight
        for run in plan.runs:
            if run.right_row is None:
                rows[-1] = cheapest_end(forward[-1])
                if not np.isfinite(forward[-1, rows[-1]]):
                    raise PathError("no line leads to the right edge past what is forbidden.")
                trace(forward, reach, weight, rows, run.right - 1, run.left + 1)
            else:
                near = max(run.right_row - self._delta, 0)
                before = forward[run.right - 1, near : run.right_row + self._delta + 1]
                if not np.isfinite(before).any():
                    raise PathError(
                        f"no line leads to column {run.right}, row {run.right_row} "
                        "past what is forbidden."
                    )
                trace(forward, reach, weight, rows, run.right, run.left + 1)
        return rows

    def costs_for(self, plan: Plan) -> F32:
        """``(H, W)`` costs under a plan: infinite where it forbids, as they are where it fixes."""
        self._paint(plan.strokes)
        columns: F32 = self.allowed.copy()
        fixed = np.flatnonzero(~plan.free)
        columns[fixed] = self._cost[fixed]
        return columns.T

    def follow(self, guide: Guide, plan: Plan, rows: Int) -> bool:
        """Fill in the rows of the cheapest line through a guide, and say whether there is one.

        Args:
            guide: The guide.
            plan: What holds beside it; tables are brought up to date with it.
            rows: ``(W,)`` is filled in the guide's columns.
        """
        self.sweep_for(plan, FORWARD, BACKWARD)
        tops, bottoms = guide.bounds(self._delta)
        before = self._beside(plan, guide.first - 1, self.forward)
        after = self._beside(plan, guide.last + 1, self.backward)
        cost = follow(
            self._cost, tops, bottoms, guide.first, before, after, self._delta, self.link_weight,
            rows,
        )  # fmt: skip
        return bool(np.isfinite(cost))

    def follow_past(
        self, left: Left, column: int, row: int, plan: Plan, rows: Int, *, try_it: bool = False
    ) -> bool:
        """Fill in the rows of the cheapest line through a pixel that leaves a line behind.

        Args:
            left: The piece of the line that is left; the pixel lies in its columns.
            column: Column of the pixel.
            row: Its row.
            plan: What holds but for both; tables are brought up to date with it.
            rows: ``(W,)`` is filled in the columns of the piece, where there is such a line.
            try_it: Whether the piece costs only so much more that a good line is not left for a bad
                one: to see how far another ridge leads.
        """
        self.sweep_for(plan, FORWARD, BACKWARD)
        width, height = self._cost.shape
        first, last = max(left.columns[0], 0), min(left.columns[1], width - 1)
        top, bottom = 0, height
        if try_it:  # what is near to either ridge tells enough
            beyond = height // _NEAR
            top = max(min(left.rows[0], row) - beyond, 0)
            bottom = min(max(left.rows[1], row) + beyond + 1, height)
        part = slice(first, last + 1), slice(top, bottom)
        count, at = last - first + 1, column - first + 1  # a column more on either side
        costs: F32 = np.zeros((count + 2, bottom - top), np.float32)
        costs[1:-1] = self.allowed[part]
        mask: U8 = np.zeros((count, height), np.uint8)
        left.paint(mask, first)
        dearer = (mask[:, top:bottom] == DEARER) & (costs[1:-1] == self._cost[part])
        costs[1:-1][dearer] += self._price if try_it else self._price * _FIRM
        table = np.zeros(costs.shape)
        for end, beside in (
            (0, self._beside(plan, first - 1, self.forward)),
            (count + 1, self._beside(plan, last + 1, self.backward)),
        ):
            if len(beside):
                table[end] = beside[top:bottom]
        reach = np.full(count + 1, self._delta, np.int32)
        found = np.full(count + 2, row - top, np.int32)
        for end, inner, last_inner in ((0, at - 1, 1), (count + 1, at + 1, count)):
            sweep(costs, reach, self.link_weight, table, end, inner)
            near = slice(max(row - top - self._delta, 0), row - top + self._delta + 1)
            if not np.isfinite(table[inner, near]).any():
                return False
            if 1 <= inner <= count:
                trace(table, reach, self.link_weight, found, at, last_inner)
        rows[first : last + 1] = found[1:-1] + top
        return True

    def best_near(self, column: int, row: int, within: int) -> int:
        """Row of the best edge of a column near a row: where the cheapest short line crosses it.

        A pixel alone may be an edge of a stone; a piece of a ridge goes on to both sides.

        Args:
            column: The column.
            row: The row.
            within: How many rows away at the most.
        """
        width, height = self._cost.shape
        first, last = max(column - _PIECE, 0), min(column + _PIECE, width - 1)
        away = within + np.abs(np.arange(first, last + 1, dtype=np.int32) - column)
        tops, bottoms = np.maximum(row - away, 0), np.minimum(row + away, height - 1)
        rows = np.zeros(width, np.int32)
        nothing = np.empty(0)
        follow(
            self._cost, tops, bottoms, first, nothing, nothing, self._delta, self.link_weight, rows
        )
        return int(rows[column])

    def _beside(self, plan: Plan, column: int, table: F64) -> F64:
        """``(H,)`` costs of a column beside a guide; empty outside the photo."""
        if not 0 <= column < len(self._cost):
            return np.empty(0)
        if plan.free[column]:
            beside: F64 = table[column]
            return beside
        costs = np.full(self._cost.shape[1], np.inf)
        costs[plan.fixed[column]] = 0.0
        return costs

    def measure(self, plan: Plan, most: int) -> int:
        """Measure the margins of some columns of a plan, and return how many are left then.

        Args:
            plan: The plan.
            most: How many columns at the most.
        """
        self.sweep_for(plan, FORWARD, BACKWARD)
        waiting = plan.free & ~self._measured
        for first, last in runs(waiting):
            stop = min(last + 1, first + most)
            _measure(self.allowed, self.forward, self.backward, first, stop, APART, self._margins)
            self._measured[first:stop] = True
            waiting[first:stop] = False
            most -= stop - first
            if most <= 0:
                break
        return int(np.count_nonzero(waiting))

    def margins(self, plan: Plan) -> F64:
        """``(W,)`` margin of each column of a plan; infinite where its row is fixed."""
        self.measure(plan, len(self._cost))
        return np.where(plan.free, self._margins, np.inf)

    def _paint(self, strokes: tuple[Steering, ...]) -> None:
        """Forbid in the costs what strokes forbid, and nothing else."""
        before, asked = self._painted, strokes
        width, height = self._cost.shape
        changed = painted_between(before, strokes, width)
        if changed is None:
            return
        first, last = changed
        if self.allowed is self._cost:
            self.allowed = self._cost.copy()
        part = slice(first, last + 1)
        mask: U8 = np.zeros((width, height), np.uint8)
        if strokes[: len(before)] == before:  # some were added: they are painted on what is there
            there = self.allowed[part]
            mask[part] = np.where(there == self._cost[part], FREE, DEARER)
            mask[part][np.isinf(there)] = FORBIDDEN
            asked = strokes[len(before) :]
        else:
            asked = tuple(
                one for one in strokes if one.columns[0] <= last and one.columns[1] >= first
            )
        marked = paint(asked, height, width, mask, delta=self._delta)[part]
        self.allowed[part] = self._cost[part]
        self.allowed[part][marked == DEARER] += self._price * _FIRM
        self.allowed[part][marked == FORBIDDEN] = np.inf
        self._painted = strokes

    def _sweep(self, part: Stale, tabled: Plan | None, changed: tuple[int, int] | None) -> None:
        """Fill a part of a table, as far as it changes.

        Args:
            part: The part.
            tabled: The plan to which the table belonged.
            changed: First and last column whose costs are other ones than then.
        """
        run = part.run
        if part.forward:
            table, step, fixed, row = self.forward, 1, run.left, run.left_row
        else:
            table, step, fixed, row = self.backward, -1, run.right, run.right_row
        start = part.first - step
        if start == fixed and row is None:
            table[part.first] = self.allowed[part.first]
            start = part.first
        elif start == fixed:
            table[start] = np.inf
            table[start, row] = 0.0
        goes_on = _same_from(part, tabled, changed)
        while start != part.last:
            stop = start + step * min(_STRIDE, abs(part.last - start))
            known = goes_on is not None and step * stop >= step * goes_on
            before = table[stop].copy() if known else None
            sweep(self.allowed, self.reach, self.link_weight, table, start, stop)
            start = stop
            if before is not None and _differ_by_one_amount(before, table[stop]):
                break
        first, last = min(part.first, start), max(part.first, start)
        self._measured[first : last + 1] = False


def _same_from(part: Stale, tabled: Plan | None, changed: tuple[int, int] | None) -> int | None:
    """The column from which on a part of a table was made of the same costs, without a break.

    That is where the last of its old runs begins, past all changes of costs; None where the last
    column was fixed.
    """
    old = tabled.run_at(part.last) if tabled else None
    if old is None:
        return None
    if part.forward:
        return max(old.left + 1, changed[1] if changed else old.left + 1)
    return min(old.right - 1, changed[0] if changed else old.right - 1)


def _differ_by_one_amount(before: F64, after: F64) -> bool:
    """Whether two columns of a table are the same but for an amount, and where nothing leads."""
    known = np.isfinite(after)
    if not np.array_equal(known, np.isfinite(before)):
        return False
    change = after[known] - before[known]
    return bool(change.size == 0 or (change == change[0]).all())


@numba.njit(cache=True, nogil=True)
def _measure(
    columns: F32, forward: F64, backward: F64, first: int, stop: int, apart: int, margins: F64
) -> None:
    """Margins of the columns from `first` up to, not including, `stop`."""
    through = np.empty(columns.shape[1])
    for column in range(first, stop):
        min_marginals(forward[column], backward[column], columns[column], through)
        margins[column] = column_margin(through, apart)
