"""What would mend wrong segments: other settings, tried out on the photo."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skyline_viz.detection import Detection
from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.diagnosis.diagnosing import Diagnosis
from skyline_viz.diagnosis.other_settings import flags, settings_to_try
from skyline_viz.evaluation.metrics import column_errors, is_gross_miss, wrong_segments
from skyline_viz.skyline import Skyline

_GROWN = 1.5  # times its length from which on a segment is broken


@dataclass(frozen=True)
class Remedy:
    """What another setting does to a photo."""

    name: str
    """What was set, in words, and how on the command line where it is the same for all photos."""

    flags: str
    """What to add to the command line to set it for this photo."""

    repaired: int
    """Segments that are right then."""

    broken: int
    """Segments that are wrong only then, or longer by more than half."""

    a_err: float
    """The photo's A_err with it, in pixels."""

    change: float
    """Change of the photo's A_err, in pixels; negative is better."""

    gross_miss: bool
    """Whether the photo is a gross miss then."""


def try_remedies(detection: Detection, truth: Skyline, found: Diagnosis) -> tuple[Remedy, ...]:
    """Detect with other settings, and count segments that are right then, or wrong only then.

    Nothing is tried on detections of methods that have other settings than ours.
    """
    height, config = len(detection.edges), detection.config
    case = Case(detection, truth, found.tolerance)
    before = float(np.nanmean(case.errors))
    runs = [segment.columns for segment in found.segments]
    remedies = []
    for name, changed in settings_to_try(detection).items():
        assert config is not None  # or there are none to try
        skyline = detection.again(changed).skyline
        errors = column_errors(skyline, truth)
        rows = skyline.rows.astype(np.int32)
        repaired = sum(case.repaired(0, rows, *run) >= REPAIRED for run in runs)
        broken = sum(_broken(run, runs) for run in wrong_segments(errors, height, found.tolerance))
        after = float(np.nanmean(errors))
        gross = is_gross_miss(after, height)
        spelt = flags(config, changed)
        remedies.append(Remedy(name, spelt, repaired, broken, after, after - before, gross))
    return tuple(remedies)


def best(remedies: Sequence[Remedy]) -> Remedy | None:
    """The one with the smallest error, if any makes it smaller."""
    found = min(remedies, key=lambda one: one.a_err, default=None)
    return found if found and found.change < 0 else None


def most_helpful(
    detection: Detection, truth: Skyline, found: Diagnosis
) -> tuple[Remedy, Skyline] | None:
    """The best remedy of a detection, and the line with it; None where nothing helps."""
    remedy = best(try_remedies(detection, truth, found))
    if remedy is None:
        return None
    return remedy, detection.again(settings_to_try(detection)[remedy.name]).skyline


def _broken(new: tuple[int, int], runs: Sequence[tuple[int, int]]) -> bool:
    """Whether a run is new, or has grown by more than half."""
    before = sum(last - first + 1 for first, last in runs if first <= new[1] and new[0] <= last)
    return new[1] - new[0] + 1 > _GROWN * before
