"""What would mend wrong segments: other settings, tried out on the photo."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from skyline_viz.config import DetectorConfig, EdgeSource
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.diagnosis.diagnosing import Diagnosis
from skyline_viz.diagnosis.sweep import most_of
from skyline_viz.evaluation.metrics import column_errors, wrong_segments
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


def settings_to_try(found: Detection) -> dict[str, DetectorConfig]:
    """Other settings that may help, by what they are in words.

    Edges that are found otherwise, steeper lines, and another weight of every term of the cost.

    Args:
        found: The detection, with the settings as they are; one of a method that has other
            settings than ours gets none to try.
    """
    config = found.config
    if config is None or found.thresholds is None:
        return {}
    low, high = found.thresholds
    other: EdgeSource = "colour" if config.edge_source == "grey" else "grey"
    halved = replace(config, fit_thresholds=False, low_threshold=low / 2, high_threshold=high / 2)
    settings = {
        "half the Canny thresholds": halved,
        f"edges of the {other} photo": replace(config, edge_source=other),
        "twice the delta": replace(config, delta=2 * config.delta),
    }
    for setting in found.cost_model.settings:
        name = next(term.name for term in found.cost_model.terms if term.setting == setting)
        for words, value in _other_weights(config, setting, name):
            settings[words] = replace(config, **{setting: value})  # type: ignore[arg-type]
    return {
        f"{name}{_flags(config, changed)}": changed
        for name, changed in settings.items()
        if changed != config
    }


def _other_weights(config: DetectorConfig, setting: str, term: str) -> Iterator[tuple[str, float]]:
    """Values to try of the setting that weighs a term, and what they are in words."""
    present, most = getattr(config, setting), most_of(setting)
    if most <= 1:
        yield f"{setting} less by 0.25", max(present - 0.25, 0.0)
        yield f"{setting} more by 0.25", min(present + 0.25, most)
        return
    weight = "link weight" if term == "link" else f"cost of {term}"
    if not present:
        usual = getattr(type(config)(), setting)
        yield f"the {weight} at {usual:g}", usual
        return
    yield f"half the {weight}", present / 2
    yield f"twice the {weight}", min(2 * present, most)


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


def try_remedies(detection: Detection, truth: Skyline, found: Diagnosis) -> tuple[Remedy, ...]:
    """Detect with other settings, and count segments that are right then, or wrong only then.

    Nothing is tried on detections of methods that have other settings than ours.
    """
    height = len(detection.edges)
    case = Case(detection, truth, found.tolerance)
    before = float(np.nanmean(case.errors))
    runs = [segment.columns for segment in found.segments]
    remedies = []
    for name, config in settings_to_try(detection).items():
        skyline = detection.again(config).skyline
        errors = column_errors(skyline, truth)
        rows = skyline.rows.astype(np.int32)
        repaired = sum(case.repaired(0, rows, *run) >= REPAIRED for run in runs)
        broken = sum(_broken(run, runs) for run in wrong_segments(errors, height, found.tolerance))
        remedies.append(Remedy(name, repaired, broken, float(np.nanmean(errors)) - before))
    return tuple(remedies)


def _broken(new: tuple[int, int], runs: Sequence[tuple[int, int]]) -> bool:
    """Whether a run is new, or has grown by more than half."""
    before = sum(last - first + 1 for first, last in runs if first <= new[1] and new[0] <= last)
    return new[1] - new[0] + 1 > _GROWN * before
