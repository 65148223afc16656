"""What ``skyline-viz inspect`` logs besides a detection: its diagnosis, other methods, sweeps."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from skyline_viz import evaluation
from skyline_viz.command_line.inputs import with_truth
from skyline_viz.command_line.messages import UsageError, say, tell
from skyline_viz.photo import PhotoError
from skyline_viz.running.progress import ProgressBar
from skyline_viz.storage.addresses import StorageError

if TYPE_CHECKING:
    import rerun as rr

    from skyline_viz.arrays import U8
    from skyline_viz.datasets.dataset import Dataset, DatasetItem
    from skyline_viz.datasets.named_item import NamedItem
    from skyline_viz.detecting.filter_detection import FilterDetection
    from skyline_viz.detection import Detection
    from skyline_viz.detector import Detector
    from skyline_viz.diagnosis.diagnosing import Diagnosis
    from skyline_viz.diagnosis.sweep import Sweep
    from skyline_viz.evaluation.verdict import Verdict
    from skyline_viz.filter_bank import FilterBank
    from skyline_viz.method import Method
    from skyline_viz.running.batch import Failure
    from skyline_viz.skyline import Skyline
    from skyline_viz.viewer.contents import Fidelity, MethodContents

_WARM = 64  # rows and columns of a detection before the timed one


def tell_verdict(verdict: Verdict, method: Method, photo: U8, name: str) -> None:
    """Tell how wrong and how sure a line is, and where the photo was seen in training."""
    from skyline_viz.evaluation.seen import notes, seen_in_training

    error = "" if verdict.a_err is None else f"  A_err {verdict.a_err:.2f} px"
    tell(f"{name}{error}  margin {verdict.margin:.3g}")
    if verdict.a_err is None:
        return
    for note in notes(method.name, {name: seen_in_training(method, photo, name)}, folds=True):
        say(note)


def log_diagnosis(
    recording: rr.RecordingStream, found: Detection, truth: Skyline, name: str
) -> Diagnosis:
    """Find out why a detection went wrong and what would mend it, and log it where it did."""
    from skyline_viz.diagnosis.diagnosing import diagnose
    from skyline_viz.diagnosis.remedies import most_helpful
    from skyline_viz.viewer.diagnosis_recording import log_diagnosis as log_it

    diagnosis = diagnose(found, truth)
    if not diagnosis.right:
        mended = most_helpful(found, truth, diagnosis)
        log_it(recording, diagnosis, found, truth, name, mended=mended)
    return diagnosis


def log_other_lines(recording: rr.RecordingStream, found: Detection, truth: Skyline | None) -> int:
    """Search the best lines along other ridges, and log them; return how many there are."""
    import numpy as np

    from skyline_viz.certainty.other_lines import other_lines
    from skyline_viz.viewer.lines_recording import log_lines

    height = len(found.photo)
    rows = found.skyline.pixel_rows(height).clip(0, height - 1).astype(np.int32)
    lines = other_lines(found.cost, found.delta, found.link_weight, rows)
    log_lines(recording, found, lines, truth)
    return len(lines)


def log_methods(
    recording: rr.RecordingStream,
    found: Detection,
    methods: Sequence[Method],
    truth: Skyline | None,
    fidelity: Fidelity,
) -> tuple[MethodContents, ...]:
    """Detect with other methods and log it; return what the recording now holds of them."""
    if not methods:
        return ()
    from skyline_viz.viewer.contents import MethodContents
    from skyline_viz.viewer.method_recording import log_methods as log_them

    for method in methods:  # the first time includes loading compiled loops
        with suppress(Exception):  # it may refuse so small a photo, and is asked again below
            method.detect(found.photo[:_WARM, :_WARM].copy())
    others = [method.detect(found.photo) for method in methods]
    log_them(recording, found, others, truth, fidelity)
    return tuple(MethodContents.of(one) for one in others)


def train_sizes(
    dataset: Dataset, one: NamedItem, detector: Detector
) -> tuple[list[FilterBank], list[Failure]]:
    """Filter banks of all sizes, learned from a data set without the photo, and what failed.

    Raises:
        UsageError: The data set holds no other photo with a truth.
    """
    own = _digest(one.item)
    others = [
        item
        for item in with_truth(dataset)
        if item.where != one.item.where and not (own and _digest(item) == own)
    ]
    if not others:
        raise UsageError(f"{dataset.name} holds no photo with a truth but {one.name} itself.")
    return evaluation.train_sizes(others, detector.training, dataset=dataset.name)


def _digest(item: DatasetItem) -> bytes:
    """What tells the content of a photo; nothing where it cannot be read, as is told later."""
    try:
        return next(item.contents())
    except (OSError, PhotoError, StorageError):
        return b""


def begin_sweeps(
    recording: rr.RecordingStream, found: FilterDetection, sizes: Sequence[FilterBank]
) -> list[Sweep]:
    """Choose what to sweep; what is logged from now on is there on all of the timelines."""
    from skyline_viz.diagnosis.sweep import setting_sweeps, size_sweep

    sweeps = setting_sweeps(found)
    if sizes:
        sweeps.append(size_sweep(found, sizes))
    else:
        tell("The filter size is not swept: name a data set to train on with --sweep-training.")
    for timeline, at in openings_of(sweeps).items():
        recording.set_time(timeline, sequence=at)
    return sweeps


def openings_of(sweeps: Sequence[Sweep]) -> dict[str, int]:
    """Where the timeline of each sweep begins, by its name."""
    from skyline_viz.viewer.sweep_recording import opening_of

    return {sweep.timeline: opening_of(sweep) for sweep in sweeps}


def log_sweeps(
    recording: rr.RecordingStream,
    sweeps: list[Sweep],
    found: FilterDetection,
    truth: Skyline | None,
) -> None:
    """Detect with all values, and log it."""
    from skyline_viz.viewer.sweep_recording import log_sweeps as log_them

    with ProgressBar(sum(len(sweep.steps) for sweep in sweeps), "values") as bar:
        log_them(recording, sweeps, found, truth, bar.advance)
