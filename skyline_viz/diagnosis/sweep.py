"""How the path changes with one setting: which values to try, and the detection with each.

A sweep is centred on the settings of a detection. Its steps are whole numbers, because that is what
a timeline of the viewer counts; what they count is chosen so that they read well.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from skyline_viz.config import RANGES, DetectorConfig
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detector import Detector
from skyline_viz.edges import LOWEST_FACTOR
from skyline_viz.filter_bank import FilterBank

_LEAST = 0.1  # what a weight of 0 is swept up from, where the default is 0, too


@dataclass(frozen=True, eq=False)
class Step:
    """One value of a setting."""

    at: int
    """Where it is on the timeline."""

    value: str
    """The exact value, in words."""

    detector: Detector
    """A detector with this value, and all else as it was."""


@dataclass(frozen=True, eq=False)
class Sweep:
    """The values of one setting."""

    timeline: str
    """The setting, as its timeline is called."""

    title: str
    """The setting in words."""

    counts: str
    """What the timeline counts."""

    steps: tuple[Step, ...]
    """The values, smallest first."""

    present: int
    """The step that the detection's own value is at."""

    now: str
    """That value, in words."""

    note: str = ""
    """What else there is to know; a sentence, or nothing."""

    def detections(self, found: FilterDetection) -> Iterator[tuple[Step, FilterDetection]]:
        """Detect with each value. Stages that the setting leaves as they are are not repeated.

        Args:
            found: The detection around which the sweep was made.
        """
        for step in self.steps:
            yield step, step.detector.again(found)


def setting_sweeps(found: FilterDetection) -> list[Sweep]:
    """Sweeps around a detection: Canny thresholds, the weight of every term, and ``delta``."""
    weights = [_weight(found, setting) for setting in found.cost_model.settings]
    return [_thresholds(found), *weights, _delta(found)]


def size_sweep(found: FilterDetection, banks: Sequence[FilterBank]) -> Sweep:
    """Sweep of the filter size.

    Args:
        found: The detection.
        banks: Filter banks of several sizes, trained on the same photos.
    """
    made, own = banks[0].provenance, found.bank.provenance
    steps = {
        bank.size: (f"{bank.size} x {bank.size} px", replace(found.detector, bank=bank, label=""))
        for bank in banks
    }
    note = (
        f"All sizes learned from the same {_photos(made.images)} of {made.dataset}, without this "
        f"one; the present filters from {_photos(own.images)} of "
        f"{own.dataset or 'an unnamed data set'}."
    )
    return Sweep(
        "filter_size",
        "Filter size",
        "pixels a side",
        _in_order(steps),
        found.bank.size,
        f"{found.bank.size} x {found.bank.size} px",
        note,
    )


def _thresholds(found: FilterDetection) -> Sweep:
    """30 to 200 % of the thresholds that were used: as low as fitting lowers those of the paper."""
    steps = {}
    for percent in range(round(100 * LOWEST_FACTOR), 201, 10):
        low, high = (
            min(one * (percent / 100), most_of("low_threshold")) for one in found.thresholds
        )
        config = replace(found.config, fit_thresholds=False, low_threshold=low, high_threshold=high)
        steps[percent] = f"{low:.4g} and {high:.4g}", _with(found, config)
    return Sweep(
        "canny_thresholds",
        "Canny thresholds",
        "percent of the present ones",
        _in_order(steps),
        100,
        steps[100][0],
    )


def _weight(found: FilterDetection, setting: str) -> Sweep:
    """0 to 1 where that is the range, else 0 to three times the present value.

    The present value takes the place of one at the same step.
    """
    present = getattr(found.config, setting)
    most = most_of(setting)
    if most <= 1:
        values = [percent / 100 * most for percent in range(0, 101, 5)]
        return _numbers(found, setting, 100, "hundredths", [*values, present])
    unit = present or getattr(type(found.config)(), setting) or _LEAST
    values = [min(unit * fifths / 5, most) for fifths in range(16)]
    return _numbers(found, setting, 1000, "thousandths", [*values, present])


def most_of(setting: str) -> float:
    """The largest value that a setting may have; no end where none is known."""
    return RANGES.get(setting, (0.0, math.inf))[1]


def _delta(found: FilterDetection) -> Sweep:
    """1 to 12 px, or to twice the present value in a dozen steps where that is more."""
    present = found.config.delta
    stride = max(1, round(present / 6))
    values = [*range(stride, 12 * stride + 1, stride), present]
    top = round(most_of("delta"))
    return _numbers(found, "delta", 1, "pixels", [min(one, top) for one in values], " px")


def _numbers(
    found: FilterDetection,
    field: str,
    scale: int,
    counts: str,
    values: Iterable[float],
    unit: str = "",
) -> Sweep:
    """Sweep of a number of `DetectorConfig`; of values at the same step the last one counts."""
    steps = {}
    for value in values:
        config: DetectorConfig = replace(found.config, **{field: value})  # type: ignore[arg-type]
        steps[round(scale * value)] = f"{value:.4g}{unit}", _with(found, config)
    present = round(scale * getattr(found.config, field))
    title = field.replace("_", " ")
    title = title.capitalize() if " " in title else title  # v and delta are symbols
    return Sweep(field, title, counts, _in_order(steps), present, steps[present][0])


def _with(found: FilterDetection, config: DetectorConfig) -> Detector:
    return replace(found.detector, config=config, label="")


def _in_order(steps: dict[int, tuple[str, Detector]]) -> tuple[Step, ...]:
    return tuple(Step(at, *one) for at, one in sorted(steps.items()))


def _photos(count: int) -> str:
    return f"{count} photo" if count == 1 else f"{count} photos"
