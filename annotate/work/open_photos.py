"""Which photos stay open: as many as a number of bytes allows, and the one that is shown."""

from __future__ import annotations

import threading
from collections import OrderedDict
from concurrent.futures import Future
from typing import Generic, TypeVar

import numpy as np

from annotate.store.opened import BusyError
from annotate.store.store import Photo
from skyline_viz.detection import Detection
from skyline_viz.system.memory import available, in_words

BUDGET = 1_500_000_000
"""Bytes that open photos and what is kept of them may take; the shown one stays in any case."""

OPEN_AT_MOST = 3
"""Photos that are of use: the one that is shown, the one before, and the next."""

SESSION = 27
"""Bytes a pixel of an open photo: its pixels (3), nodal costs (4) and those without what the brush
forbids (4), and the two tables of the live wire (8 each)."""

KEPT = 17
"""Bytes a pixel that a detection which is kept with its open photo is counted as until it is there:
edges (1), costs (4), and what is known of its edge pixels, 32 each: on noise every third pixel is
one."""

BLIND = 3
"""Bytes a pixel of an open photo that is labelled blind: its pixels."""

OPENING = 32
"""Bytes a pixel at the worst moment of opening one: measured up to 32, on noise, where every third
pixel is an edge."""

_TABLES = 16  # bytes a pixel of the live wire's tables, where the detection is not let go for them

Value = TypeVar("Value")


def require_room(photo: Photo, *, keep: bool = False) -> None:
    """Refuse to open a photo that does not fit into what is left of the memory.

    Args:
        photo: The photo.
        keep: Whether its detection is kept.

    Raises:
        BusyError: It does not; the message says what it needs.
    """
    each = OPENING + (_TABLES if keep else 0)
    need, free = each * photo.height * photo.width, available()
    if free is not None and need > free:
        raise BusyError(
            f"{photo.name} has {photo.height * photo.width / 1e6:.0f} megapixels and needs about "
            f"{in_words(need)} of memory to open, and {in_words(free)} are free."
        )


def detection_bytes(detection: Detection) -> int:
    """Bytes that keeping a detection takes, besides its photo's pixels."""
    held = [*vars(detection).values(), *detection.maps.values()]
    held += [value for term in detection.cost_model.nodal for value in vars(term).values()]
    arrays = {id(one): one.nbytes for one in held if isinstance(one, np.ndarray)}
    return sum(arrays.values()) - detection.photo.nbytes


class Room(Generic[Value]):
    """Bytes that the open photos of all people may take together, whoever uses them."""

    def __init__(self, budget: int = BUDGET) -> None:
        """Begin with nobody.

        Args:
            budget: How many.
        """
        self.budget = budget
        self.people: list[OpenPhotos[Value]] = []
        """What each of them has open."""
        self.lock = threading.RLock()


class OpenPhotos(Generic[Value]):
    """What one person has open: photos by id, each with its bytes. Any thread may call methods."""

    def __init__(self, room: Room[Value] | None = None) -> None:
        """Begin with none.

        Args:
            room: Where other people have theirs; a room of one's own unless given.
        """
        self._room = room or Room()
        self._room.people.append(self)
        self._photos: OrderedDict[int, tuple[Future[Value], int]] = OrderedDict()
        self._shown: int | None = None
        self._beside = 0
        self._lock = self._room.lock

    @property
    def open(self) -> list[int]:
        """The open photos, the least recently used first."""
        with self._lock:
            return list(self._photos)

    @property
    def total(self) -> int:
        """Bytes that they take, with what is kept beside them, without those of other people."""
        with self._lock:
            return sum(size for _, size in self._photos.values()) + self._beside

    def get(self, photo: int) -> Future[Value] | None:
        """What an open photo is or will be; None where it is closed."""
        with self._lock:
            return self._photos[photo][0] if photo in self._photos else None

    def take(self, photo: int, size: int) -> tuple[Future[Value], bool]:
        """What a photo is or will be, and whether the caller has to open it.

        The least recently used ones are closed until it fits, one's own before those of others.
        That which is shown is never closed.
        """
        with self._lock:
            if photo in self._photos:
                self._photos.move_to_end(photo)
                return self._photos[photo][0], False
            future: Future[Value] = Future()
            self._photos[photo] = future, size
            self._make_room(photo)
            return future, True

    def lighten(self, photo: int, size: int) -> None:
        """An open photo takes less than was counted."""
        with self._lock:
            if photo in self._photos:
                future, counted = self._photos[photo]
                self._photos[photo] = future, min(size, counted)

    def show(self, photo: int) -> bool:
        """From now on this photo is the one that stays, and the one before may be closed.

        Returns:
            Whether it is another one than before.
        """
        with self._lock:
            another, self._shown = photo != self._shown, photo
            self._make_room(photo)
            return another

    def keeps(self, photo: Photo) -> bool:
        """Whether a photo keeps its detection while shown or next: everybody's have to fit."""
        both = 2 * (SESSION + KEPT) * photo.height * photo.width
        return both * len(self._room.people) <= self._room.budget

    def fits(self, size: int) -> bool:
        """Whether a photo of so many bytes fits beside those that are shown."""
        with self._lock:
            return sum(one._needed for one in self._room.people) + size <= self._room.budget

    def keep_beside(self, photo: int, size: int) -> bool:
        """Whether something of so many bytes may be kept of a photo; it counts from now on.

        It takes the place of what was kept before. Other photos are closed for it.
        """
        with self._lock:
            self._beside = 0
            own = self._photos[photo][1] if photo in self._photos else 0
            others = sum(one._needed for one in self._others)
            if others + own + size > self._room.budget:
                return False
            self._beside = size
            self._make_room(photo)
            return True

    def drop_beside(self) -> None:
        """Nothing is kept of a photo any more."""
        with self._lock:
            self._beside = 0

    def close(self, photo: int) -> None:
        """Forget a photo."""
        with self._lock:
            self._photos.pop(photo, None)

    def close_others(self, photo: int, *, shown: bool = False) -> None:
        """Forget all but one photo and those that are shown.

        Args:
            photo: The photo.
            shown: Whether what is shown to other people is forgotten as well.
        """
        with self._lock:
            for one in self._spare(photo, self._shown):
                del self._photos[one]
            for other in self._others:
                other._close_opened(None if shown else other._shown)

    @property
    def _others(self) -> list[OpenPhotos[Value]]:
        return [one for one in self._room.people if one is not self]

    @property
    def _needed(self) -> int:
        """Bytes of what is shown, and of what is kept beside it."""
        shown = self._photos.get(self._shown) if self._shown is not None else None
        return (shown[1] if shown else 0) + self._beside

    @property
    def _fit(self) -> bool:
        return sum(one.total for one in self._room.people) <= self._room.budget

    def _spare(self, *used: int | None) -> list[int]:
        """All photos but those in use, the least recently used first."""
        return [one for one in self._photos if one not in used]

    def _make_room(self, newest: int) -> None:
        spare = self._spare(newest, self._shown)
        while spare and (len(self._photos) > OPEN_AT_MOST or not self._fit):
            del self._photos[spare.pop(0)]
        for other in self._others:
            other._close_opened(other._shown, until_it_fits=True)

    def _close_opened(self, used: int | None, *, until_it_fits: bool = False) -> None:
        """Forget all but one photo, and those that are just being opened."""
        for one in self._spare(used):
            if until_it_fits and self._fit:
                return
            if self._photos[one][0].done():
                del self._photos[one]
