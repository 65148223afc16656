"""What a diagnosis found in a segment, in sentences."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from skyline_viz.arrays import Int
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.counterfactual import Case, Change
from skyline_viz.diagnosis.edges_anew import FACTORS
from skyline_viz.diagnosis.trials import Trial


def changes_found(
    case: Case, chosen: Sequence[Change], run: tuple[int, int], reach: tuple[int, int]
) -> str:
    """What the truth lacks.

    Args:
        case: Detection and truth.
        chosen: In which respects.
        run: First and last column of the segment.
        reach: First and last column of the path's excursion around it, in which it was changed.
    """
    said = "; ".join(_found(case, change, *reach) for change in chosen)
    first, last = reach
    if reach == run:
        return f"{said[:1].upper()}{said[1:]}."
    return f"Between columns {first} and {last}, where the path leaves the truth, {said}."


def changes_helped(share: float) -> str:
    """What the changes of the truth brought back."""
    return f"With that made right, {share:.0%} of the wrong columns are right."


def cheaper_by(paid: Mapping[str, float], due: Mapping[str, float], best: float) -> str:
    """Which term prefers the path, and by how much.

    Args:
        paid: What the path pays, term by term.
        due: What the truth pays.
        best: The largest share that a change of the truth brings back.
    """
    dearer = {term: due[term] - paid[term] for term in paid}
    term = max(dearer, key=lambda one: dearer[one])
    total = sum(dearer.values())
    if total > 0:
        costs = (
            f"The path is {total:.1f} cheaper than the truth here, "
            f"mostly by {term} ({dearer[term]:.1f})."
        )
    else:  # it is cheaper on the way there and back
        costs = f"The path is {-total:.1f} dearer than the truth here, and cheaper beside it."
    helps = f"more than {best:.0%} of the wrong columns" if best else "any wrong column"
    return f"{costs} No change of the truth alone brings back {helps}."


def terms_equal(proof: Trial | None) -> str:
    """What came back when the truth paid no more for some terms than other lines.

    Args:
        proof: The trial; None where none brought the path back.
    """
    if proof is None:
        return "Nothing that was tried brings it back, not even a truth as cheap as other lines."
    lines = "the path" if proof.lines == 1 else f"the {proof.lines} lines that are cheaper"
    changes = proof.changes[1:]
    also = f" and with the truth made right ({', '.join(changes)})," if changes else ","
    return (
        f"With the truth paying no more for {' and '.join(proof.terms)} than {lines}{also} "
        f"{proof.repaired:.0%} of the wrong columns come back."
    )


def found_anew(trials: Sequence[Trial]) -> str:
    """What came back with edges found anew around both lines.

    Args:
        trials: At least one.
    """
    trial = max(trials, key=lambda one: one.repaired)
    if not trial.repaired:
        return "No other Canny thresholds around both lines bring anything back."
    words = FACTORS[trial.thresholds]
    return (
        f"With edges found anew around both lines, with {words} Canny thresholds, "
        f"{trial.repaired:.0%} come back."
    )


def _found(case: Case, change: Change, first: int, last: int) -> str:
    detection = case.detection
    columns = case.columns_of(change, first, last)
    count = int(columns.sum())
    if change == "missed edge":
        seen = int(case.truth.visible[first : last + 1].sum())
        return f"the truth has no edge in {count} of {seen} columns"
    if change == "too steep":
        steepest = int(case.steps[columns].max())
        return (
            f"the truth climbs up to {steepest} rows a column "
            f"(delta {detection.delta}, link weight {detection.link_weight:g})"
        )
    pixels = case.pixels[columns]
    score = float(np.median(detection.scores[pixels]))
    return (
        f"{count} edge pixels of the truth score {score:.2f}"
        f"{_in_bins(detection, pixels)}, where {case.typical[0]:.2f} is typical"
    )


def _in_bins(detection: Detection, pixels: Int) -> str:
    """Which bins some edge pixels fell into, in words; nothing for methods without bins."""
    bins = detection.stages.get("bin")
    if bins is None:
        return ""
    count = len(np.unique(bins.values[pixels]))
    kind = "starved" if detection.starved[pixels].all() else "well-trained"
    return f" in {count} {kind} {'bin' if count == 1 else 'bins'}"
