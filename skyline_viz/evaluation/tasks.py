"""A photo and the method that it is tested with: what is spread over processes, and kept."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from typing import Any, TypeVar

import numpy as np

from skyline_viz.datasets.item import Item, photo_and_truth
from skyline_viz.datasets.predictions import Predictions, size_of
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.evaluation.seen import seen_in_training
from skyline_viz.method import Method
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.resume import Codec, Kept, digest_of_item, digest_of_method
from skyline_viz.running.warming import warm_up
from skyline_viz.skyline import SkylineError

NO_LINE = "there is no line for it in"
"""How the sentence about a photo begins for which a folder of lines holds none."""

Value = TypeVar("Value")


@dataclass(frozen=True)
class PhotoTask:
    """A photo, and the method that it is tested with."""

    item: Item
    method: Method
    digest: str = ""
    """Of the method, where results are kept."""

    @property
    def name(self) -> str:
        """The photo's name."""
        return self.item.name


def photo_tasks(pairs: Iterable[tuple[Item, Method]], kept: Kept | None = None) -> list[PhotoTask]:
    """Tasks of photos and methods; where results are kept, with a digest of each method."""
    if not (kept and kept.folder):
        return [PhotoTask(item, method) for item, method in pairs]
    pairs = list(pairs)
    different = {id(method): method for _, method in pairs}
    digests = {number: digest_of_method(method) for number, method in different.items()}
    return [PhotoTask(item, method, digests[id(method)]) for item, method in pairs]


def run_tasks(
    work: Callable[[PhotoTask], Value],
    tasks: Sequence[PhotoTask],
    what: str,
    codec: Codec[Value],
    *,
    workers: int = 1,
    kept: Kept | None = None,
    title: str = "photos",
) -> tuple[list[Value], list[Failure]]:
    """What all photos came to, in order, and the photos that failed.

    Args:
        work: What to do; at the top level of a module, or a `functools.partial` of such.
        tasks: What to do it with.
        what: Kind and settings of the value, for what is kept.
        codec: How values are kept.
        workers: Number of processes, see `batch.run`.
        kept: Where finished photos are kept; nowhere unless given.
        title: What is counted, for the progress bar.
    """
    key, kept = partial(_key, what), kept or Kept()
    values: list[Value] = []
    failures: list[Failure] = []
    for outcome in kept.run(work, tasks, key, codec, workers=workers, title=title):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            values.append(outcome)
    return values, failures


def compare_photos(
    tasks: Sequence[PhotoTask], *, workers: int = 1, kept: Kept | None = None, title: str = "photos"
) -> tuple[list[PhotoResult], list[Failure]]:
    """Detect, and compare with the truth; takes what `run_tasks` takes."""
    codec: Codec[PhotoResult] = Codec(_record, _result)
    return run_tasks(compare_photo, tasks, "result", codec, workers=workers, kept=kept, title=title)


def compare_photo(task: PhotoTask) -> PhotoResult:
    """Detect the skyline of one photo, and compare it with the truth.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: It has no truth, or one that does not fit.
    """
    photo, truth = photo_and_truth(task.item)
    warm_up()
    found = task.method.detect(photo)
    result = PhotoResult.of(task.name, found.skyline, truth, len(photo), found.total_seconds)
    return replace(result, seen=seen_in_training(task.method, photo, task.name))


def compare_lines(
    items: Sequence[Item], given: Predictions, *, workers: int = 1
) -> tuple[list[PhotoResult], list[Failure]]:
    """Compare lines that exist with the truth; a photo without one has failed.

    Args:
        items: Photos with truth.
        given: The lines.
        workers: Number of processes, see `batch.run`.
    """
    results, failures = [], []
    work = partial(compare_line, given)
    for outcome in run(work, items, workers=workers, title=given.name):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            results.append(outcome)
    return results, failures


def compare_line(given: Predictions, item: Item) -> PhotoResult:
    """Compare the line of one photo with the truth.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: It has no line or no truth, or one that does not fit.
    """
    if item.name not in given.lines:
        raise SkylineError(f"{NO_LINE} {given.name}")
    truth = item.truth()
    if truth is None:
        raise SkylineError("there is no truth")
    height, width = size_of(item)
    if truth.width != width:
        raise SkylineError(f"the photo is {width} columns wide, the truth {truth.width}")
    return PhotoResult.of(item.name, given.line(item), truth, height)


def told_once(failures: Mapping[str, Sequence[Failure]]) -> list[Failure]:
    """Failures under several methods: what fails alike under all of them is told once.

    >>> gone, lost = Failure("a", "it is gone"), Failure("b", "it is lost")
    >>> [str(one) for one in told_once({"paper": [gone], "edges": [gone, lost]})]
    ['a: it is gone.', 'b, edges: it is lost.']

    Args:
        failures: By the name of the method.
    """
    told: dict[Failure, None] = {}
    for method, mine in failures.items():
        for one in mine:
            if one.name == method or all(one in others for others in failures.values()):
                told[one] = None
            else:
                told[replace(one, name=f"{one.name}, {method}")] = None
    return list(told)


def _key(what: str, task: PhotoTask) -> str:
    """Digest of all that a value is made from."""
    return digest_of_item(f"{what} {task.digest}", task.item)


def _record(result: PhotoResult) -> dict[str, Any]:
    """A result as JSON takes it: without errors where the truth is not visible."""
    record = {one.name: getattr(result, one.name) for one in fields(result)}
    if result.errors is not None:
        told = np.isfinite(result.errors)
        record["errors"] = [
            float(error) if seen else None
            for error, seen in zip(result.errors.tolist(), told.tolist(), strict=True)
        ]
    return record


def _result(record: dict[str, Any]) -> PhotoResult:
    if record.get("errors") is not None:
        errors = [np.nan if one is None else one for one in record["errors"]]
        record = {**record, "errors": np.array(errors, np.float32)}
    return PhotoResult(**record)
