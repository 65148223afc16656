"""What the path would be if one thing were different: the proof behind a diagnosis.

A `Case` is a detection beside its truth. Each of its changes makes the truth line what it should
have been in one respect (edges, scores, slopes), or spares it what other lines need not pay, within
a few columns, and the path is searched again there. Nothing else changes, so what comes back was
due to that one thing.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, Bool, Int
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.cost_split import CostSplit
from skyline_viz.edges import edge_index
from skyline_viz.evaluation.metrics import column_errors, scaled
from skyline_viz.path import cheapest_end, sweep, trace
from skyline_viz.skyline import Skyline

Change: TypeAlias = Literal["missed edge", "starved bin", "misjudged", "too steep"]
"""What of the truth is made right: edges are put where it has none; scores of its edges are
raised, where their bins are starved, and where they are not; its steps are allowed."""

CHANGES: tuple[Change, ...] = get_args(Change)

REPAIRED = 0.8
"""Share of a segment's wrong columns that have to be right for the path to have come back."""

_NEAR = 2.0  # rows within which an edge counts as one of the truth, at the reference height
_LEAST_TYPICAL = 20  # edge pixels that a typical value is taken from
_LEAST_SCORE = 0.6  # no filter that has learned anything gives the skyline less; its target is 1
_LOW_SCORE = 0.75  # share of the typical score below which a score is low


