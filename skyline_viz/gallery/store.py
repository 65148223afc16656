"""A data set as a gallery: one small recording a photo, what it came to, and what people said.

A gallery is a folder::

    recordings/NAME.rrd   stages of each photo, lean; odd names are spelt in plain letters
    thumbnails/NAME.jpg   each photo with its lines, small
    gallery.json          what each detection came to, why, and what it was made from
    flags.json            which photos are reviewed, and comments, see `flags`

Every file is whole at any time. A photo is detected again only when it, its truth, the filter bank
or the configuration has changed since, so a run that was interrupted goes on where it stopped.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np

from skyline_viz.datasets.layouts import DatasetItem
from skyline_viz.datasets.named_item import NamedItem
from skyline_viz.diagnosis.causes import Cause
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.frames.visibility import Case
from skyline_viz.gallery.documents import GalleryError, made, read_list, write_list
from skyline_viz.gallery.thumbnails import write_thumbnail
from skyline_viz.method import Method
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.resume import digest_of_files, digest_of_method
from skyline_viz.running.warming import warm_up
from skyline_viz.stage import Quantity
from skyline_viz.system.names import recording_id
from skyline_viz.viewer.comparison import log_comparison
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.diagnosis_recording import log_diagnosis
from skyline_viz.viewer.recording import log_detection, new_recording
from skyline_viz.viewer.report import listed_segments

VERSION = 6
"""Of recordings and gallery.json; all of an earlier one are made anew."""

_SAVE_EVERY = 1.0  # seconds


@dataclass(frozen=True)
class Entry:
    """A photo of a gallery, and what its detection came to."""

    name: str
    """Unique in the gallery; also the name of its recording."""

    photo: str
    """The photo's file."""

    made_from: str
    """Digest of photo, truth, filter bank and configuration."""

    height: int
    """Rows of the photo."""

    width: int
    """Its columns."""

    verdict: Verdict
    """What the detection came to."""

    stages: tuple[Quantity, ...] = ()
    """The stages that its recording holds."""

    causes: tuple[Cause, ...] | None = None
    """Why it went wrong, see `diagnosis.Diagnosis.causes`; nothing where it is right, None without
    a truth."""

    titles: tuple[str, ...] = ()
    """The causes with the terms and the places that they name, see `diagnosing.Segment.title`, each
    once, that of the main segment first."""

    confidence: float | None = None
    """How surely it has a skyline, see `visibility.Visibility`; None of methods that cannot
    tell."""

    shows: Case | None = None
    """Whether it has one, and whether it is visible everywhere; None like the confidence."""

    method: str = "default"
    """Name of the method."""

    compared: str = ""
    """Name of the method beside the first; nothing without one."""

    other_a_err: float | None = None
    """Mean error of its line in pixels."""

    difference: float | None = None
    """Mean distance between both lines, in pixels."""

    @property
    def cause(self) -> Cause | None:
        """The main cause."""
        return self.causes[0] if self.causes else None

    @property
    def wrong(self) -> str:
        """The segments that went wrong, in words."""
        return listed_segments(self.verdict.segments or (), most=2)


@dataclass(frozen=True)
class Gallery:
    """The files of a gallery."""

    folder: Path
    """Its folder; made when first written to."""

    def recording(self, name: str) -> Path:
        """File of a photo's recording."""
        return self.folder / "recordings" / f"{recording_id(name)}.rrd"

    def thumbnail(self, name: str) -> Path:
        """File of a small picture of a photo with its lines."""
        return self.folder / "thumbnails" / f"{recording_id(name)}.jpg"

    def entries(self) -> dict[str, Entry]:
        """Photos that were done, by name; none of those that an earlier version did.

        Raises:
            GalleryError: The file is damaged.
        """
        entries = {}
        for one in read_list(self.folder / "gallery.json", "photos", VERSION):
            entry = _entry(self.folder / "gallery.json", one)
            entries[entry.name] = entry
        return entries

    def save_entries(self, entries: Sequence[Entry]) -> None:
        """Write what was done."""
        done = [asdict(entry) for entry in entries]
        write_list(self.folder / "gallery.json", "photos", done, VERSION)

    def build(
        self,
        photos: Sequence[NamedItem],
        method: Method,
        beside: Method | None = None,
        workers: int = 0,
    ) -> Iterator[Entry | Failure]:
        """Detect and record what is not there yet; yield each photo's entry, or why it failed.

        Args:
            photos: The photos.
            method: What detects.
            beside: A second method, to compare with.
            workers: Number of processes, see `batch.run`.

        Raises:
            GalleryError: The gallery's file is damaged.
        """
        known = self.entries()
        digests = [digest_of_method(one, str(VERSION)) for one in (method, beside) if one]
        looks = _Looks(method, beside, "".join(digests))
        tasks = [_Task(one.name, one.item, known.get(one.name)) for one in photos]
        entries = {one.name: known[one.name] for one in photos if one.name in known}
        saved = monotonic()
        try:
            for outcome in run(partial(_work, self, looks), tasks, workers=workers):
                if isinstance(outcome, Entry):
                    entries[outcome.name] = outcome
                else:
                    entries.pop(outcome.name, None)
                if monotonic() - saved > _SAVE_EVERY:
                    self.save_entries(list(entries.values()))
                    saved = monotonic()
                yield outcome
        finally:
            self.save_entries(list(entries.values()))


