"""Examples on the disk, of which one is read when it is drawn: memory does not grow with them.

The file is plainly written and read, not mapped: a full disk is then an error that can be told, and
what the system keeps of it in memory is not counted to the program.
"""

from __future__ import annotations

from io import BytesIO
from tempfile import TemporaryFile
from typing import IO, Protocol

import numpy as np

from skyline_viz.arrays import F32, U8
from skyline_viz.sky_training.examples import COLUMNS, ROWS, Example
from skyline_viz.storage.copies import caches, check_room

_PIXELS = ROWS * COLUMNS
_PHOTO, _SKY, _LINE = 3 * _PIXELS, _PIXELS, np.dtype(np.float32).itemsize * COLUMNS

RECORD = _PHOTO + _SKY + _LINE
"""Bytes of an example: photo, sky, and its line, NaN for none."""

IN_MEMORY = 100_000_000
"""Bytes of examples that need no disk."""


class Examples(Protocol):
    """Examples to draw from: a list, or an `ExampleFile`."""

    def __len__(self) -> int:
        """How many there are."""

    def __getitem__(self, place: int, /) -> Example:
        """One of them."""


class ExampleFile:
    """Examples in a file without a name, which is gone with the program, however that ends.

    The file is in the folder of caches, and a few examples need none. To be closed.

    Examples:
        >>> from contextlib import closing
        >>> black = np.zeros((ROWS, COLUMNS, 3), np.uint8)
        >>> with closing(ExampleFile(1)) as examples:
        ...     examples.append(Example(black, black[..., 0], "hills"))
        ...     len(examples), examples[0].source
        (1, 'hills')

    Attributes:
        sources: Data set that each example is from.
        seen: Fingerprint of each photo, as in `Example`.
    """

    def __init__(self, most: int) -> None:
        """Make an empty file.

        Args:
            most: Examples that there will be at the most.

        Raises:
            StorageError: The disk would not hold them.
            OSError: The folder of caches cannot be written into.
        """
        self.sources: list[str] = []
        self.seen: list[str] = []
        self._file: IO[bytes] = BytesIO()
        if most * RECORD > IN_MEMORY:
            check_room(most * RECORD, f"a sky model of {most:,} photos")
            self._file = TemporaryFile(dir=caches(), prefix="skyline-viz-")  # noqa: SIM115

    def __len__(self) -> int:
        return len(self.sources)

    def append(self, one: Example) -> None:
        """Write an example behind the others.

        Raises:
            OSError: The disk is full.
        """
        line = np.full(COLUMNS, np.nan, np.float32) if one.line is None else one.line
        self._file.seek(len(self) * RECORD)
        try:
            for part in (one.photo, one.sky, line):
                self._file.write(part.tobytes())
        except OSError as error:  # which says that the disk is full, and not which one
            error.filename = str(caches())
            raise
        self.sources.append(one.source)
        self.seen.append(one.seen)

    def __getitem__(self, place: int, /) -> Example:
        self._file.seek(range(len(self))[place] * RECORD)
        data = self._file.read(RECORD)
        photo: U8 = np.frombuffer(data, np.uint8, _PHOTO)
        sky: U8 = np.frombuffer(data, np.uint8, _SKY, _PHOTO)
        line: F32 = np.frombuffer(data, np.float32, COLUMNS, _PHOTO + _SKY)
        return Example.with_line(
            None if np.isnan(line[0]) else line,
            photo.reshape(ROWS, COLUMNS, 3),
            sky.reshape(ROWS, COLUMNS),
            self.sources[place],
            self.seen[place],
        )

    def close(self) -> None:
        """Remove the file."""
        self._file.close()
