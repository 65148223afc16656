"""What would mend wrong segments: other settings, tried out on the photo."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np

from skyline_viz.arrays import Int
from skyline_viz.config import DetectorConfig
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detection import Detection
from skyline_viz.detector import Detector
from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.diagnosis.diagnosing import Diagnosis
from skyline_viz.diagnosis.other_settings import flags, pairs_to_try, settings_to_try
from skyline_viz.evaluation.metrics import column_errors, is_gross_miss, wrong_segments
from skyline_viz.sky_model import SkyModel
from skyline_viz.skyline import Skyline

LARGER = "--sky large"
"""The flag of the larger sky model, which is a remedy of detectors with the small one."""

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

    pair: bool = False
    """Whether two settings were tried at once: those that helped this photo most."""


def try_remedies(
    detection: Detection, truth: Skyline, found: Diagnosis, only: Collection[str] | None = None
) -> tuple[Remedy, ...]:
    """Detect with other settings, and count segments that are right then, or wrong only then.

    Each setting is tried alone, then pairs of those that helped most, then the larger sky model.
    Nothing is tried on detections of methods that have other settings than ours.

    Args:
        detection: The detection.
        truth: The true line.
        found: The diagnosis.
        only: Names of remedies, to try these alone and no pairs; everything unless given.
    """
    if not isinstance(detection, FilterDetection):
        return ()
    case, config = Case(detection, truth, found.tolerance), detection.config
    runs = [segment.columns for segment in found.segments]
    known: dict[bytes, Remedy] = {}  # many settings find the same line

    def tried(name: str, spelt: str, detector: Detector) -> Remedy:
        rows = detector.rows_again(detection)
        line = rows.tobytes()
        if line not in known:
            known[line] = _remedy(case, runs, name, spelt, rows)
        return replace(known[line], name=name, flags=spelt)

    def with_settings(name: str, changed: DetectorConfig) -> Remedy:
        detector = replace(detection.detector, config=changed)
        return tried(name, flags(config, changed), detector)

    single = settings_to_try(detection)
    alone = [
        with_settings(name, changed)
        for name, changed in single.items()
        if only is None or name in only
    ]
    changes = {one.name: one.change for one in alone}
    pairs = pairs_to_try(config, single, changes) if only is None else {}
    both = [replace(with_settings(*one), pair=True) for one in pairs.items()]
    name, ours = f"the larger sky model ({LARGER})", detection.detector
    small = config.sky_weight and ours.sky == SkyModel.small()
    if not small or (only is not None and name not in only):
        return (*alone, *both)
    return (*alone, *both, tried(name, LARGER, replace(ours, sky=SkyModel.large())))


def ranked(remedies: Sequence[Remedy]) -> list[Remedy]:
    """Remedies of a photo, that first with which its error is smallest."""
    return sorted(remedies, key=lambda one: one.a_err)


def best(remedies: Sequence[Remedy]) -> Remedy | None:
    """The one with the smallest error, if any makes it smaller."""
    found = min(remedies, key=lambda one: one.a_err, default=None)
    return found if found and found.change < 0 else None


def most_helpful(
    detection: Detection, truth: Skyline, found: Diagnosis
) -> tuple[Remedy, Skyline] | None:
    """The best remedy of a detection, and the line with it; None where nothing helps."""
    tried = try_remedies(detection, truth, found)
    remedy = best(tried)
    line = line_with(detection, remedy, tried) if remedy else None
    return (remedy, line) if remedy and line else None


def line_with(detection: Detection, remedy: Remedy, tried: Sequence[Remedy]) -> Skyline | None:
    """The line of a detection with one of the remedies that `try_remedies` tried on it.

    Args:
        detection: The detection.
        remedy: The remedy.
        tried: All that were tried; they tell which settings were paired.
    """
    if not isinstance(detection, FilterDetection):
        return None
    if remedy.flags == LARGER:
        return replace(detection.detector, sky=SkyModel.large()).again(detection).skyline
    single = settings_to_try(detection)
    changes = {one.name: one.change for one in tried}
    config = {**single, **pairs_to_try(detection.config, single, changes)}.get(remedy.name)
    return detection.again(config).skyline if config else None


def _remedy(
    case: Case, runs: Sequence[tuple[int, int]], name: str, spelt: str, rows: Int
) -> Remedy:
    """What a line does that another setting has found."""
    height = len(case.detection.edges)
    errors = column_errors(Skyline(rows.astype(np.float32)), case.truth)
    wrong = wrong_segments(errors, height, case.tolerance)
    after = float(np.nanmean(errors))
    return Remedy(
        name=name,
        flags=spelt,
        repaired=sum(case.repaired(0, rows, *run) >= REPAIRED for run in runs),
        broken=sum(_broken(run, runs) for run in wrong),
        a_err=after,
        change=after - float(np.nanmean(case.errors)),
        gross_miss=is_gross_miss(after, height),
    )


def _broken(new: tuple[int, int], runs: Sequence[tuple[int, int]]) -> bool:
    """Whether a run is new, or has grown by more than half."""
    before = sum(last - first + 1 for first, last in runs if first <= new[1] and new[0] <= last)
    return new[1] - new[0] + 1 > _GROWN * before
