"""What all formats share: safe names for files, and lines as runs of points."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from annotate.engine.hidden import Hidden
from annotate.store.contents import Contents
from annotate.store.labels import Label
from skyline_viz.arrays import runs
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.datasets.tree import photos_below
from skyline_viz.photo import PhotoError, photo_size
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.names import listed


@dataclass(frozen=True, eq=False)
class Entry:
    """A label that can be written."""

    label: Label
    skyline: Skyline
    """Its line."""

    photo: Path
    """The photo's file."""

    stem: str
    """A name for files that is safe, and unique in an export."""


@dataclass(frozen=True, eq=False)
class Imported:
    """A label that was read."""

    name: str
    """Name of the photo below the folder."""

    skyline: Skyline
    tags: tuple[str, ...] = ()
    label: Label | None = None
    """The whole label, where the format carries it."""

    hidden: tuple[Hidden, ...] = ()
    """What hides columns that are not visible, where the format carries it."""


Writer: TypeAlias = Callable[[list[Entry], Path], None]
"""Writes labels into a folder."""


def entries_of(
    labels: Iterable[Label], photos: Path, contents: Contents | None = None
) -> tuple[list[Entry], list[str]]:
    """Labels that can be written, each with its own photo, and a sentence for each that cannot."""
    entries, notes = [], []
    names = names_below(photos)
    stems = safe_stems(names)
    contents = contents or Contents(photos, names)
    for label in labels:
        photo = photos / label.name
        if label.name not in stems or not photo.is_file():
            shown = label.name if label.name.isprintable() else repr(label.name)
            notes.append(f"{shown} is not in the folder.")
        elif label.skyline is None:
            notes.append(f"{label.name} has no line.")
        elif _size(photo) != (label.height, label.width) or not contents.are(label.name, label):
            notes.append(f"{label.name} is another photo now.")
        else:
            entries.append(Entry(label, label.skyline, photo, stems[label.name]))
    return entries, notes


def orphans_of(labels: Iterable[Label], photos: Path) -> tuple[list[Entry], list[str]]:
    """Labels whose photos are gone, and a sentence for each that has no line.

    Where a name is not clear any more, the digest of the photo is part of the stem.
    """
    labels = list(labels)
    taken = Counter(label.name for label in labels) + Counter(names_below(photos))
    stems = safe_stems(taken)
    entries, notes = [], []
    for label in labels:
        stem = stems[label.name]
        if taken[label.name] > 1:
            stem = f"{stem}.sha256-{label.digest[:12]}"
        if label.skyline is None:
            notes.append(f"{label.name} has no line.")
        else:
            entries.append(Entry(label, label.skyline, photos / label.name, stem))
    return entries, notes


def one_each(entries: list[Entry]) -> tuple[list[Entry], list[str]]:
    """The first label of each photo, and a sentence for each other one."""
    first: dict[tuple[str, str], Entry] = {}
    notes = []
    for entry in entries:
        kept = first.setdefault((entry.label.name, entry.label.digest), entry).label
        if kept is not entry.label:
            left = entry.label
            notes.append(
                f"{kept.name} has several labels, and only that of {kept.annotator}, pass "
                f"{kept.number}, is in it, not that of {left.annotator}, pass {left.number}."
            )
    return list(first.values()), notes


def with_a_line(entries: list[Entry], format: str) -> tuple[list[Entry], list[str]]:  # noqa: A002
    """Labels of which something is visible, and a sentence for the other ones."""
    without = [one.label.name for one in entries if not one.skyline.visible.any()]
    note = f"left out, because {format} cannot say that nothing is visible: {listed(without)}."
    return [one for one in entries if one.skyline.visible.any()], [note] if without else []


def safe_stems(names: Iterable[str]) -> dict[str, str]:
    """A file name without ending for each name: no folders, no surprises, no two alike.

    Where photos share a name but for its ending, the ending is part of it.

    >>> safe_stems(["a/b.jpg", "../x.png", "x.jpg", "y.jpg"])
    {'../x.png': 'x.png', 'a/b.jpg': 'a__b', 'x.jpg': 'x.jpg', 'y.jpg': 'y'}
    """
    names = sorted(known := set(names))
    shared = Counter(_plain(name, ending=False).casefold() for name in names)
    stems: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        plain = _plain(name, ending=False)
        plain = _plain(name, ending=True) if shared[plain.casefold()] > 1 else plain
        stem, number = plain, 1
        while stem.casefold() in taken or (stem != name and stem in known):
            number += 1
            stem = f"{plain}-{number}"
        taken.add(stem.casefold())
        stems[name] = stem
    return stems


def check_size(name: str, skyline: Skyline, photos: Path, height: int | None = None) -> Skyline:
    """Return a line that fits its photo.

    Args:
        name: The photo.
        skyline: The line.
        photos: The folder of the photos.
        height: Rows of the photo that the line was made for, where that is known.

    Raises:
        FormatError: The sizes differ, or a row lies outside the photo.
    """
    rows, width = size_of(name, photos)
    if skyline.width != width:
        raise FormatError(f"{name} has {width} columns, its label {skyline.width}.")
    if height is not None and height != rows:
        raise FormatError(f"{name} has {rows} rows, its label is for {height}.")
    try:
        whole = skyline.pixel_rows(rows)
    except SkylineError as error:
        raise FormatError(f"{name}: {error}.") from error
    return Skyline(rows=whole.astype(np.float32), visible=skyline.visible)


def size_of(name: str, photos: Path) -> tuple[int, int]:
    """Height and width of a photo.

    Raises:
        FormatError: It cannot be read.
    """
    try:
        return photo_size(photos / name)
    except PhotoError as error:
        raise FormatError(str(error)) from error


def runs_of_points(skyline: Skyline) -> list[npt.NDArray[np.float64]]:
    """Points (x, y) of each run of visible columns, ``(m, 2)``: pixel centres across, rows down."""
    points = np.column_stack([np.arange(skyline.width) + 0.5, skyline.rows.astype(np.float64)])
    return [points[first : last + 1] for first, last in runs(skyline.visible)]


def names_below(photos: Path) -> list[str]:
    """Names of the photos of a folder and of the folders in it."""
    return [path.relative_to(photos).as_posix() for path in photos_below(photos)]


def _plain(name: str, *, ending: bool) -> str:
    """A name with nothing in it that a file system or a shell could take for something else."""
    path = PurePosixPath(name)
    whole = path if ending else path.with_suffix("")
    parts = [part for part in whole.parts if part not in ("..", "/")]
    plain = re.sub(r"[^\w.\- ()+]", "_", "__".join(parts)).lstrip(". ")
    return plain.encode("utf-8", "replace")[:120].decode("utf-8", "ignore") or "photo"


def _size(photo: Path) -> tuple[int, int] | None:
    try:
        return photo_size(photo)
    except PhotoError:
        return None
