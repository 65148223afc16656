"""Why a skyline went wrong: each failing segment gets a cause, proved by a counterfactual.

==============  =================================================================================
cause           what is true of the segment
==============  =================================================================================
truth doubtful  the photo has next to no contrast along the truth, and much along the path beside it
missed edge     with edges where the truth has none, the path comes back
starved bin     with typical scores where the truth's bins are starved, it comes back
misjudged       with typical scores where the truth's bins are well trained, it comes back
too steep       with the truth's steps allowed and free, it comes back
cheaper path    nothing of it, alone or together, brings it back; without the path's edges it does,
                unless there are yet other lines: another line is simply cheaper
==============  =================================================================================

The first that holds is the cause. Where only several together bring the path back, the one that
changes the cost of the truth most is the main cause, and the others contribute.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8, Int
from skyline_viz.causes import Cause
from skyline_viz.cost_split import CostSplit, split_cost
from skyline_viz.counterfactual import CHANGES, Case, Change, scaled
from skyline_viz.detection import Detection
from skyline_viz.detector import FilterDetection
from skyline_viz.skyline import Skyline, SkylineError

TOLERANCE = 4.0
"""Error up to which a column is right, in pixels at 519 rows."""

REPAIRED = 0.8
"""Share of a segment's columns that have to be right again for the path to have come back."""

_GAP = 5  # right columns that do not end a segment
_ON_EDGES = 0.7  # share of the path's columns on edges from which on the truth can be doubtful,
_NO_PEAK, _LESS_PEAK = 0.5, 0.2  # if its contrast stands out no more than this, or than this share
_MORE_PEAK = 0.5  # of the path's, and the path's stands out by this much more
_BAND = 8  # rows beside a line that its contrast is compared with
_SPREAD = 1.0  # how much the distance may vary (its median deviation), in pixels
_BESIDE = 20.0  # distance up to which the path is a few pixels beside, at 519 rows


@dataclass(frozen=True)
class Trial:
    """One counterfactual of a segment."""

    changes: tuple[Cause, ...]
    """What was made right."""

    columns: int
    """In how many columns."""

    repaired: float
    """Share of the segment's columns that are right then."""


@dataclass(frozen=True, eq=False)
class Segment:
    """Columns in which the path is wrong, and why."""

    columns: tuple[int, int]
    """The first and the last one."""

    mean_error: float
    """In pixels."""

    worst_error: float
    """In pixels."""

    cause: Cause
    """Why."""

    contributing: tuple[Cause, ...]
    """Causes without which the main one would not have been enough."""

    evidence: str
    """What was found, in a sentence or two."""

    trials: tuple[Trial, ...]
    """All counterfactuals that were tried."""

    margin: float
    """How clear the decision is: the repaired share by which it was made, less the best of the
    trials that it was made against; from 0 (a toss-up) to 1."""

    path_cost: dict[str, float]
    """What the path pays in the segment, stage by stage, see `cost_split.CostSplit`."""

    truth_cost: dict[str, float]
    """What the truth pays."""

    line: tuple[int, Int]
    """The path of the counterfactual that decided: first column, and rows from there on."""

    @property
    def length(self) -> int:
        """Number of columns."""
        return self.columns[1] - self.columns[0] + 1

    @property
    def total_error(self) -> float:
        """In pixels, over all columns."""
        return self.mean_error * self.length


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
        return max(self.segments, key=lambda one: one.total_error, default=None)

    @property
    def causes(self) -> tuple[Cause, ...]:
        """The causes of all segments, each once, that of `main` first."""
        by_error = sorted(self.segments, key=lambda one: -one.total_error)
        return tuple(dict.fromkeys(segment.cause for segment in by_error))

    def document(self) -> dict[str, Any]:
        """Everything but the lines, for JSON."""
        kept = [one.name for one in fields(Segment) if one.name not in ("line", "trials")]
        return {
            "tolerance": self.tolerance,
            "segments": [
                {
                    **{name: getattr(segment, name) for name in kept},
                    "trials": [vars(trial) for trial in segment.trials],
                }
                for segment in self.segments
            ],
        }

    def markdown(self, name: str = "") -> str:
        """A report for people."""
        lines = [f"**{name}**  "] if name else []
        if self.right:
            return "\n".join(
                [*lines, f"Right: no column is off by more than {self.tolerance:.3g} px."]
            )
        for one in self.segments:
            first, last = one.columns
            also = f", with {' and '.join(one.contributing)}" if one.contributing else ""
            lines += [
                f"**{one.cause}{also}**, columns {first} to {last}  ",
                f"off by {one.mean_error:.1f} px in the mean, {one.worst_error:.0f} at worst  ",
                f"{one.evidence}",
                "",
            ]
        return "\n".join(lines)


