"""The pictures of a workbench's photos: each is made once, when it is first asked for, and kept.

Nothing here holds the lock of an open photo while a picture is made, and pictures take turns among
themselves only: what changes a line never waits for one.
"""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Callable, Hashable

from annotate.store.identity import file_digest
from annotate.store.opened import read_whole
from annotate.store.store import Photo
from annotate.work import images
from annotate.work.overlays import overlay, overlays
from annotate.work.pictures import Picture
from annotate.work.workbench import Workbench
from skyline_viz.arrays import U8
from skyline_viz.photo import PhotoError
from skyline_viz.skyline import Skyline
from skyline_viz.system.memory import photo_limit

_AT_ONCE = 2  # pictures that are made at a time, however many are asked for


class NoPictureError(LookupError):
    """There is no such tile or stage; the message is one sentence that says so."""


class Pictures:
    """Pictures of photos. Its methods may be called from several threads.

    Those of an open photo are known by the pixels that are open, those of a closed one by the photo
    and the content of its file: where that has changed, it is read again, and refused if it is
    another photo.
    """

    def __init__(self, bench: Workbench) -> None:
        """Begin with those that were made for others who label the same photos.

        Args:
            bench: The photos.
        """
        self._bench = bench
        self._kept = bench.shared.pictures
        self._turns = threading.BoundedSemaphore(_AT_ONCE)

    def whole(self, photo: int) -> Picture:
        """The whole photo, exact where it is small enough."""
        session = self._bench.session(photo)
        return self._get((session.content, "whole"), lambda: images.view(session.pixels))

    def tile(self, photo: int, across: int, down: int) -> Picture:
        """Exact pixels of a part of the photo.

        Raises:
            NoPictureError: There is no such tile.
        """
        session = self._bench.session(photo)
        if not images.has_tile(session.pixels, across, down):
            raise NoPictureError("there is no such tile.")
        key = (session.content, "tile", across, down)
        return self._get(key, lambda: images.tile(session.pixels, across, down))

    def stage(self, photo: int, name: str) -> Picture:
        """A stage or a term of the cost, by the detector that made the photo's proposal.

        Raises:
            NoPictureError: There is no such stage.
        """
        session = self._bench.session(photo)

        def make() -> Picture:
            detection = self._bench.detection(session)
            if name not in (known := overlays(detection)):
                raise NoPictureError(f"there is no such stage; there are {', '.join(known)}.")
            return overlay(detection, name)

        return self._get((session.content, "stage", name, session.proposer), make)

    def thumbnail(self, photo: int) -> Picture:
        """A small picture of a photo, open or not."""
        one = self._bench.photo(photo)

        def make() -> Picture:
            return self._of_file(one) or images.thumbnail(read_whole(self._bench.store, one))

        return self._get((self._file(one), photo, "thumbnail"), make)

    def strip(self, photo: int, width: int) -> Picture:
        """The band around a photo's line, straightened.

        Raises:
            PathError: There is no line yet.
        """
        return self._with_line(
            photo, ("strip", width), lambda pixels, line: images.strip(pixels, line, width)
        )

    def overview(self, photo: int) -> Picture:
        """A small picture of a photo with its line on it.

        Raises:
            PathError: There is no line yet.
        """
        return self._with_line(photo, ("overview",), images.overview)

    def _with_line(
        self, photo: int, what: tuple[Hashable, ...], draw: Callable[[U8, Skyline], Picture]
    ) -> Picture:
        """A picture of a photo and its line: of one that is closed without opening it."""
        bench = self._bench
        line = bench.store.line(bench.label(photo))
        content: Hashable
        pixels: Callable[[], U8]
        if line is None or bench.is_open(photo):
            session = bench.session(photo)
            with session.lock:
                skyline = session.wire.skyline
            content, pixels = session.content, lambda: session.pixels
        else:
            one = bench.photo(photo)
            content, skyline = self._file(one), line.skyline  # another photo may be in its place
            pixels = lambda: read_whole(bench.store, one)  # noqa: E731
        key = (content, photo, *what, skyline.rows.tobytes(), skyline.visible.tobytes())
        return self._get(key, lambda: draw(pixels(), skyline))

    def _get(self, key: Hashable, make: Callable[[], Picture]) -> Picture:
        def in_turn() -> Picture:
            with self._turns:
                return make()

        return self._kept.get(key, in_turn)

    def _file(self, photo: Photo) -> str:
        """SHA-256 of the file of a photo as it is now.

        Raises:
            PhotoError: It has vanished, or cannot be read.
        """
        try:
            return file_digest(self._bench.store.folder / photo.name)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise PhotoError(f"{photo.name} cannot be read: {reason}.") from error

    def _of_file(self, photo: Photo) -> Picture | None:
        """The thumbnail of a JPEG whose bytes are those that were labelled, without reading it all.

        None for all others: they are read in the ordinary way, which knows what is wrong.
        """
        if photo.height * photo.width > photo_limit() * 1e6:
            return None
        try:
            data = (self._bench.store.folder / photo.name).read_bytes()
        except OSError:
            return None
        if hashlib.sha256(data).hexdigest() != self._bench.store.photo(photo.id).digest:
            return None
        return images.thumbnail_of_file(data, photo.height, photo.width)
