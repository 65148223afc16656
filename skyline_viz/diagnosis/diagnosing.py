"""Why a skyline went wrong: each failing segment gets a cause, proved by a counterfactual.

==============  =================================================================================
cause           what is true of the segment
==============  =================================================================================
truth doubtful  the photo has next to no contrast along the truth, and much along the path beside it
missed edge     with edges where the truth has none, the path comes back
starved bin     with typical scores where the truth's bins are starved, it comes back
misjudged       with typical scores where the truth's bins are well trained, it comes back
too steep       with the truth's steps allowed and free, it comes back
cheaper path    nothing of it, alone or together, brings it back; if the truth need pay no more for
                some terms of the cost than other lines do, and with all of it where need be, it
                does: these terms prefer other lines
==============  =================================================================================

The first that holds is the cause. Where only several together bring the path back, the one that
changes the cost of the truth most is the main cause, and the others contribute. What nothing brings
back is called a cheaper path, too, and its evidence says that it is not proved.

Each cause names the terms of the cost by which the truth loses, and the place where it begins to,
see `places`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from skyline_viz.arrays import Int
from skyline_viz.detection import Detection
from skyline_viz.diagnosis import evidence
from skyline_viz.diagnosis.causes import TERMS, Cause, Place
from skyline_viz.diagnosis.cost_split import CostSplit
from skyline_viz.diagnosis.counterfactual import CHANGES, REPAIRED, Case, Change
from skyline_viz.diagnosis.doubt import doubt_of
from skyline_viz.diagnosis.places import place_of
from skyline_viz.diagnosis.trials import Trial, Trials
from skyline_viz.evaluation.metrics import TOLERANCE, scaled, wrong_segments
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.names import named_in_markdown


@dataclass(frozen=True, eq=False)
class Segment:
    """Columns in which the path is wrong, and why."""

    columns: tuple[int, int]
    """The first and the last one."""

    mean_error: float
    """In pixels."""

    worst_error: float
    """In pixels."""

    total_error: float
    """In pixels, summed over the visible columns."""

    cause: Cause
    """Why."""

    contributing: tuple[Cause, ...]
    """Causes without which the main one would not have been enough."""

    terms: tuple[str, ...]
    """The terms of the cost by which the truth loses, that which does most first; nothing where the
    truth is doubtful, or nothing is proved."""

    place: Place | None
    """What the photo shows where it begins to."""

    begins: int
    """First column that shows it; the first one of the segment where there is none."""

    findings: tuple[str, ...]
    """What was found: why the truth is dearer, what proves it, where it begins to; each in a
    sentence or two."""

    trials: tuple[Trial, ...]
    """All counterfactuals that were tried."""

    margin: float
    """How clear the decision is: the repaired share by which it was made, less the best of the
    trials that it was made against; from 0 (a toss-up, or not proved) to 1."""

    path_cost: dict[str, float]
    """What the path pays in the segment, term by term, see `cost_split.CostSplit`."""

    truth_cost: dict[str, float]
    """What the truth pays."""

    line: tuple[int, Int]
    """The path of the counterfactual that decided: first column, and rows from there on; where none
    did, the path itself."""

    @property
    def title(self) -> str:
        """Cause, term and place in a few words."""
        by = f" by {self.terms[0]}" if self.cause == "cheaper path" and self.terms else ""
        return f"{self.cause}{by}{f', {self.place}' if self.place else ''}"

    @property
    def evidence(self) -> str:
        """All that was found, in a few sentences."""
        return " ".join(self.findings)

    @property
    def length(self) -> int:
        """Number of columns."""
        return self.columns[1] - self.columns[0] + 1

    @property
    def proof(self) -> Trial | None:
        """The trial of exactly these causes that brings the path back; None if there is none.

        Of a cheaper path it is that of exactly these terms.
        """
        chosen = {self.cause, *self.contributing}
        terms = set(self.terms) if self.cause == "cheaper path" else set()
        proofs = (
            one
            for one in self.trials
            if set(one.changes) == chosen and set(one.terms) == terms and one.repaired >= REPAIRED
        )
        return next(proofs, None)


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Why a detection went wrong, segment by segment; without segments it is right."""

    segments: tuple[Segment, ...]
    """From left to right."""

    tolerance: float
    """Error up to which a column counts as right, in pixels."""

    @property
    def right(self) -> bool:
        """Whether the detection is right everywhere."""
        return not self.segments

    @property
    def main(self) -> Segment | None:
        """The segment with the largest total error."""
        return next(iter(self.by_error), None)

    @property
    def by_error(self) -> tuple[Segment, ...]:
        """The segments, that with the largest total error first."""
        return tuple(sorted(self.segments, key=lambda one: -one.total_error))

    @property
    def causes(self) -> tuple[Cause, ...]:
        """The causes of all segments, each once, that of `main` first."""
        return tuple(dict.fromkeys(segment.cause for segment in self.by_error))

    @property
    def titles(self) -> tuple[str, ...]:
        """The titles of all segments, each once, that of `main` first."""
        return tuple(dict.fromkeys(segment.title for segment in self.by_error))

    @property
    def said_right(self) -> str:
        """That it is right, in a sentence."""
        return f"Right: no column is off by more than {self.tolerance:.3g} px."

    @property
    def said(self) -> str:
        """That it is right, or where it is most wrong and why, in a sentence."""
        if self.right:
            return self.said_right
        one, *others = self.by_error
        first, last = one.columns
        stretches = "stretch is" if len(others) == 1 else "stretches are"
        more = f"; {len(others)} more {stretches} wrong" if others else ""
        return (
            f"Wrong: columns {first} to {last}, by {one.mean_error:.1f} px in the mean, "
            f"{one.title}{more}."
        )

    def document(self) -> dict[str, Any]:
        """Everything but the lines, for JSON."""
        left_out = ("line", "trials", "findings")
        kept = [one.name for one in fields(Segment) if one.name not in left_out]
        return {
            "tolerance": self.tolerance,
            "segments": [
                {
                    **{name: getattr(segment, name) for name in kept},
                    "title": segment.title,
                    "evidence": segment.evidence,
                    "trials": [vars(trial) for trial in segment.trials],
                }
                for segment in self.segments
            ],
        }

    def markdown(self, name: str = "", mend: Sequence[str] = ()) -> str:
        """A report for people, the segment with the largest total error first.

        Args:
            name: Name of the photo, for the heading.
            mend: Lines in Markdown about what mends it, which come first.
        """
        lines = [f"**{named_in_markdown(name)}**  "] if name else []
        lines += [*mend, ""] if mend else []
        if self.right:
            return "\n".join([*lines, self.said_right])
        for one in self.by_error:
            first, last = one.columns
            also = f", with {' and '.join(one.contributing)}" if one.contributing else ""
            lines += [
                f"**{one.title}{also}**, columns {first} to {last}  ",
                f"off by {one.mean_error:.1f} px in the mean, {one.worst_error:.0f} at worst  ",
                "",
                *(f"- {found}" for found in one.findings),
                "",
            ]
        return "\n".join(lines)


