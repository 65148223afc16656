"""What a photo is known by: the bytes of its file, and where those were changed, its pixels.

A file with known bytes is that photo, whatever it is called and wherever it lies. A file whose
bytes are new is looked into only where a photo with labels and as many pixels has gone from the
folder: if the pixels are the same, only the metadata was edited, and the labels stay.
"""

from __future__ import annotations

import hashlib
import os
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path, PurePosixPath

import numpy as np

from skyline_viz.arrays import U8
from skyline_viz.datasets.tree import photos_below
from skyline_viz.photo import PhotoError, photo_size, read_photo

_FEW = 50  # photos that are read without asking
_SETTLED = 2_000_000_000  # nanoseconds after which a change would show in the times of a file


@dataclass(frozen=True)
class Photo:
    """A photo of the folder."""

    id: int
    name: str
    """Its file below the folder, with ``/`` between folders."""

    digest: str
    """SHA-256 of its file, in hexadecimal."""

    width: int
    height: int
    pixels: str | None = None
    """`pixel_digest` of it; None where it has not been read yet."""


@dataclass(frozen=True)
class Stamp:
    """What tells without reading a file whether it has been written: its size and times."""

    size: int
    changed: int
    """When its content was changed, in nanoseconds; programs can set it."""

    touched: int
    """When its entry was changed, in nanoseconds; only the system sets it."""

    @classmethod
    def of(cls, status: os.stat_result) -> Stamp:
        """The stamp of a file."""
        return cls(status.st_size, status.st_mtime_ns, status.st_ctime_ns)

    @property
    def settled(self) -> bool:
        """Whether the file is old enough for any change from now on to show in its times."""
        return max(self.changed, self.touched) < time.time_ns() - _SETTLED


@dataclass(frozen=True)
class Known:
    """A photo as the store knows it."""

    photo: Photo
    size: int
    changed: int
    touched: int | None
    """As in its `Stamp`; None where an older version has kept it."""

    labelled: bool
    """Whether there is a label of it."""


@dataclass(frozen=True)
class Found:
    """A photo's file that is in the folder."""

    name: str
    digest: str
    width: int
    height: int
    stamp: Stamp
    pixels: str | None = None


@lru_cache(maxsize=100_000)
def _digest_as_of(path: Path, _: Stamp) -> str:
    return _digest(path)


def file_digest(path: Path) -> str:
    """SHA-256 of a file, in hexadecimal; read again only when its stamp has changed.

    Raises:
        OSError: It cannot be read.
    """
    stamp = Stamp.of(path.stat())
    return _digest_as_of(path, stamp) if stamp.settled else _digest(path)


def pixel_digest(photo: U8) -> str:
    """SHA-256 of upright RGB pixels and their shape, in hexadecimal.

    >>> pixel_digest(np.zeros((8, 9, 3), np.uint8)) == pixel_digest(np.zeros((9, 8, 3), np.uint8))
    False
    """
    height, width = photo.shape[:2]
    digest = hashlib.sha256(f"{width}x{height} RGB\n".encode())
    digest.update(np.ascontiguousarray(photo).data)
    return digest.hexdigest()


def short(digest: str) -> str:
    """A digest as sentences name it.

    >>> short("ab12cd34ef56" + 52 * "0")
    'sha256 ab12cd34ef56...'
    """
    return f"sha256 {digest[:12]}..."


def scan(folder: Path, known: Sequence[Known]) -> tuple[list[Found], list[str]]:
    """Photos that are in a folder, in the order of their files; no two with the same bytes.

    Args:
        folder: The folder.
        known: What the store knows.

    Returns:
        The photos, and a sentence for each file that had to be left out.
    """
    places = {(one.photo.name, one.size, one.changed): one for one in known}
    by_digest = {one.photo.digest: one for one in known}
    found: dict[str, Found] = {}
    problems = []
    for path in photos_below(folder):
        name = path.relative_to(folder).as_posix()
        try:
            name.encode()
            stamp = Stamp.of(path.stat())
            before = places.get((name, stamp.size, stamp.changed))
            same = before is not None and before.touched in (None, stamp.touched)
            digest = before.photo.digest if before and same else file_digest(path)
            seen = by_digest.get(digest)
            if seen and seen.labelled:
                width, height = seen.photo.width, seen.photo.height
            else:
                height, width = photo_size(path)
        except UnicodeEncodeError:
            problems.append(f"{name!a} has a name that is no text, and is left out.")
            continue
        except (OSError, PhotoError) as error:
            problems.append(f"{name} is left out: {error}")
            continue
        if digest in found:
            problems.append(f"{name} has the same content as {found[digest].name}.")
            continue
        pixels = seen.photo.pixels if seen else None
        found[digest] = Found(name, digest, width, height, stamp, pixels)
    return looked_into(folder, list(found.values()), known), problems


def looked_into(folder: Path, found: list[Found], known: Sequence[Known]) -> list[Found]:
    """The same photos, with the pixels of those that may be one whose file was changed.

    Nothing is read unless a photo with labels is not there any more. Photos that are known and
    have no label are read, too, where they are few, or have the name of one that is gone: each
    once, and a large folder is not read as a whole.
    """
    here = {one.digest for one in found}
    lost = [one.photo for one in known if one.labelled and one.photo.digest not in here]
    lost = [one for one in lost if one.pixels]
    labels = {one.photo.digest: one.labelled for one in known}
    new = [one for one in found if one.digest not in labels and _is_as_large(one, lost)]
    read = _read(folder, new)
    lost = [one for one in lost if one.pixels not in {one.pixels for one in read.values()}]
    copies = [one for one in found if not labels.get(one.digest, True) and _is_as_large(one, lost)]
    if len(copies) > _FEW:
        stems = {PurePosixPath(one.name).stem for one in lost}
        copies = [one for one in copies if PurePosixPath(one.name).stem in stems]
    read |= _read(folder, copies)
    return [read.get(one.digest, one) for one in found]


def _is_as_large(one: Found, photos: Sequence[Photo]) -> bool:
    """Whether one of some photos has as many columns and rows."""
    return (one.width, one.height) in {(photo.width, photo.height) for photo in photos}


def _read(folder: Path, found: Sequence[Found]) -> dict[str, Found]:
    """Photos with their pixels, by digest."""
    read = {}
    for one in found:
        try:
            pixels = one.pixels or pixel_digest(read_photo(folder / one.name))
        except PhotoError:
            continue  # said when it is opened
        read[one.digest] = replace(one, pixels=pixels)
    return read


def changed_files(found: Iterable[Found], known: Sequence[Known]) -> dict[int, Found]:
    """New files of photos with labels, by the photo's id: other bytes, the same pixels."""
    found = list(found)
    here, seen = {one.digest for one in found}, {one.photo.digest for one in known}
    new: dict[str, list[Found]] = {}
    for one in found:
        if one.pixels and one.digest not in seen:
            new.setdefault(one.pixels, []).append(one)
    files = {}
    for before in known:
        candidates = new.get(before.photo.pixels or "", [])
        if candidates and before.labelled and before.photo.digest not in here:
            same_name = [one for one in candidates if one.name == before.photo.name]
            files[before.photo.id] = (same_name or candidates)[0]
            candidates.remove(files[before.photo.id])
    return files


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