def diagnose(detection: Detection, truth: Skyline, tolerance: float | None = None) -> Diagnosis:
    """Find out why a detection went wrong.

    Args:
        detection: The detection.
        truth: The true line.
        tolerance: Error up to which a column is right, in pixels; `TOLERANCE`, scaled for photos
            of more than 519 rows, unless given.

    Raises:
        SkylineError: The truth has another width than the photo.
    """
    height, width = detection.edges.shape
    if truth.width != width:
        raise SkylineError(f"the photo is {width} columns wide, the truth {truth.width}")
    allowed = scaled(TOLERANCE, height) if tolerance is None else tolerance
    case = Case(detection, truth, allowed)
    runs = failing_runs(case.errors > allowed)
    if not runs:
        return Diagnosis((), allowed)
    path = split_cost(detection, detection.skyline.rows.astype(np.int32))
    ideal = split_cost(detection, case.rows)
    return Diagnosis(tuple(_explain(case, run, path, ideal) for run in runs), allowed)


def failing_runs(wrong: np.ndarray[Any, np.dtype[np.bool_]]) -> list[tuple[int, int]]:
    """First and last column of each run of wrong columns; a few right ones do not end it."""
    columns = np.flatnonzero(wrong)
    if len(columns) == 0:
        return []
    runs = np.split(columns, np.flatnonzero(np.diff(columns) > _GAP + 1) + 1)
    return [(int(run[0]), int(run[-1])) for run in runs]


def _explain(case: Case, run: tuple[int, int], path: CostSplit, ideal: CostSplit) -> Segment:
    first, last = run
    reach = case.excursion(first, last)
    trials: list[Trial] = []
    lines: dict[tuple[Change, ...], tuple[int, Int]] = {}

    def tried(*changes: Change) -> float:
        touched = np.zeros(case.truth.width, np.bool_)
        for change in changes:
            touched |= case.columns_of(change, *reach)
        lines[changes] = case.search(changes, *reach)
        share = case.repaired(*lines[changes], first, last)
        trials.append(Trial(changes, int(touched.sum()), share))
        return share

    usable = [one for one in CHANGES if case.columns_of(one, *reach).any()]
    errors = case.errors[first : last + 1]
    cause: Cause
    contributing: tuple[Cause, ...] = ()
    chosen: tuple[Change, ...] = ()
    shares = {one: tried(one) for one in usable}
    if doubt := _doubtful(case, first, last):
        cause, margin, evidence = "truth doubtful", doubt.margin, doubt.evidence
        trials.append(doubt.trial)
    else:
        alone = [one for one in usable if shares[one] >= REPAIRED]
        if alone:
            chosen = (alone[0],)
        elif len(usable) > 1 and tried(*usable) >= REPAIRED:
            chosen = _needed(usable, tried)
        if chosen:
            main = max(chosen, key=lambda one: _effect(case, one, *reach))
            cause = main
            contributing = tuple(one for one in chosen if one != main)
            share = next(one.repaired for one in reversed(trials) if one.changes == chosen)
            others = [one.repaired for one in trials if main not in one.changes]
            margin = share - max(others, default=0.0)
            evidence = _evidence(case, chosen, *reach, share)
        else:
            cause, chosen = "cheaper path", ("cheaper path",)
            best = max((one.repaired for one in trials), default=0.0)
            margin = REPAIRED - best
            evidence = _cheaper(path, ideal, first, last, best, tried(*chosen))
    return Segment(
        columns=run,
        mean_error=float(np.nanmean(errors)),
        worst_error=float(np.nanmax(errors)),
        cause=cause,
        contributing=contributing,
        evidence=evidence,
        trials=tuple(trials),
        margin=max(float(margin), 0.0),
        path_cost=path.totals(first, last),
        truth_cost=ideal.totals(first, last),
        line=lines[chosen] if chosen else (first, case.path_rows[first : last + 1]),
    )


def _needed(usable: Sequence[Change], tried: Any) -> tuple[Change, ...]:  # noqa: ANN401
    """The fewest changes that repair together: those are dropped without which it still does."""
    kept = list(usable)
    for one in reversed(usable):
        rest = [other for other in kept if other != one]
        if len(rest) > 1 and tried(*rest) >= REPAIRED:
            kept = rest
    return tuple(kept)


def _effect(case: Case, change: Change, first: int, last: int) -> float:
    """How much cheaper a change makes the truth."""
    columns = np.flatnonzero(case.columns_of(change, first, last))
    detection = case.detection
    if change == "missed edge":
        due = detection.no_edge_costs(case.rows[columns], columns)
        return float((due - case.typical_cost).sum())
    if change == "too steep":
        steep = np.maximum(case.steps[columns] - detection.delta, 0)
        return float(detection.link_weight * case.steps[columns].sum() + steep.sum())
    return float(case.saved(columns).sum())


@dataclass(frozen=True)
class _Doubt:
    """What speaks against a truth."""

    evidence: str
    margin: float
    trial: Trial


