"""Pictures that were made are kept: up to a number of bytes, and each is made once.

A picture is known by all that it depends on, the photo's content included. So what is kept is never
out of date, and nothing has to be thrown away when something changes.
"""

from __future__ import annotations

import hashlib
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from functools import cached_property

from annotate.work.once import Once

BUDGET = 200_000_000
"""Bytes of the pictures that are kept: all stages of a dozen photos, and a thousand thumbnails."""


@dataclass(frozen=True)
class Picture:
    """A picture as it is sent."""

    data: bytes
    """The content of its file."""

    kind: str
    """Its media type."""

    @cached_property
    def tag(self) -> str:
        """What tells it from every other one: the first half of its SHA-256, in hexadecimal."""
        return hashlib.sha256(self.data).hexdigest()[:32]


class KeptPictures:
    """Pictures by what they show; the least recently used ones go first. For any thread."""

    def __init__(self, budget: int = BUDGET) -> None:
        """Begin with none.

        Args:
            budget: Bytes that all of them may take together.
        """
        self._budget, self._total = budget, 0
        self._pictures: OrderedDict[Hashable, Picture] = OrderedDict()
        self._once: Once[Picture] = Once()
        self._lock = threading.Lock()

    @property
    def total(self) -> int:
        """Bytes that the kept ones take."""
        return self._total

    def get(self, key: Hashable, make: Callable[[], Picture]) -> Picture:
        """A picture, which is made unless it is kept or just being made.

        Args:
            key: All that it depends on.
            make: Makes it. What it raises is raised, also to those who wait, and nothing is kept.
        """
        with self._lock:
            kept = self._pictures.get(key)
            if kept is not None:
                self._pictures.move_to_end(key)
                return kept
        picture = self._once.get(key, make)
        with self._lock:
            if key not in self._pictures:  # else somebody who asked at the same time has kept it
                self._keep(key, picture)
        return picture

    def _keep(self, key: Hashable, picture: Picture) -> None:
        self._pictures[key] = picture
        self._total += len(picture.data)
        while self._total > self._budget:
            self._total -= len(self._pictures.popitem(last=False)[1].data)
