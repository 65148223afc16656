"""The pixels of a photo: those of the photo that was labelled, or none."""

from __future__ import annotations

import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from annotate.store.database import StoreError
from annotate.store.identity import Photo, Stamp, file_digest, pixel_digest
from skyline_viz.arrays import U8
from skyline_viz.photo import PhotoError, read_photo, read_photo_with_notes
from skyline_viz.system.notes import note

if TYPE_CHECKING:
    from annotate.store.store import Store

_WRITING = 10_000_000_000  # nanoseconds after its last change in which a file may grow on
_CHANGED = 3  # place of the time of that change among a file's marks
_TRIES = 3  # of reading a file that is being written


class ReplacedError(PhotoError):
    """Where the photo was lies another one; the message is one sentence that says so."""


class BusyError(PhotoError):
    """The photo cannot be read at the moment; the message is one sentence that says why."""


class Opened:
    """A photo that is open for labelling, and what tells whether its file has been replaced."""

    def __init__(self, store: Store, photo: Photo) -> None:
        """Read it, and keep what its pixels are known by.

        Raises:
            ReplacedError: It is another photo now.
            PhotoError: It has vanished, or cannot be read.
        """
        self._store, self._photo = store, photo
        self.pixels, self._marks = _read(store, photo)
        """``(H, W, 3)`` uint8 RGB."""
        self.known = pixel_digest(self.pixels)
        """What they are known by."""
        self._keep()

    def confirm(self) -> None:
        """Make sure that what lies on the disk is still what is open; cheap while nobody writes it.

        Raises:
            ReplacedError: It is another photo now.
            BusyError: It is being written.
            PhotoError: It has vanished, or cannot be read any more.
        """
        path = self._store.folder / self._photo.name
        marks = marks_of(path)
        if marks == self._marks:
            return
        if marks is None:
            raise PhotoError(
                f"{self._photo.name} is not there any more, so nothing is kept for it."
            )
        try:
            same = pixel_digest(read_photo(path)) == self.known
        except PhotoError as error:
            if time.time_ns() - marks[_CHANGED] < _WRITING:
                raise BusyError(f"{self._photo.name} is being written, or damaged.") from error
            raise
        if not same or marks_of(path) != marks:
            raise ReplacedError(
                f"{self._photo.name} was replaced by another photo while it was open, so nothing "
                "more is kept for it; open the folder again to label what is there now."
            )
        self._marks = marks
        self._keep()

    def _keep(self) -> None:
        """Let the store know the pixels, and the bytes of a file whose metadata was edited."""
        path = self._store.folder / self._photo.name
        try:
            digest, stamp = file_digest(path), Stamp.of(path.stat())
        except OSError:
            return  # it has just vanished
        if marks_of(path) == self._marks:
            with suppress(StoreError):  # to be kept the next time; that it fails is said elsewhere
                self._store.keep_file(self._photo, digest, self.known, stamp)


def read_whole(store: Store, photo: Photo) -> U8:
    """Read a photo, and make sure that it is still the one that was labelled.

    Raises:
        ReplacedError: It is another photo now.
        PhotoError: It has vanished, or cannot be read.
    """
    return _read(store, photo)[0]


class Present:
    """Whether photos are still in their folder: a look at the file, while nobody has written it."""

    def __init__(self) -> None:
        """Nothing has been found yet."""
        self._here: dict[int, tuple[Stamp, bool]] = {}

    def found(self, stamps: Mapping[int, Stamp]) -> None:
        """Remember the files of photos that have just been found, by the photos' ids."""
        self._here = {photo: (stamp, True) for photo, stamp in stamps.items()}

    def holds(self, store: Store, photo: Photo) -> bool:
        """Whether a photo is there, and not another one under its name."""
        path = store.folder / photo.name
        try:
            stamp = Stamp.of(path.stat())
            before = self._here.get(photo.id)
            if before is None or before[0] != stamp:
                known = store.photo(photo.id)
                same = file_digest(path) == known.digest or (
                    known.pixels is not None and pixel_digest(read_photo(path)) == known.pixels
                )
                before = self._here[photo.id] = stamp, same
        except (OSError, PhotoError):
            return False
        return before[1]


Marks = tuple[int, ...]
"""What changes when a file is written or replaced."""


def _read(store: Store, photo: Photo) -> tuple[U8, Marks]:
    path = store.folder / photo.name
    known = store.photo(photo.id)  # its metadata may have been edited since the folder was read
    for _ in range(_TRIES):
        marks = marks_of(path)
        pixels, notes = read_photo_with_notes(path)
        digest = file_digest(path)
        if marks is not None and marks_of(path) == marks:
            break
    else:
        raise BusyError(f"{photo.name} is being written by another program.")
    for sentence in notes:
        note(sentence)
    height, width = pixels.shape[:2]
    same = (height, width) == (known.height, known.width)
    if not same and digest == known.digest:
        raise PhotoError(
            f"{photo.name} was labelled as a photo of {known.width}x{known.height} pixels, and "
            f"this version of the program reads it as one of {width}x{height}."
        )
    if not same:
        raise ReplacedError(
            f"{photo.name} is another photo now: it was {known.width}x{known.height} pixels, and "
            f"is {width}x{height}."
        )
    if digest != known.digest and pixel_digest(pixels) != known.pixels:
        raise ReplacedError(
            f"{photo.name} is another photo now; open the folder again to label what is there."
        )
    return pixels, marks


def marks_of(path: Path) -> Marks | None:
    """Marks of a file; None where there is none.

    Raises:
        PhotoError: It cannot be looked at.
    """
    try:
        status = path.stat()
    except FileNotFoundError:
        return None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise PhotoError(f"{path} cannot be read: {reason}.") from error
    return (
        status.st_dev,
        status.st_ino,
        status.st_size,
        status.st_mtime_ns,
        status.st_ctime_ns,
    )