def diagnose(detection: Detection, truth: Skyline, tolerance: float | None = None) -> Diagnosis:
    """Find out why a detection went wrong.

    Args:
        detection: The detection.
        truth: The true line.
        tolerance: Error up to which a column is right, in pixels; that of
            `metrics.wrong_segments` unless given.

    Raises:
        SkylineError: The truth has another width than the photo, or is visible nowhere.
        ValueError: The tolerance is negative, or not finite.
    """
    height, width = detection.edges.shape
    if truth.width != width:
        raise SkylineError(f"the photo is {width} columns wide, the truth {truth.width}")
    if not truth.visible.any():
        raise SkylineError("the truth is visible nowhere.")
    allowed = scaled(TOLERANCE, height) if tolerance is None else checked_tolerance(tolerance)
    case = Case(detection, truth, allowed)
    runs = wrong_segments(case.errors, height, allowed)
    if not runs:
        return Diagnosis((), allowed)
    paid = case.paid(case.path_rows)
    return Diagnosis(tuple(_explain(case, run, paid) for run in runs), allowed)


def checked_tolerance(tolerance: float) -> float:
    """A tolerance, if it can be one.

    Raises:
        ValueError: It is negative, or not finite.
    """
    if not 0 <= tolerance < math.inf:
        raise ValueError(f"a tolerance is a number of pixels, 0 or more, not {tolerance:g}.")
    return tolerance


