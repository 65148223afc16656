"""What all formats share: safe names for files, and lines as runs of points."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from annotate.labels import Label
from skyline_viz.photo import PhotoError, photo_size
from skyline_viz.skyline import Skyline, SkylineError, fill


class FormatError(ValueError):
    """An export or import is not possible; the message is one sentence that says why."""


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


Writer: TypeAlias = Callable[[list[Entry], Path], None]
"""Writes labels into a folder."""

Reader: TypeAlias = Callable[[Path, Path, Mapping[str, str]], list[Imported]]
"""Reads a file or folder, given the folder of the photos and the photo of each safe name."""


def entries_of(labels: Iterable[Label], photos: Path) -> tuple[list[Entry], list[str]]:
    """Labels that can be written, and a sentence for each that cannot."""
    entries, notes = [], []
    labels = list(labels)
    stems = safe_stems(label.name for label in labels)
    for label in labels:
        photo = photos / label.name
        if label.skyline is None:
            notes.append(f"{label.name} has no line.")
        elif not photo.is_file():
            notes.append(f"{label.name} is not in the folder any more.")
        elif _size(photo) != (label.height, label.width):
            notes.append(f"{label.name} is another photo now.")
        else:
            entries.append(Entry(label, label.skyline, photo, stems[label.name]))
    return entries, notes


def safe_stems(names: Iterable[str]) -> dict[str, str]:
    """A file name without ending for each name: no folders, no surprises, no two alike.

    >>> safe_stems(["a/b.jpg", "../x.png", "x.jpg"])
    {'a/b.jpg': 'a__b', '../x.png': 'x', 'x.jpg': 'x-2'}
    """
    stems: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        if name in stems:
            continue
        parts = [
            part for part in PurePosixPath(name).with_suffix("").parts if part not in ("..", "/")
        ]
        plain = re.sub(r"[^\w.\- ()+]", "_", "__".join(parts)).lstrip(". ")
        plain = plain.encode("utf-8", "replace")[:120].decode("utf-8", "ignore") or "photo"
        stem, number = plain, 1
        while stem.casefold() in taken:
            number += 1
            stem = f"{plain}-{number}"
        taken.add(stem.casefold())
        stems[name] = stem
    return stems


def names_of(names: Iterable[str]) -> dict[str, str]:
    """The photo of each safe name, and of each name as it is."""
    names = list(names)
    found = {stem: name for name, stem in safe_stems(names).items()}
    for name in names:
        found.setdefault(PurePosixPath(name).name, name)
        found.setdefault(PurePosixPath(name).stem, name)
    return {**found, **{name: name for name in names}}


def check_width(name: str, skyline: Skyline, photos: Path) -> Skyline:
    """Return a line that fits its photo.

    Raises:
        FormatError: The widths differ, or a row lies outside the photo.
    """
    try:
        height, width = photo_size(photos / name)
    except PhotoError as error:
        raise FormatError(str(error)) from error
    if skyline.width != width:
        raise FormatError(f"{name} has {width} columns, its label {skyline.width}.")
    try:
        rows = skyline.pixel_rows(height)
    except SkylineError as error:
        raise FormatError(f"{name}: {error}.") from error
    inside = rows.clip(0, height - 1)
    return Skyline(rows=inside.astype(np.float32), visible=skyline.visible)


def runs_of_points(skyline: Skyline) -> list[npt.NDArray[np.float64]]:
    """Points (x, y) of each run of visible columns, ``(m, 2)``: pixel centres across, rows down."""
    seen = np.concatenate([[False], skyline.visible, [False]])
    starts, stops = np.flatnonzero(seen[1:] != seen[:-1]).reshape(-1, 2).T
    points = np.column_stack([np.arange(skyline.width) + 0.5, skyline.rows.astype(np.float64)])
    return [points[start:stop] for start, stop in zip(starts, stops, strict=True)]


def from_points(runs: Iterable[npt.NDArray[np.float64]], width: int) -> Skyline:
    """Line through runs of points; between two points it is straight, outside it is not visible.

    Raises:
        FormatError: There is no point, or one that is not finite.
    """
    rows = np.zeros(width)
    visible: npt.NDArray[np.bool_] = np.zeros(width, np.bool_)
    centres = np.arange(width) + 0.5
    for run in runs:
        if not np.isfinite(run).all() or np.abs(run).max(initial=0) > 1e6:
            raise FormatError("a point is not finite, or far outside any photo.")
        run = run[np.argsort(run[:, 0], kind="stable")]  # noqa: PLW2901
        inside = (centres >= run[0, 0] - 0.5) & (centres <= run[-1, 0] + 0.5)
        rows[inside] = np.floor(np.interp(centres[inside], run[:, 0], run[:, 1]) + 0.5)
        visible |= inside
    if not visible.any():
        raise FormatError("no point of the line lies inside the photo.")
    return Skyline(rows=fill(rows, visible), visible=visible)


def _size(photo: Path) -> tuple[int, int] | None:
    try:
        return photo_size(photo)
    except PhotoError:
        return None
