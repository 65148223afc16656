"""A whole data set, diagnosed photo by photo, each with what would help.

Where that is asked for, photos that are right but for blips are looked at twice, see `worth`.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from skyline_viz.datasets.item import photo_and_truth
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.record import Diagnosed, pack, unpack
from skyline_viz.diagnosis.remedies import Remedy, try_remedies
from skyline_viz.diagnosis.worth import waits, worth_trying
from skyline_viz.evaluation.metrics import column_errors, is_gross_miss
from skyline_viz.evaluation.seen import seen_in_training
from skyline_viz.evaluation.tasks import PhotoTask, run_tasks
from skyline_viz.running.batch import Failure
from skyline_viz.running.resume import Codec, Kept
from skyline_viz.running.warming import warm_up
from skyline_viz.skyline import Skyline


def diagnose_photos(
    tasks: Sequence[PhotoTask],
    tolerance: float = 0.0,
    *,
    remedies: bool = True,
    workers: int = 1,
    kept: Kept | None = None,
) -> tuple[list[Diagnosed], list[Failure]]:
    """Diagnose photos, each as the method finds it that it is to be tested with.

    Args:
        tasks: Photos and methods, see `evaluation.assign`.
        tolerance: See `diagnosis.diagnose`; 0 takes the usual one.
        remedies: Whether to try other settings, too: all of them on a photo alone, and on those
            that are wrong by more than blips; on the others those that are worth it there.
        workers: Number of processes, see `batch.run`.
        kept: Where finished photos are kept; nowhere unless given.

    Returns:
        The diagnosed photos in order, and those that failed.
    """
    waiting = remedies and len(tasks) > 1
    found, failures = run_tasks(
        partial(diagnose_photo, tolerance or None, remedies=remedies, waiting=waiting),
        tasks,
        f"diagnosis {tolerance} {remedies} {waiting}",
        Codec(pack, unpack),
        workers=workers,
        kept=kept,
        title="diagnosing",
    )
    only = worth_trying([one for one in found if not waits(one.a_err, one.diagnosis)])
    if not (waiting and only):
        return found, failures
    later = {one.name for one in found if waits(one.a_err, one.diagnosis)}
    again, failed = run_tasks(
        partial(diagnose_photo, tolerance or None, remedies=True, only=only),
        [task for task in tasks if task.name in later],
        f"diagnosis {tolerance} {sorted(only)}",
        Codec(pack, unpack),
        workers=workers,
        kept=kept and Kept(kept.folder),  # whose counts are those of photos
        title="trying settings",
    )
    tried = {one.name: one.remedies for one in again}
    lost = {one.name for one in failed}
    told = [
        replace(one, remedies=tried.get(one.name, one.remedies))
        for one in found
        if one.name not in lost
    ]
    return told, [*failures, *failed]


def diagnose_photo(
    tolerance: float | None,
    task: PhotoTask,
    *,
    remedies: bool,
    waiting: bool = False,
    only: Collection[str] | None = None,
) -> Diagnosed:
    """Diagnose a photo of a data set.

    Args:
        tolerance: See `diagnosis.diagnose`.
        task: The photo and its method.
        remedies: Whether to try other settings, too.
        waiting: Whether nothing is tried on it if it is right but for blips, see `worth.waits`.
        only: What is tried, see `remedies.try_remedies`.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: It has no truth, or one that does not fit.
    """
    photo, truth = photo_and_truth(task.item)
    warm_up()
    detection = task.method.detect(photo)
    found = diagnose_detection(
        task.name, detection, truth, tolerance, remedies=remedies, waiting=waiting, only=only
    )
    if only is not None:
        return found  # what has seen it is known since the first time
    return replace(found, seen=seen_in_training(task.method, photo, task.name))


def diagnose_detection(
    name: str,
    detection: Detection,
    truth: Skyline,
    tolerance: float | None = None,
    *,
    remedies: bool,
    waiting: bool = False,
    only: Collection[str] | None = None,
) -> Diagnosed:
    """Diagnose what was found in a photo, and try what would mend it.

    Args:
        name: What the photo is called.
        detection: The detection.
        truth: The true line.
        tolerance: See `diagnosis.diagnose`.
        remedies: Whether to try other settings, too.
        waiting: See `diagnose_photo`.
        only: See `remedies.try_remedies`.

    Raises:
        SkylineError: The truth does not fit, or is visible nowhere.
    """
    found = diagnose(detection, truth, tolerance)
    a_err = float(np.nanmean(column_errors(detection.skyline, truth)))
    tried: tuple[Remedy, ...] = ()
    if remedies and not (waiting and waits(a_err, found)):
        tried = try_remedies(detection, truth, found, only)
    gross = is_gross_miss(a_err, len(detection.photo))
    return Diagnosed(name, a_err, gross, int(truth.visible.sum()), found, tried)
