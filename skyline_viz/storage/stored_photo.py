"""A photo by its path or its address: its bytes are read once, for digest and pixels alike."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from skyline_viz.arrays import U8
from skyline_viz.photo import PhotoError, photo_from, reading
from skyline_viz.storage.addresses import is_address
from skyline_viz.storage.fetching import fetch
from skyline_viz.storage.parts import file_part, refuse_odd_chain
from skyline_viz.system.notes import note


@dataclass(frozen=True, slots=True)
class StoredPhoto:
    """A photo that travels as its address.

    Examples:
        >>> StoredPhoto("s3://photos/alps/eiger.jpg").name
        's3://photos/alps/eiger.jpg'
    """

    name: str
    """Its path or its address."""

    size: int | None = None
    """Its bytes, where a listing has told."""

    stamp: str = ""
    """What its storage says of its content; empty where it says nothing, and for files."""

    missing: str = ""
    """Why there is no photo, in a sentence; empty where there is one."""

    @property
    def stem(self) -> str:
        """What the photo is called, without its ending.

        >>> StoredPhoto("zip://alps/eiger.jpg::s3://photos/all.zip").stem
        'eiger'
        >>> StoredPhoto("https://host/a.b.png?raw=1").stem, StoredPhoto("s3://photos/q?x.png").stem
        ('a.b', 'q?x')
        """
        inner = self.name
        if is_address(self.name):
            inner = file_part(self.name)
        return Path(inner).stem

    @contextmanager
    def opened(self) -> Iterator[BinaryIO]:
        """Its bytes: a file that is open, or a download that is whole.

        Raises:
            PhotoError: It is a folder, empty, or missing.
            StorageError: It cannot be downloaded.
        """
        if self.missing:
            raise PhotoError(self.missing)
        if not is_address(self.name):
            with reading(Path(self.name)) as file:
                yield file
            return
        refuse_odd_chain(self.name)
        data = fetch(self.name, self.size)
        if not data:
            raise PhotoError(f"{self.name} is empty (0 bytes).")
        yield io.BytesIO(data)

    def read(self, known: str = "") -> tuple[str, U8 | None]:
        """The digest of its content, and its pixels; what there is to know about these is noted.

        Args:
            known: A digest of which the pixels are not needed.

        Returns:
            SHA-256 in hexadecimal digits; ``(H, W, 3)`` uint8 RGB, or None where it is `known`.

        Raises:
            PhotoError: It cannot be read.
            StorageError: It cannot be downloaded.
        """
        with self.opened() as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()  # type: ignore[arg-type]
            if digest == known:
                return digest, None
            file.seek(0)
            pixels, notes = photo_from(file, self.name)
        for one in notes:
            note(one)
        return digest, pixels