@dataclass(frozen=True, eq=False)
class Case:
    """A detection and what it should have found."""

    detection: Detection
    truth: Skyline
    tolerance: float
    """Error up to which a column is right, in pixels."""

    @cached_property
    def errors(self) -> F64:
        """``(W,)`` error of each column; NaN where the truth is not visible."""
        return column_errors(self.detection.skyline, self.truth)

    @cached_property
    def right(self) -> Bool:
        """``(W,)`` columns in which the path is right."""
        return self.errors <= self.tolerance  # NaN is not

    @cached_property
    def rows(self) -> Int:
        """``(W,)`` row of the truth, on the nearest edge pixel within a few rows, if any."""
        rows, _ = self._on_edges
        return rows

    @cached_property
    def drawn_rows(self) -> Int:
        """``(W,)`` row of the truth as it is, inside the photo."""
        height = len(self.detection.edges)
        rows: Int = np.floor(self.truth.rows + 0.5).clip(0, height - 1).astype(np.int32)
        return rows

    @cached_property
    def path_rows(self) -> Int:
        """``(W,)`` row of the path."""
        return self.detection.skyline.rows.astype(np.int32)

    @cached_property
    def near(self) -> int:
        """Rows within which an edge belongs to a line."""
        return max(round(scaled(_NEAR, len(self.detection.edges))), int(_NEAR))

    def away(self, rows: Int) -> Bool:
        """``(W,)`` columns in which a line ``(W,)`` does not run along the truth."""
        away: Bool = np.abs(rows - self.rows) > self.near
        return away

    @cached_property
    def pixels(self) -> Int:
        """``(W,)`` the truth's edge pixel in each column, as an index; -1 where it has none."""
        _, pixels = self._on_edges
        return pixels

    @cached_property
    def typical(self) -> tuple[float, float]:
        """Score that an edge of the truth has when all is well, and what it costs besides.

        The better quartile of the truth's own edges: where many of them fail, their median would
        be the failure itself.
        """
        pixels = self.pixels[(self.pixels >= 0) & self.truth.visible]
        if len(pixels) < _LEAST_TYPICAL:
            return 0.8, (1 - self.detection.score_weight) / 2
        scores, rest = self.detection.scores[pixels], self.detection.cost_model.edge_rest[pixels]
        typical = max(float(np.percentile(scores, 75)), _LEAST_SCORE)
        return typical, float(np.percentile(rest, 25))

    @property
    def typical_cost(self) -> float:
        """What an edge of the truth costs when all is well."""
        score, rest = self.typical
        return self.detection.score_weight * (1 - score) + rest

    def saved(self, columns: npt.NDArray[np.intp]) -> F64:
        """How much less the truth's edge pixels in some columns cost with a typical score.

        An edge that its score has ruled out altogether becomes a typical one.
        """
        detection = self.detection
        pixels = self.pixels[columns]
        raised = detection.cost_model.saved(detection.scores[pixels], self.typical[0])
        here = detection.cost[self.rows[columns], columns].astype(np.float64)
        ruled_out = here >= detection.non_edge_cost
        saved: F64 = np.where(ruled_out, np.maximum(here - self.typical_cost, raised), raised)
        return saved

    @cached_property
    def steps(self) -> Int:
        """``(W,)`` change of the truth's row from the column before."""
        return np.abs(np.diff(self.rows, prepend=self.rows[:1])).astype(np.int32)

    def columns_of(self, change: Change, first: int, last: int) -> Bool:
        """``(W,)`` columns from `first` to `last` in which a change makes a difference."""
        detection = self.detection
        within: Bool = np.zeros(self.truth.width, np.bool_)
        within[first : last + 1] = self.truth.visible[first : last + 1]
        on_edge = self.pixels >= 0
        if change == "missed edge":
            return within & ~on_edge
        if change == "too steep":
            around = within.copy()
            around[max(first - 1, 0) : last + 2] = True
            return around & (self.steps > min(1, detection.delta))
        starved = np.zeros(self.truth.width, np.bool_)
        starved[on_edge] = detection.starved[self.pixels[on_edge]]
        low = np.zeros(self.truth.width, np.bool_)
        low[on_edge] = detection.scores[self.pixels[on_edge]] < _LOW_SCORE * self.typical[0]
        return within & on_edge & low & (starved if change == "starved bin" else ~starved)

    def paid(self, rows: Int) -> CostSplit:
        """What a line ``(W,)`` pays, see `cost_split.split_cost`."""
        columns = np.arange(len(rows))
        maps = self._maps
        return CostSplit(
            {
                term.name: maps[term.name][rows, columns].astype(np.float64)
                if term.name in maps
                else term.along(rows)
                for term in self.detection.cost_model.terms
            }
        )

    @cached_property
    def due(self) -> CostSplit:
        """What the truth pays."""
        return self.paid(self.rows)

    def dearer(self, line: Int, first: int, last: int) -> dict[str, F64]:
        """How much more than a line ``(W,)`` the truth pays, ``(W,)`` term by term.

        It is 0 but where the line is off around some columns, and the truth visible. The column
        after that counts, too: there the line pays for its way back.

        Args:
            line: The line.
            first: First wrong column.
            last: Last wrong column.
        """
        start, stop = self.excursion(first, last, line)
        off = np.zeros(self.truth.width, np.bool_)
        off[start : stop + 1] = self.away(line)[start : stop + 1]
        off[1:] |= off[:-1]
        off &= self.truth.visible
        paid = self.paid(line).terms
        return {term: np.where(off, due - paid[term], 0.0) for term, due in self.due.terms.items()}

    def excursion(self, first: int, last: int, rows: Int | None = None) -> tuple[int, int]:
        """Columns from where a line leaves the truth to where it is back, around wrong ones.

        What drew the path away may lie in columns where it is not yet off by the tolerance. A path
        that may not change its row never makes up for what it is off, so with a ``delta`` of 0 it
        leaves the truth as soon as it is off at all.

        Args:
            first: First wrong column.
            last: Last wrong column.
            rows: ``(W,)`` the line; the path unless given.
        """
        off = np.abs((self.path_rows if rows is None else rows) - self.rows)
        away = off > (self.near if self.detection.delta else 0)
        there = np.flatnonzero(~away[: first + 1])
        back = np.flatnonzero(~away[last:])
        start = int(there[-1]) + 1 if len(there) else 0
        stop = last + int(back[0]) - 1 if len(back) else self.truth.width - 1
        return min(start, first), max(stop, last)

    def window(self, first: int, last: int) -> tuple[int, int]:
        """Columns to search again: to a right one beyond some room on either side, or the rim."""
        room = max(64, last - first)
        left = np.flatnonzero(self.right[: max(first - room, 0) + 1])
        right = np.flatnonzero(self.right[min(last + room, self.truth.width - 1) :])
        start = int(left[-1]) if len(left) else 0
        stop = int(right[0]) + min(last + room, self.truth.width - 1) if len(right) else -1
        return start, stop if stop >= 0 else self.truth.width - 1

    def search(
        self,
        changes: Iterable[Change],
        first: int,
        last: int,
        spared: F64 | None = None,
        costs: F32 | None = None,
    ) -> tuple[int, Int]:
        """The path with the truth's columns from `first` to `last` made right in some respects.

        Args:
            changes: What is made right.
            first: First column in which it is.
            last: Last one.
            spared: ``(W,)`` what the truth need not pay in each column; nothing unless given.
            costs: ``(H, W)`` nodal costs to search in; those of the detection unless given.

        Returns:
            First column of the part that was searched again, and the rows from there on.
        """
        start, stop = self.window(first, last)
        detection = self.detection
        given = detection.cost if costs is None else costs
        cost = given[:, start : stop + 1].T.astype(np.float64)
        reach = np.full(stop - start, detection.delta, np.int32)
        for change in changes:
            columns = np.flatnonzero(self.columns_of(change, first, last))
            rows = self.rows[columns]
            if change == "missed edge":
                cost += detection.cost_model.more_edges(
                    rows, columns, self.typical_cost, start, stop
                )
            elif change == "too steep":
                steps = self.steps[columns]
                # saved on that side of the step which is farther from the path: the path must
                # not save it, too, where the lines meet
                before = np.maximum(columns - 1, start)
                apart = np.abs(self.path_rows - self.rows)
                side = np.where(apart[columns] >= apart[before], columns, before)
                np.subtract.at(cost, (side - start, self.rows[side]), detection.link_weight * steps)
                links = columns - start - 1
                inside = (links >= 0) & (links < len(reach))
                reach[links[inside]] = np.maximum(reach[links[inside]], steps[inside])
            else:
                cost[columns - start, rows] -= self.saved(columns)
        if spared is not None:
            columns = np.arange(start, stop + 1)
            cost[columns - start, self.rows[columns]] -= spared[columns]
        for column, fixed in ((start, start > 0), (stop, stop < self.truth.width - 1)):
            if fixed or self.right[column]:
                kept = cost[column - start, self.path_rows[column]]
                cost[column - start] = np.inf
                cost[column - start, self.path_rows[column]] = kept
        return start, _cheapest(cost, np.minimum(reach, cost.shape[1] - 1), detection.link_weight)

    def whole(self, start: int, rows: Int) -> Int:
        """``(W,)`` the path with a part of it replaced by what a search found."""
        line = self.path_rows.copy()
        line[start : start + len(rows)] = rows
        return line

    def repaired(self, start: int, rows: Int, first: int, last: int) -> float:
        """Share of the wrong columns from `first` to `last` in which another path is right."""
        wrong = first + np.flatnonzero(self.errors[first : last + 1] > self.tolerance)
        off = np.abs(rows[wrong - start] - self.truth.rows[wrong])
        return float((off <= self.tolerance).mean()) if len(wrong) else 1.0

    @cached_property
    def _maps(self) -> dict[str, F32]:
        """Terms that all pixels pay, as maps: several lines are asked what they pay."""
        terms = self.detection.cost_model.nodal
        return {term.name: term.map() for term in terms if term.paid_by == "all"}

    @cached_property
    def _on_edges(self) -> tuple[Int, Int]:
        height, width = self.detection.edges.shape
        rows = self.drawn_rows
        index = edge_index(self.detection.edges)
        columns = np.arange(width)
        pixels = index[rows, columns]
        found = rows.copy()
        for away in (sign * step for step in range(1, self.near + 1) for sign in (-1, 1)):
            moved = np.clip(rows + away, 0, height - 1)
            better = (pixels < 0) & (index[moved, columns] >= 0)
            found[better] = moved[better]
            pixels = np.where(better, index[moved, columns], pixels)
        return found, pixels.astype(np.int32)


def _cheapest(cost: F64, reach: Int, link_weight: float) -> Int:
    """Rows of the cheapest path through ``(w, H)`` costs, with its own reach on each link."""
    table = np.empty_like(cost)
    table[0] = cost[0]
    sweep(cost, reach, float(link_weight), table, 0, len(cost) - 1)
    rows = np.empty(len(cost), np.int32)
    rows[-1] = cheapest_end(table[-1])
    trace(table, reach, float(link_weight), rows, len(cost) - 1, 0)
    return rows
