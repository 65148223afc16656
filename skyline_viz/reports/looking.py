"""Photos of a data set, looked at again for a report: each with the lines, maps and costs it had.

What a report shows of a photo is large, and so it is not kept while the others are worked on. A
detection takes little beside what a diagnosis tries.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from skyline_viz.datasets.item import Item
from skyline_viz.diagnosis.data_set import diagnose_detection
from skyline_viz.diagnosis.record import Diagnosed
from skyline_viz.evaluation.seen import seen_in_training
from skyline_viz.evaluation.tasks import PhotoTask
from skyline_viz.method import Method
from skyline_viz.reports.photo_report import PhotoReport, photo_report
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.warming import warm_up


@dataclass(frozen=True)
class _Task:
    """A photo to look at."""

    name: str
    item: Item
    method: Method
    diagnosed: Diagnosed | None


def look_at(
    tasks: Sequence[PhotoTask],
    diagnosed: Sequence[Diagnosed] = (),
    *,
    remedies: bool = False,
    workers: int = 1,
) -> tuple[list[PhotoReport], list[Failure]]:
    """Gather what a report shows of photos.

    Args:
        tasks: Photos, each with its method, see `evaluation.assign`.
        diagnosed: What is known of some of them; the others are diagnosed where they have a truth.
        remedies: Whether other settings are tried on these, too.
        workers: Number of processes, see `batch.run`.

    Returns:
        The photos in order, and those that failed.
    """
    known: Mapping[str, Diagnosed] = {one.name: one for one in diagnosed}
    looks = [_Task(one.name, one.item, one.method, known.get(one.name)) for one in tasks]
    work = partial(_look, photos=len(looks), remedies=remedies)
    found: list[PhotoReport] = []
    failures: list[Failure] = []
    for outcome in run(work, looks, workers=workers, title="report"):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            found.append(outcome)
    return found, failures


def _look(task: _Task, *, photos: int, remedies: bool) -> PhotoReport:
    return look(task, task.diagnosed, photos=photos, remedies=remedies)


def look(
    task: PhotoTask | _Task,
    diagnosed: Diagnosed | None = None,
    *,
    photos: int = 1,
    remedies: bool = False,
) -> PhotoReport:
    """Gather what a report shows of one photo.

    Args:
        task: The photo, with its method.
        diagnosed: What is known of it; it is diagnosed where it has a truth.
        photos: How many the report is of.
        remedies: Whether other settings are tried on it.
    """
    photo, truth = task.item.photo(), task.item.truth()
    warm_up()
    detection = task.method.detect(photo)
    if diagnosed is None and truth is not None and truth.visible.any():
        diagnosed = diagnose_detection(task.name, detection, truth, remedies=remedies)
    report = photo_report(task.name, detection, truth, diagnosed, photos=photos)
    return replace(report, seen=seen_in_training(task.method, photo, task.name))