def _doubtful(case: Case, first: int, last: int) -> _Doubt | None:
    """What speaks against the truth; None where nothing does.

    The photo itself is asked, in colour, whatever the detector's edges are: along a true line the
    contrast from above to below is stronger than along its neighbours a few rows off. The
    counterfactual moves the truth, as a whole, to where the path is.
    """
    part = slice(first, last + 1)
    columns = np.arange(first, last + 1)[case.truth.visible[part]]
    detection = case.detection
    height = len(detection.photo)
    path = case.path_rows
    away = path[columns] - case.truth.rows[columns]
    apart = float(np.median(away))
    spread = float(np.median(np.abs(away - apart)))
    near = abs(apart) <= scaled(_BESIDE, height) and spread <= scaled(_SPREAD, height)
    on = float(detection.edges[path[columns], columns].mean())
    if not near or on < _ON_EDGES or len(columns) < 8:
        return None
    of_truth = _contrast(detection.photo, case.drawn_rows, columns)
    of_path = _contrast(detection.photo, path, columns)
    if of_truth > max(_NO_PEAK, _LESS_PEAK * of_path) or of_path < of_truth + _MORE_PEAK:
        return None
    moved = float((np.abs(away - apart) <= case.tolerance).mean())
    if moved < REPAIRED:
        return None
    where = "lower" if apart > 0 else "higher"
    return _Doubt(
        f"Along the path the photo's contrast is {1 + of_path:.1f} times that of the rows beside "
        f"it, along the truth {1 + of_truth:.1f} times. With the truth {abs(apart):.0f} px "
        f"{where}, {moved:.0%} of the columns are right: check the annotation.",
        min(of_path - of_truth, 1.0),
        Trial(("truth doubtful",), len(columns), moved),
    )


def _contrast(photo: U8, rows: Int, columns: npt.NDArray[np.intp]) -> float:
    """How much the contrast from above to below stands out along a line, about 0 on no edge.

    Mean gradient down the columns, in the channel where it is strongest, on the best of the rows
    next to the line, over the mean of those 3 to 6 rows off, less 1.
    """
    top = max(int(rows[columns].min()) - _BAND, 0)
    bottom = int(rows[columns].max()) + _BAND
    part = photo[top : bottom + 1].astype(np.float32)
    down = np.abs(cv2.Sobel(part, cv2.CV_32F, 0, 1, ksize=3)).reshape(*part.shape).max(axis=2)
    profile = {
        off: float(down[(rows[columns] + off - top).clip(0, len(down) - 1), columns].mean())
        for off in range(-6, 7)
    }
    here = max(profile[off] for off in (-2, -1, 0, 1))
    around = [value for off, value in profile.items() if off >= 3 or off <= -4]
    return here / max(float(np.mean(around)), 1e-6) - 1


def _evidence(case: Case, chosen: Sequence[Change], first: int, last: int, share: float) -> str:
    """What was found and what was changed."""
    detection = case.detection
    length = last - first + 1
    said = []
    for change in chosen:
        columns = case.columns_of(change, first, last)
        count = int(columns.sum())
        if change == "missed edge":
            said.append(f"the truth has no edge in {count} of {length} columns")
        elif change == "too steep":
            steepest = int(case.steps[columns].max())
            said.append(
                f"the truth climbs up to {steepest} rows a column "
                f"(delta {detection.delta}, link weight {detection.link_weight:g})"
            )
        else:
            pixels = case.pixels[columns]
            score = float(np.median(detection.scores[pixels]))
            said.append(
                f"{count} edge pixels of the truth score {score:.2f}"
                f"{_in_bins(detection, pixels)}, where {case.typical[0]:.2f} is typical"
            )
    found = "; ".join(said)
    mended = f"With that made right, {share:.0%} of the segment is right."
    return f"{found[:1].upper()}{found[1:]}. {mended}"


def _in_bins(detection: Detection, pixels: Int) -> str:
    """Which bins some edge pixels fell into, in words; nothing for methods without bins."""
    if not isinstance(detection, FilterDetection):
        return ""
    count = len(np.unique(detection.bins[pixels]))
    kind = "starved" if detection.starved[pixels].all() else "well-trained"
    return f" in {count} {kind} {'bin' if count == 1 else 'bins'}"


def _cheaper(
    path: CostSplit, ideal: CostSplit, first: int, last: int, best: float, without: float
) -> str:
    """Which stage prefers the path, and by how much."""
    paid, due = path.totals(first, last), ideal.totals(first, last)
    dearer = {stage: due[stage] - paid[stage] for stage in paid}
    stage = max(dearer, key=lambda one: dearer[one])
    total = sum(dearer.values())
    then = f"Without the path's edges, {without:.0%} of the columns come back"
    return (
        f"The path is {abs(total):.1f} cheaper than the truth here, {dearer[stage]:.1f} of it by "
        f"{stage}. No change of the truth brings back more than {best:.0%} of "
        f"the columns. {then}{'.' if without >= REPAIRED else '; yet other lines are cheaper.'}"
    )
