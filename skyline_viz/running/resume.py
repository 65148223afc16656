"""Photos that are finished outlive a run that is not: the next run goes on.

A command that writes into a folder keeps what each photo came to below ``OUT/unfinished`` as soon
as it is known, a small file a photo, whole or not at all. Its name is a digest of all that it was
made from: photo, truth, what detects, settings, and the code of this program. The next run of the
same command finds what fits, and does the rest; what is damaged is done again. When everything has
been written, the files go.

The digests of photos and methods are those by which a `gallery` knows what has changed.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Generic, TypeVar

from skyline_viz import __version__
from skyline_viz.datasets.dataset import DatasetItem
from skyline_viz.datasets.item import Item
from skyline_viz.files import write_text
from skyline_viz.method import Method
from skyline_viz.methods.registry import method_digest
from skyline_viz.running.batch import Failure, Named, run

FOLDER = "unfinished"
"""Name of the folder, in that of the outputs; in it is one for each command."""

_RECORD = re.compile(r"[0-9a-f]{64}(-\w+)?\.(json|npz)")

Task = TypeVar("Task", bound=Named)
Value = TypeVar("Value")


@dataclass(frozen=True)
class Codec(Generic[Value]):
    """How what a photo came to is turned into JSON, and back."""

    pack: Callable[[Value], dict[str, Any]]
    """Makes an object of strings, numbers, lists and objects."""

    unpack: Callable[[dict[str, Any]], Value]
    """Makes the value again, the very same."""


@dataclass
class Kept:
    """What a run has finished."""

    folder: Path | None = None
    """Where it is kept; None keeps nothing."""

    known: int = 0
    """Photos that an earlier run had finished."""

    asked: int = 0
    """Photos that have been asked for."""

    @classmethod
    def within(cls, out: Path | None, command: str) -> Kept:
        """What a command keeps in a folder of outputs, or nothing without one."""
        return cls(out / FOLDER / command if out else None)

    def run(
        self,
        function: Callable[[Task], Value],
        tasks: Sequence[Task],
        key: Callable[[Task], str],
        codec: Codec[Value],
        *,
        workers: int = 1,
        title: str = "photos",
    ) -> Iterator[Value | Failure]:
        """`batch.run`, without the tasks that an earlier run has finished.

        Args:
            function: What to do.
            tasks: What to do it with.
            key: Digest of all that the value of a task is made from.
            codec: How values are kept.
            workers: See `batch.run`.
            title: See `batch.run`.
        """
        if self.folder is None:
            yield from run(function, tasks, workers=workers, title=title)
            return
        going_on = _GoingOn(function, key, codec, self.folder)
        for outcome in run(going_on, tasks, workers=workers, title=title):
            self.asked += 1
            if isinstance(outcome, Failure):
                yield outcome
            else:
                self.known += outcome.known
                yield outcome.value

    def said(self, noun: str = "photo") -> str:
        """How much was done already, in a sentence; nothing where nothing was."""
        were = "was" if self.known == 1 else "were"
        return f"{self.known} of {self.asked} {noun}s {were} done already." if self.known else ""

    def find(self, key: str) -> dict[str, Any] | None:
        """What is kept under a key; None where nothing is, or it is damaged."""
        return None if self.folder is None else _read(self.folder / f"{key}.json")

    def keep(self, key: str, record: dict[str, Any]) -> None:
        """Keep something under a key, whole or not at all."""
        if self.folder is not None:
            _write(self.folder / f"{key}.json", record)

    def remove(self) -> None:
        """Forget it all: the run has written everything. What is not ours stays."""
        if self.folder is None:
            return
        with suppress(OSError):
            for file in self.folder.iterdir():
                if _RECORD.fullmatch(file.name):
                    file.unlink()
            self.folder.rmdir()
            self.folder.parent.rmdir()  # unless another command has kept something


@dataclass(frozen=True)
class _Done(Generic[Value]):
    value: Value
    known: bool


@dataclass(frozen=True)
class _GoingOn(Generic[Task, Value]):
    """A function that looks up what is finished, and keeps what it finishes."""

    function: Callable[[Task], Value]
    key: Callable[[Task], str]
    codec: Codec[Value]
    folder: Path

    def __call__(self, task: Task) -> _Done[Value]:
        try:
            file = self.folder / f"{self.key(task)}.json"
        except OSError:  # of a file that cannot be read, of which the function says more
            return _Done(self.function(task), known=False)
        if (record := _read(file)) is not None:
            try:
                return _Done(self.codec.unpack(record), known=True)
            except (LookupError, TypeError, ValueError):
                pass  # of another shape than ours, and so it is done again
        value = self.function(task)
        _write(file, self.codec.pack(value))
        return _Done(value, known=False)


def _read(file: Path) -> dict[str, Any] | None:
    try:
        check, _, text = file.read_text(encoding="utf-8").partition("\n")
        if check != hashlib.sha256(text.encode()).hexdigest():
            return None
        record = json.loads(text)
    except (OSError, ValueError, RecursionError):
        return None
    return record if isinstance(record, dict) else None


def _write(file: Path, record: dict[str, Any]) -> None:
    text = json.dumps(record)
    write_text(file, f"{hashlib.sha256(text.encode()).hexdigest()}\n{text}")


def digest_of(*parts: object) -> str:
    """Digest of values that say all about themselves when printed, and of the program's code."""
    digest = hashlib.sha256(_code().encode())
    for part in parts:
        digest.update(f"{part!r}\n".encode())
    return digest.hexdigest()


def digest_of_method(method: Method, start: str = "") -> str:
    """Digest of what finds skylines: its settings, and what it has learned."""
    return hashlib.sha256(f"{start} {method_digest(method)}".encode()).hexdigest()


def digest_of_files(start: str, item: DatasetItem) -> str:
    """Digest of the content of a photo and of its truth, and of how that is read.

    Args:
        start: What else a result depends on.
        item: The photo.

    Raises:
        OSError: A file cannot be read.
    """
    digest = hashlib.sha256(f"{start} {item.sky} {item.terrain}".encode())
    for one in item.contents():
        digest.update(one)
    return digest.hexdigest()


def digest_of_item(start: str, item: Item) -> str:
    """Digest of a photo's name, of how its truth is read, and of the content of both."""
    if not isinstance(item, DatasetItem):  # no files: what it gives
        truth = item.truth()
        parts = () if truth is None else (truth.rows.tobytes(), truth.visible.tobytes())
        return digest_of(start, item.name, item.photo().tobytes(), *parts)
    told = (item.name, item.label_map, item.sky, item.terrain)
    return digest_of_files(digest_of(start, told), item)


@cache
def _code() -> str:
    """Digest of the program: a checkout changes without a new version."""
    digest = hashlib.sha256(__version__.encode())
    for file in sorted(Path(__file__).parents[1].rglob("*.py")):
        digest.update(file.read_bytes())
    return digest.hexdigest()
