"""A part of the photos for each of several machines that know nothing of each other.

A photo belongs to a shard by its name alone, so that shards fit together whoever lists them when.
Each writes a file of its own into one folder, which is a table as it is; `join` makes one file.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skyline_viz.running.line_table import SUFFIX, TableError, read_about, read_rows, write_lines

_WORDS = re.compile(r"([1-9]\d*)/([1-9]\d*)")
_FILE = re.compile(r"shard-(\d+)-of-(\d+)(\.\w+)")


@dataclass(frozen=True)
class Shard:
    """One of several parts, counted from 1.

    Examples:
        >>> one, two = Shard(1, 2), Shard(2, 2)
        >>> [one.holds(name) != two.holds(name) for name in ("a.jpg", "b.jpg", "c.jpg")]
        [True, True, True]
        >>> one.file
        'shard-00001-of-00002.parquet'
    """

    number: int
    """Which one, from 1."""

    of: int
    """How many there are."""

    @classmethod
    def parse(cls, text: str) -> Shard:
        """Read ``I/N``.

        Raises:
            ValueError: It is something else, or there is no such shard.
        """
        found = _WORDS.fullmatch(text)
        if not found or int(found[1]) > int(found[2]):
            raise ValueError(f"--shard is I/N, from 1/N to N/N, such as 3/8, not {text}.")
        return cls(int(found[1]), int(found[2]))

    def __str__(self) -> str:
        return f"{self.number}/{self.of}"

    @property
    def file(self) -> str:
        """Name of its file."""
        return self.file_of(SUFFIX)

    def file_of(self, suffix: str) -> str:
        """Name of its file, where that is no table."""
        return f"shard-{self.number:05}-of-{self.of:05}{suffix}"

    def holds(self, photo: str) -> bool:
        """Whether a photo belongs to it."""
        return zlib.crc32(photo.encode(errors="surrogateescape")) % self.of == self.number - 1


def shards_in(folder: Path, suffix: str = SUFFIX) -> list[tuple[Shard, Path]]:
    """The shards of a folder, by number, when all of them are there and made alike.

    Raises:
        TableError: One is missing, or two do not fit together.
        OSError: The folder cannot be listed.
    """
    found = [
        (Shard(int(name[1]), int(name[2])), path)
        for path in sorted(folder.iterdir())
        if (name := _FILE.fullmatch(path.name)) and name[3] == suffix
    ]
    if not found:
        raise TableError(f"{folder} holds no shards, shard-00001-of-0000N{suffix} and so on.")
    numbers = {shard.of for shard, _ in found}
    if len(numbers) > 1:
        told = " and ".join(map(str, sorted(numbers)))
        raise TableError(f"{folder} holds shards of {told}; remove those that are not wanted.")
    missing = {*range(1, found[0][0].of + 1)} - {shard.number for shard, _ in found}
    if missing:
        first = Shard(min(missing), found[0][0].of)
        more = f", and {len(missing) - 1} more" if len(missing) > 1 else ""
        raise TableError(f"{folder} lacks the shard {first}{more}.")
    return found


def check_own(path: Path, shard: Shard, told: object) -> None:
    """Make sure that a file holds the shard that its name says.

    Args:
        path: The file.
        shard: The shard of its name.
        told: What stands in it.

    Raises:
        TableError: It is another one, or nothing is told.
    """
    if told is None:
        raise TableError(f"{path} is a shard of another version, and has to be made again.")
    if told != str(shard):
        raise TableError(f"{path} holds the shard {told}, and by its name it is {shard}.")


def join(folder: Path, out: Path) -> int:
    """Write the shards of a folder as one table; return the number of photos.

    Raises:
        TableError: A shard is missing or damaged, is another one than its name says, was made
            otherwise than the first one, or holds a photo that is not its own, or holds it twice.
        OSError: A file cannot be read or written.
    """
    shards = shards_in(folder)
    abouts = [read_about(path) for _, path in shards]
    for (shard, path), told in zip(shards, abouts, strict=True):
        if "shard" in told:
            check_own(path, shard, told["shard"])
        if told.get("digest") != abouts[0].get("digest"):
            raise TableError(f"{path} was made by another method or version than {shards[0][1]}.")
    about: dict[str, Any] = {**abouts[0], "shards": len(shards)}
    about.pop("shard", None)
    return write_lines(out, _all_rows(shards), about)


def _all_rows(shards: list[tuple[Shard, Path]]) -> Iterator[bytes]:
    for shard, path in shards:
        seen: set[str] = set()
        for known, row in read_rows(path):
            photo = known["photo"]
            if photo in seen or not shard.holds(photo):
                raise TableError(f"{path} holds {photo}, which it should not, or twice.")
            seen.add(photo)
            yield row
