"""Photos as people name them: files, folders, patterns in quotes, and lists of all these."""

from __future__ import annotations

import glob
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from skyline_viz.arrays import U8
from skyline_viz.command_line.local import local
from skyline_viz.command_line.messages import UsageError
from skyline_viz.datasets.dataset import DatasetError, DatasetItem
from skyline_viz.datasets.tables.parquet_files import is_label_table
from skyline_viz.storage.addresses import StorageError, is_address

_LIST = "@"
_MOST_BYTES = 100_000_000  # of a list


@dataclass(frozen=True)
class Missing(DatasetItem):
    """What was named and holds no photo: it fails when its turn comes, as a bad photo does."""

    reason: str = ""
    """Why, in a sentence."""

    def photo(self) -> U8:
        """Refuse.

        Raises:
            DatasetError: Always.
        """
        raise DatasetError(self.reason)


def named(paths: Sequence[str | Path]) -> Iterator[Path | str | Missing]:
    """What a command line names: patterns become what they match, and ``@FILE`` what it lists.

    An address becomes the folder of its copy, or the file of a photo; that of a table stays.

    Raises:
        UsageError: A list cannot be read, or is empty.
    """
    for word in spelt_out(os.fspath(one) for one in paths):
        if not is_address(word):
            yield from _matched(Path(word))
        else:
            yield word if is_label_table(word) else _copied(word)


def spelt_out(words: Iterable[str]) -> Iterator[str]:
    """The words of a command line, with what lists hold in their places.

    A list has a path, a pattern or an address a line, from the folder in which the command runs;
    paths with zero bytes between them, as ``find -print0`` prints, do as well. ``@-`` is what is
    piped in. A file that is there is taken by its name, whatever is in it.

    Raises:
        UsageError: A list cannot be read, or is empty.
    """
    for word in words:
        if word.startswith(_LIST) and not _exists(Path(word)):
            yield from _lines(word[1:])
        else:
            yield word


def _copied(address: str) -> Path | Missing:
    """What is at an address, on this machine."""
    try:
        return local(address)
    except StorageError as error:
        return Missing(address.rpartition("/")[2], Path(address), reason=str(error))


def _matched(path: Path) -> Iterator[Path | Missing]:
    """A path, or what a pattern matches, by name."""
    if _exists(path) or not glob.has_magic(os.fspath(path)):
        yield path
        return
    found = glob.glob(os.fspath(path), recursive=True)  # noqa: PTH207  # of absolute paths
    yield from sorted(_once(map(Path, found)))
    if not found:
        yield Missing(path.name, path, reason=f"{path} matches no file.")


def _once(paths: Iterable[Path]) -> Iterator[Path]:
    """Paths without those that a link to a folder leads to again, as one in a circle does."""
    seen: set[str] = set()
    real: dict[Path, str] = {}  # a folder of many photos is resolved once
    for path in sorted(paths, key=lambda one: (len(one.parts), one)):
        home = real.get(path.parent) or real.setdefault(path.parent, os.path.realpath(path.parent))
        if (place := f"{home}{os.sep}{path.name}") not in seen:
            seen.add(place)
            yield path


def _exists(path: Path) -> bool:
    try:
        return os.path.lexists(path)
    except ValueError:  # it holds what no path may
        return False


def _lines(name: str) -> list[str]:
    try:
        if name == "-":
            data = sys.stdin.buffer.read(_MOST_BYTES)
        else:
            with Path(name).open("rb") as file:
                data = file.read(_MOST_BYTES)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise UsageError(f"the list {name} cannot be read: {reason}.") from error
    text = os.fsdecode(data.removeprefix(b"\xef\xbb\xbf"))
    lines = text.split("\0") if "\0" in text else [one.rstrip("\r") for one in text.split("\n")]
    if not any(lines := [line for line in lines if line.strip()]):
        raise UsageError(f"the list {name} names no photo.")
    return lines
