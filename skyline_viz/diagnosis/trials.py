"""The counterfactuals of one failing segment: what is tried, and what each trial brings back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F64, Int
from skyline_viz.diagnosis.causes import Cause
from skyline_viz.diagnosis.counterfactual import REPAIRED, Case, Change
from skyline_viz.diagnosis.edges_anew import FACTORS, cost_anew

_MOST_LINES = 8  # that are made up for until the truth is expected back,
_MOST_SEARCHES = 64  # and as many plain searches at most that this may take as long as
_TIE = 1e-3  # by which the truth is the cheaper one of two lines that cost the same


@dataclass(frozen=True)
class Trial:
    """One counterfactual of a segment."""

    changes: tuple[Cause, ...]
    """What was made right."""

    columns: int
    """In how many columns."""

    repaired: float
    """Share of the segment's wrong columns that are right then."""

    lines: int = 0
    """How many competing lines the truth was made as cheap as."""

    terms: tuple[str, ...] = ()
    """In which terms of the cost."""

    thresholds: float = 1.0
    """Factor of the Canny thresholds with which edges were found anew around both lines, see
    `edges_anew`; 1 where none were."""


class Trials:
    """The counterfactuals of a segment, as they are tried."""

    def __init__(self, case: Case, run: tuple[int, int]) -> None:
        self.case, self.run = case, run
        self.reach = case.excursion(*run)
        self.made: list[Trial] = []
        self.line = (run[0], case.path_rows[run[0] : run[1] + 1])
        self.lines: dict[tuple[Change, ...], tuple[int, Int]] = {}
        self.dearer = case.dearer(case.path_rows, *self.reach)

    def change(self, *changes: Change) -> float:
        """Make the truth right in some respects; return the share that comes back."""
        found = self.case.search(changes, *self.reach)
        share = self.case.repaired(*found, *self.run)
        self.made.append(Trial(changes, self._touched(changes), share))
        self.lines[changes] = found
        return share

    def preferring(self, changes: Sequence[Change]) -> tuple[str, ...]:
        """The terms that prefer other lines, that which does most first; none where that fails.

        Terms are added, in the order of the truth's difference from the path, until the truth comes
        back without their differences. Those without which it comes back as well are dropped.

        Args:
            changes: What of the truth is made right as well.
        """
        by_difference = {term: float(costs.sum()) for term, costs in self.dearer.items()}
        ordered = sorted(by_difference, key=lambda term: -by_difference[term])
        for count in range(1, len(ordered) + 1):
            if self._equal(ordered[:count], changes) >= REPAIRED:
                break
        else:
            return ()
        kept = ordered[:count]
        for term in reversed(kept[:-1]):
            rest = [other for other in kept if other != term]
            if self._equal(rest, changes) >= REPAIRED:
                kept = rest
        return tuple(kept)

    def anew(self) -> list[Trial]:
        """Find edges anew around both lines; return the trials, none where no edge changes."""
        made = []
        for factor in FACTORS:
            costs = cost_anew(self.case, *self.reach, factor)
            if costs is None:
                continue
            found = self.case.search((), *self.reach, costs=costs)
            share = self.case.repaired(*found, *self.run)
            columns = self.reach[1] - self.reach[0] + 1
            made.append(Trial((), columns, share, thresholds=factor))
        self.made += made
        return made

    def proof(self, terms: tuple[str, ...], changes: Sequence[Cause]) -> Trial | None:
        """The trial that terms and changes stand on; None where no terms are named."""
        wanted = ("cheaper path", *changes)
        made = (one for one in self.made if one.terms == terms and one.changes == wanted)
        return next(made, None) if terms else None

    def by(self, terms: Sequence[str]) -> F64:
        """``(W,)`` how much more than the path the truth pays for some terms; for all if none."""
        costs: F64 = np.sum([self.dearer[term] for term in terms or self.dearer], axis=0)
        return costs

    def against(self, cause: Cause) -> float:
        """The largest share that came back without a cause being made right.

        Edges found anew do not speak against any: they are no other cause.
        """
        others = (one for one in self.made if cause not in one.changes and one.thresholds == 1)
        return max((one.repaired for one in others), default=0.0)

    def _equal(self, terms: Sequence[str], changes: Sequence[Change]) -> float:
        """Let the truth pay no more for some terms than the path does, in the sum.

        Then no more than the line that is found instead, and so on: as long as it is these terms
        that make the truth the dearer one.
        """
        case = self.case
        most = max(min(_MOST_LINES, int(_MOST_SEARCHES / self._dearer_search(changes))), 1)
        spared, line, share = np.zeros(case.truth.width), case.path_rows, 0.0
        found, lines = self.line, 0
        while share < REPAIRED and lines < most:
            more = self._more(line, terms, spared)
            if more is None:
                break
            spared += more
            lines += 1
            found = case.search(changes, *self.reach, spared)
            share = case.repaired(*found, *self.run)
            line = case.whole(*found)
        columns = int((spared > 0).sum()) or self._touched(changes)
        self.made.append(Trial(("cheaper path", *changes), columns, share, lines, tuple(terms)))
        if share >= REPAIRED:
            self.line = found
        return share

    def _more(self, line: Int, terms: Sequence[str], spared: F64) -> F64 | None:
        """What the truth pays more than a line for some terms, ``(W,)``, where it pays more.

        It comes to the difference of both lines in the sum. None where that is none.
        """
        first = line is self.case.path_rows
        dearer = self.dearer if first else self.case.dearer(line, *self.reach)
        where = np.any([costs != 0 for costs in dearer.values()], axis=0)
        differences = np.where(where, sum(dearer[term] for term in terms) - spared, 0.0)
        total = float(differences.sum())
        if total <= 0:
            return None
        more = np.maximum(differences, 0.0)
        found: F64 = more * ((total + _TIE) / more.sum())
        return found

    def _touched(self, changes: Sequence[Change]) -> int:
        """Columns in which some changes make a difference."""
        touched = np.zeros(self.case.truth.width, np.bool_)
        for change in changes:
            touched |= self.case.columns_of(change, *self.reach)
        return int(touched.sum())

    def _dearer_search(self, changes: Sequence[Change]) -> float:
        """How many plain searches one takes as long as in which the truth's steps are allowed."""
        delta = max(self.case.detection.delta, 1)
        part = slice(self.reach[0], self.reach[1] + 1)
        allowed = np.maximum(self.case.steps[part], delta)
        return float(allowed.mean()) / delta if "too steep" in changes else 1.0
