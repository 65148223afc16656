"""How A_err changes with one setting of the detector, on any number of photos."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any

from skyline_viz.config import DetectorConfig, refuse_gone
from skyline_viz.datasets.item import Item, photo_and_truth
from skyline_viz.detector import Detector
from skyline_viz.evaluation.evaluated import Evaluation
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.method import Method, MethodError
from skyline_viz.methods.finding.plugins import as_method
from skyline_viz.methods.registry import find_method
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.warming import warm_up
from skyline_viz.system.nearest import meant


def sweep(
    items: Iterable[Item],
    setting: str,
    values: Iterable[float | str],
    detector: str | Method = "default",
    *,
    workers: int = 1,
) -> Evaluation:
    """Detect with several values of one setting, all else as it is, and compare with the truth.

    Stages that the setting leaves as they are are computed once a photo.

    Args:
        items: Photos with truth; one photo is a list of one.
        setting: Name of a setting of the detector's configuration.
        values: Its values.
        detector: Around which settings: a detector, or one as `find_method` takes it.
        workers: Number of processes; 1 works in this one, 0 chooses by the number of photos.

    Returns:
        Results under ``SETTING=VALUE``. Seconds are those of the stages that were computed anew.

    Raises:
        MethodError: The detector is unknown, or is another method than ours.
        ValueError: There is no such setting, or it does not take one of the values.

    Examples:
        >>> from skyline_viz.datasets.item import LoadedItem
        >>> from skyline_viz.rendering import render
        >>> scene = render("snow", 5, 240, 160)
        >>> found = sweep([LoadedItem(scene.name, scene.photo, scene.truth)], "delta", [0, 4])
        >>> found.summaries["delta=0"].mean > found.summaries["delta=4"].mean  # 0 is a level line
        True
    """
    start = find_method(detector) if isinstance(detector, str) else as_method(detector)
    if not isinstance(start, Detector):
        raise MethodError(f"settings are swept of our own detector, not of {start.name}.")
    known = [one.name for one in fields(start.config)]
    if setting not in known:
        refuse_gone([setting])
        raise ValueError(f"there is no setting {setting}; {meant(setting, known, 'there are')}")
    detectors = {
        f"{setting}={value}": replace(start, config=_with(start.config, setting, value))
        for value in values
    }
    results: dict[str, list[PhotoResult]] = {name: [] for name in detectors}
    failures: list[Failure] = []
    work = partial(_compare, tuple(detectors.values()))
    for outcome in run(work, tuple(items), workers=workers, title=setting):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            for name, one in zip(detectors, outcome, strict=True):
                results[name].append(one)
    return Evaluation(results, tuple(failures), detectors)


def _with(config: DetectorConfig, setting: str, value: Any) -> DetectorConfig:  # noqa: ANN401
    """The settings with another value of one, which the settings themselves check."""
    return replace(config, **{setting: value})


def _compare(detectors: Sequence[Detector], item: Item) -> list[PhotoResult]:
    photo, truth = photo_and_truth(item)
    warm_up()
    results = []
    found = None
    for one in detectors:
        found = one.detect(photo) if found is None else one.again(found)
        results.append(
            PhotoResult.of(item.name, found.skyline, truth, len(photo), found.total_seconds)
        )
    return results
