"""A photo of a storage as one of a data set: it is downloaded when it is asked for."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar

from skyline_viz.arrays import U8
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.photo import photo_from
from skyline_viz.storage.stored_photo import StoredPhoto
from skyline_viz.system.notes import note


@dataclass(frozen=True)
class StoredItem(DatasetItem):
    """A photo at an address, or at a path. Where it is an address, `photo_path` names no file."""

    stored: StoredPhoto = field(default_factory=lambda: StoredPhoto(""))
    """The photo."""

    _latest: ClassVar[tuple[StoredItem, bytes] | None] = None
    """The item that was asked for last, and its file: its digest and its pixels are asked for in
    turn, and it is downloaded once. The very item, for the next one may find something else."""

    @property
    def where(self) -> str:
        """Path or address of the photo."""
        return self.stored.name

    def size(self) -> tuple[int, int] | None:
        """Nothing: it would have to be downloaded."""
        return None

    def contents(self) -> Iterator[bytes]:
        """What tells the content of the photo: what its storage says of it, or its SHA-256.

        Raises:
            PhotoError: It is empty or missing.
            StorageError: It cannot be downloaded.
        """
        yield self.stored.stamp.encode() or hashlib.sha256(self.file()).digest()

    def file(self) -> bytes:
        """The bytes of the photo's file.

        Raises:
            PhotoError: It is empty or missing.
            StorageError: It cannot be downloaded.
        """
        latest = StoredItem._latest  # once, as another thread may put in its own
        if latest and latest[0] is self:
            return latest[1]
        with self.stored.opened() as file:
            data = file.read()
        StoredItem._latest = self, data
        return data

    def photo(self) -> U8:
        """Download and decode the photo, ``(H, W, 3)`` uint8 RGB; what to know of it is noted.

        Raises:
            PhotoError: It cannot be read.
            StorageError: It cannot be downloaded.
        """
        pixels, notes = photo_from(io.BytesIO(self.file()), self.where)
        for one in notes:
            note(one)
        return pixels
