"""The photos of a folder, and what is the same for everybody who labels them at the same time.

Nothing here is anybody's own: no line, no status, no blindness. So people share the work of reading
and detecting, and learn nothing of each other.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any

from annotate.store.opened import Opened, marks_of
from annotate.store.store import Photo, Store
from annotate.work.doubts import columns_of
from annotate.work.once import Once
from annotate.work.open_photos import BUDGET, Room
from annotate.work.pictures import KeptPictures
from skyline_viz.arrays import U8
from skyline_viz.detection import Detection
from skyline_viz.method import Method
from skyline_viz.methods.registry import method_digest

_AT_ONCE = 2  # photos that are read or detected at a time, however many are asked for


class SharedPhotos:
    """Photos of a folder. Methods may be called by any thread."""

    def __init__(
        self, store: Store, doubts: dict[str, int] | None = None, budget: int = BUDGET
    ) -> None:
        """Find the photos.

        Args:
            store: The labels.
            doubts: Only photos of these names are labelled; they open at these columns.
            budget: Bytes that photos which are open may take together.
        """
        self.store = store
        found = {photo.id: photo for photo in store.find()}
        self.doubts = columns_of(doubts or {}, found.values())
        """Column to look at in photos, by their id."""
        chosen = found if doubts is None else self.doubts
        self.by_id = {one: photo for one, photo in found.items() if one in chosen}
        """Photos to be labelled."""
        self.pictures = KeptPictures()
        """Pictures of them."""
        self.room: Room[Any] = Room(budget)
        """Room for what is open."""
        self.turns = threading.BoundedSemaphore(_AT_ONCE)
        """To be held while a photo is read or detected."""
        self._opened: Once[Opened] = Once()
        self._detections: Once[Detection] = Once()

    def opened(self, photo: Photo) -> Opened:
        """A photo, read from its file unless somebody has it open as it is there now.

        Raises:
            PhotoError: It has vanished, was replaced, or cannot be read.
        """
        marks = marks_of(self.store.folder / photo.name)
        return self._opened.get((photo.id, marks), lambda: Opened(self.store, photo))

    def sharing(self, method: Method, photo: Opened) -> Method:
        """A method that finds what somebody else has found on a photo just now, for this photo."""
        return _Sharing(method, (photo.known, method_digest(method)), self._detections)


@dataclass(frozen=True)
class _Sharing:
    method: Method
    key: tuple[str, str]
    found: Once[Detection]

    @property
    def name(self) -> str:
        return self.method.name

    def detect(self, photo: U8) -> Detection:
        return self.found.get(self.key, lambda: self.method.detect(photo))