def by_need(entries: Sequence[Entry]) -> list[Entry]:
    """Entries in the order in which to look at them.

    Where two methods are compared, those on which they differ most first. Else those with a truth
    first, the largest error before; then those without, the least sure before.
    """
    return sorted(
        entries,
        key=lambda one: (
            -(one.difference or 0.0),
            one.verdict.a_err is None,
            -(one.verdict.a_err or 0.0),
            one.verdict.margin,
            one.name,
        ),
    )


@dataclass(frozen=True)
class _Task:
    name: str
    item: DatasetItem
    known: Entry | None


@dataclass(frozen=True)
class _Looks:
    method: Method
    beside: Method | None
    digest: str


def _work(gallery: Gallery, looks: _Looks, task: _Task) -> Entry:
    item = task.item
    made_from = digest_of_files(looks.digest, item)
    file = gallery.recording(task.name)
    there = file.exists() and gallery.thumbnail(task.name).exists()
    if task.known and task.known.made_from == made_from and there:
        return replace(task.known, photo=str(item.photo_path))
    photo, truth = item.photo(), item.truth()
    warm_up()
    detection = looks.method.detect(photo)
    other = looks.beside.detect(photo) if looks.beside else None
    with new_recording(file, task.name) as recording:
        verdict = log_detection(recording, detection, truth, name=task.name, fidelity="lean")
        causes: tuple[Cause, ...] | None = None
        titles: tuple[str, ...] = ()
        if truth is not None and verdict.a_err is not None:  # it is visible somewhere
            diagnosis = diagnose(detection, truth)
            log_diagnosis(recording, diagnosis, detection, truth, task.name)
            causes, titles = diagnosis.causes, diagnosis.titles
        against: dict[str, Any] = {}
        if other is not None:
            beside = log_comparison(recording, detection, other, truth, other.method, "lean")
            apart = np.abs(other.skyline.rows - detection.skyline.rows).mean()
            against = {
                "compared": other.method,
                "other_a_err": beside.a_err,
                "difference": float(apart),
            }
    write_thumbnail(gallery.thumbnail(task.name), photo, detection.skyline, truth)
    photo_file = str(item.photo_path)
    stages = Contents.of(detection, "lean").stages
    shown = detection.visibility
    about = {
        "method": detection.method,
        "causes": causes,
        "titles": titles,
        "confidence": detection.confidence,
        "shows": shown.case if shown else None,
        **against,
    }
    height, width = photo.shape[:2]
    return Entry(task.name, photo_file, made_from, height, width, verdict, stages, **about)


def _entry(path: Path, values: dict[str, Any]) -> Entry:
    """An entry as `asdict` took it apart, put together again."""
    try:
        told = dict(values["verdict"])
        if told["segments"] is not None:
            told["segments"] = tuple((int(a), int(b)) for a, b in told["segments"])
        if values["causes"] is not None:
            values["causes"] = tuple(values["causes"])
        values["titles"] = tuple(values["titles"])
        stages = tuple(
            Quantity(**{**one, "span": tuple(one["span"]), "tabs": tuple(one["tabs"])})
            for one in values["stages"]
        )
        verdict = Verdict(**told)
    except (LookupError, TypeError, ValueError) as error:
        raise GalleryError(f"{path} is damaged: {error}.") from error
    entry: Entry = made(Entry, path, {**values, "verdict": verdict, "stages": stages})
    return entry
