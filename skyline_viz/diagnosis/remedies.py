"""Remedies: other settings, tried on a photo that was diagnosed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from skyline_viz.config import DetectorConfig, EdgeSource
from skyline_viz.detector import Detector, FilterDetection
from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.diagnosis.diagnosing import Diagnosis, failing_runs
from skyline_viz.evaluation.metrics import column_errors
from skyline_viz.skyline import Skyline

_GROWN = 1.5  # times its length from which on a segment is broken


@dataclass(frozen=True)
class Remedy:
    """What another setting does to a photo."""

    name: str
    """What was set, in words, and how on the command line where it is the same for all photos."""

    repaired: int
    """Segments that are right then."""

    broken: int
    """Segments that are wrong only then, or longer by more than half."""

    change: float
    """Change of the photo's A_err, in pixels; negative is better."""


def settings_to_try(
    config: DetectorConfig, thresholds: tuple[float, float]
) -> dict[str, DetectorConfig]:
    """Other settings that may help, by what they are in words.

    Args:
        config: The settings as they are.
        thresholds: Canny thresholds of the detection.
    """
    low, high = thresholds
    other: EdgeSource = "colour" if config.edge_source == "grey" else "grey"
    halved = replace(config, fit_thresholds=False, low_threshold=low / 2, high_threshold=high / 2)
    settings = {
        "half the Canny thresholds": halved,
        f"edges of the {other} photo": replace(config, edge_source=other),
        "twice the delta": replace(config, delta=2 * config.delta),
        "half the link weight": replace(config, link_weight=config.link_weight / 2),
        "v less by 0.25": replace(config, v=max(config.v - 0.25, 0.0)),
        "v more by 0.25": replace(config, v=min(config.v + 0.25, 1.0)),
        "half the cost of no edge": replace(config, non_edge_cost=config.non_edge_cost / 2),
    }
    return {
        f"{name}{_flags(config, changed)}": changed
        for name, changed in settings.items()
        if changed != config
    }


def _flags(config: DetectorConfig, changed: DetectorConfig) -> str:
    """The flags that change settings; nothing where each photo has values of its own."""
    if config.fit_thresholds != changed.fit_thresholds:
        return ""
    named = [one.name for one in fields(config)]
    flags = [
        f"--config.{name.replace('_', '-')} {_value(getattr(changed, name))}"
        for name in named
        if getattr(config, name) != getattr(changed, name)
    ]
    return f" ({' '.join(flags)})"


def _value(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def try_remedies(
    detection: FilterDetection, truth: Skyline, found: Diagnosis
) -> tuple[Remedy, ...]:
    """Detect with other settings, and count segments that are right then, or wrong only then."""
    case = Case(detection, truth, found.tolerance)
    before = float(np.nanmean(case.errors))
    runs = [segment.columns for segment in found.segments]
    remedies = []
    for name, config in settings_to_try(detection.config, detection.thresholds).items():
        skyline = Detector(detection.bank, config).again(detection).skyline
        errors = column_errors(skyline, truth)
        rows = skyline.rows.astype(np.int32)
        repaired = sum(case.repaired(0, rows, *run) >= REPAIRED for run in runs)
        broken = sum(_broken(run, runs) for run in failing_runs(errors > found.tolerance))
        remedies.append(Remedy(name, repaired, broken, float(np.nanmean(errors)) - before))
    return tuple(remedies)


def _broken(new: tuple[int, int], runs: Sequence[tuple[int, int]]) -> bool:
    """Whether a run is new, or has grown by more than half."""
    before = sum(last - first + 1 for first, last in runs if first <= new[1] and new[0] <= last)
    return new[1] - new[0] + 1 > _GROWN * before