def _explain(case: Case, run: tuple[int, int], path: CostSplit) -> Segment:
    trials = Trials(case, run)
    usable = [one for one in CHANGES if case.columns_of(one, *trials.reach).any()]
    shares = {one: trials.change(one) for one in usable}
    paid, due = path.totals(*run), case.due.totals(*run)
    cause: Cause
    contributing: tuple[Cause, ...] = ()
    terms: tuple[str, ...] = ()
    if doubt := doubt_of(case, *run):
        cause, share, said = "truth doubtful", doubt.repaired, [doubt.evidence]
        trials.made.append(Trial((cause,), doubt.columns, share))
    elif chosen := _chosen(usable, shares, trials):
        main = max(chosen, key=lambda one: _effect(case, one, *trials.reach))
        cause, contributing = main, tuple(one for one in chosen if one != main)
        terms = tuple(dict.fromkeys(TERMS[one] for one in (main, *contributing)))
        trials.line = trials.lines[chosen]
        share = case.repaired(*trials.line, *run)
        found = evidence.changes_found(case, chosen, run, trials.reach)
        said = [found, evidence.changes_helped(share)]
    else:
        cause = "cheaper path"
        costs = evidence.cheaper_by(paid, due, trials.against(cause))
        terms = trials.preferring(())
        if not terms and usable:
            terms = trials.preferring(usable)
            contributing = tuple(usable) if terms else ()
        proof = trials.proof(terms, contributing)
        share = proof.repaired if proof else 0.0
        said = [costs, evidence.terms_equal(proof)]
    of_edges = cause == "cheaper path" or "missed edge" in (cause, *contributing)
    if of_edges and (anew := trials.anew()):
        said.append(evidence.found_anew(anew))
    there = None if cause == "truth doubtful" else place_of(case, trials.by(terms), *trials.reach)
    errors = case.errors[run[0] : run[1] + 1]
    return Segment(
        columns=run,
        mean_error=float(np.nanmean(errors)),
        worst_error=float(np.nanmax(errors)),
        total_error=float(np.nansum(errors)),
        cause=cause,
        contributing=contributing,
        terms=terms,
        place=there.place if there else None,
        begins=there.begins if there else run[0],
        findings=(*said, there.evidence) if there else tuple(said),
        trials=tuple(trials.made),
        margin=max(share - trials.against(cause), 0.0),
        path_cost=paid,
        truth_cost=due,
        line=trials.line,
    )


def _chosen(
    usable: Sequence[Change], shares: dict[Change, float], trials: Trials
) -> tuple[Change, ...]:
    """The first change that repairs alone, or the fewest that do together; else none."""
    for one in usable:
        if shares[one] >= REPAIRED:
            return (one,)
    if len(usable) < 2 or trials.change(*usable) < REPAIRED:
        return ()
    kept = list(usable)
    for one in reversed(usable):
        rest = [other for other in kept if other != one]
        if len(rest) > 1 and trials.change(*rest) >= REPAIRED:
            kept = rest
    return tuple(kept)


def _effect(case: Case, change: Change, first: int, last: int) -> float:
    """How much cheaper a change makes the truth."""
    columns = np.flatnonzero(case.columns_of(change, first, last))
    detection = case.detection
    if change == "missed edge":
        due = detection.cost_model["no edge"].at(case.rows[columns], columns)
        return float((due - case.typical_cost).sum())
    if change == "too steep":
        steep = np.maximum(case.steps[columns] - detection.delta, 0)
        return float(detection.link_weight * case.steps[columns].sum() + steep.sum())
    return float(case.saved(columns).sum())
