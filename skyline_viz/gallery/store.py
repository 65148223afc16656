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

from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.named_item import NamedItem
from skyline_viz.diagnosis.causes import Cause
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.evaluation.seen import seen_in_training
from skyline_viz.gallery.better_worse import better_worse
from skyline_viz.gallery.documents import read_list, write_list
from skyline_viz.gallery.entry import Entry, read_entry
from skyline_viz.gallery.thumbnails import write_thumbnail
from skyline_viz.method import Method
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.resume import digest_of_files, digest_of_method
from skyline_viz.running.warming import warm_up
from skyline_viz.system.names import recording_id
from skyline_viz.viewer.comparison import log_comparison
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.diagnosis_recording import log_diagnosis
from skyline_viz.viewer.parting_words import place
from skyline_viz.viewer.recording import log_detection, new_recording

VERSION = 8
"""Of recordings and gallery.json; all of an earlier one are made anew."""

_SAVE_EVERY = 1.0  # seconds
_SAVING = 0.02  # the most of the time that goes into saving: of many photos it takes long


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
            entry = read_entry(self.folder / "gallery.json", one)
            entries[entry.name] = entry
        return entries

    def save_entries(self, entries: Sequence[Entry]) -> None:
        """Write what was done."""
        done = [asdict(entry) for entry in entries]
        found = better_worse(entries)
        more = {"comparison": asdict(found)} if found else {}
        write_list(self.folder / "gallery.json", "photos", done, VERSION, more)

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
        due = monotonic() + _SAVE_EVERY
        try:
            for outcome in run(partial(_work, self, looks), tasks, workers=workers):
                if isinstance(outcome, Entry):
                    entries[outcome.name] = outcome
                else:
                    entries.pop(outcome.name, None)
                begun = monotonic()
                if begun > due:
                    self.save_entries(list(entries.values()))
                    saved = monotonic()
                    due = saved + max(_SAVE_EVERY, (saved - begun) / _SAVING)
                yield outcome
        finally:
            self.save_entries(list(entries.values()))


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
        return replace(task.known, photo=item.where)
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
            parted = beside.parting
            apart = np.abs(other.skyline.rows - detection.skyline.rows).mean()
            against = {
                "compared": other.method,
                "other_a_err": beside.verdict.a_err,
                "difference": float(apart),
                "parts_at": place(parted.on_lines or parted.at) if parted.at else "",
                "turned_by": parted.turned_by,
            }
    write_thumbnail(gallery.thumbnail(task.name), photo, detection.skyline, truth)
    stages = Contents.of(detection, "lean").stages
    shown = detection.visibility
    about = {
        "method": detection.method,
        "seen": seen_in_training(looks.method, photo, task.name, detection),
        "causes": causes,
        "titles": titles,
        "confidence": detection.confidence,
        "shows": shown.case if shown else None,
        **against,
    }
    height, width = photo.shape[:2]
    return Entry(task.name, item.where, made_from, height, width, verdict, stages, **about)
