"""Detecting many photos into one table: what is done is not done again, a run that died goes on.

A photo is known by its name, the digest of its content, and a digest of what detects. Where its
storage says that its content is as it was, it is not even downloaded. Photos that failed are tried
again by the next run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from skyline_viz.method import Method
from skyline_viz.running.batch import Failure
from skyline_viz.running.line_store import LineStore, line_store, store_of
from skyline_viz.running.line_table import (
    failed_row,
    found_row,
    photos_in,
    read_about,
    read_rows,
    stamped_row,
    write_lines,
)
from skyline_viz.running.resume import digest_of, digest_of_method
from skyline_viz.storage.addresses import UnseenError
from skyline_viz.storage.stored_photo import StoredPhoto
from skyline_viz.system.memory import photo_limit
from skyline_viz.system.names import printable


@dataclass(frozen=True, slots=True)
class LineTask:
    """A photo to detect, unless it is as it was."""

    photo: StoredPhoto
    """The photo."""

    known: str = ""
    """Digest of the content that is done."""

    may_stay: bool = False
    """Whether that may still be its content, for all that its storage tells."""

    @property
    def name(self) -> str:
        """That of the photo."""
        return self.photo.name


@dataclass(frozen=True, slots=True)
class FoundLine:
    """What a photo came to."""

    photo: StoredPhoto
    """The photo."""

    sha256: str
    """Digest of its content."""

    row: bytes | None
    """Its row of the table; None where the content is the one that was done."""

    unseen: str = ""
    """Why its content could not be seen, in a sentence; its row stays then."""


Run = Callable[[Callable[[LineTask], FoundLine], Sequence[LineTask]], Iterator[FoundLine | Failure]]
"""How a function is run over tasks: `batch.run` with its workers, or a cluster's."""


@dataclass(frozen=True)
class Summary:
    """What a run came to."""

    photos: int
    """Photos that were asked for, each once."""

    known: int
    """Photos that were done already."""

    failures: list[Failure]
    """Photos that failed."""

    unseen: list[Failure]
    """Photos that were done, and could not be looked at again."""

    gone: int = 0
    """Rows of the table that was there which are of other photos, and are no longer in it."""


def nameable(photos: Sequence[StoredPhoto]) -> list[StoredPhoto]:
    r"""Photos that a table can name: one whose name is no text is missing, by an escaped name.

    Examples:
        >>> nameable([StoredPhoto("b\udcff.jpg")])[0].missing
        'b\\xff.jpg has a name that is no text, and a table holds text; rename it.'
    """
    taken = {one.name for one in photos}
    named = []
    for one in photos:
        name = one.name
        if not _is_text(name):
            name = printable(name)
            while name in taken:
                name += "'"
            taken.add(name)
            reason = f"{name} has a name that is no text, and a table holds text; rename it."
            one = StoredPhoto(name, missing=reason)  # noqa: PLW2901 - in place of it
        named.append(one)
    return named


def _is_text(name: str) -> bool:
    try:
        name.encode()
    except UnicodeEncodeError:
        return False
    return True


def digest_of_lines(method: Method) -> str:
    """Digest of all that a row is made from, but for its photo."""
    return digest_of("lines", digest_of_method(method), photo_limit())


def detect_into(
    table: Path,
    photos: Sequence[StoredPhoto],
    method: Method,
    run: Run,
    about: Mapping[str, object],
) -> Summary:
    """Detect photos and write their table, which holds each of them once, in their order.

    Args:
        table: Where to; what it holds already of the same photos and method is taken over.
        photos: The photos, see `nameable`.
        method: What detects.
        run: How to work.
        about: What to say about the table, see `write_lines`.

    Raises:
        TableError: The file that is there is no table of skylines.
        StoreError: Another run writes the table.
        OSError: The disk is full or read-only.
    """
    photos = [*{one.name: one for one in photos}.values()]
    digest = digest_of_lines(method)
    failures: dict[str, Failure] = {}
    unseen: list[Failure] = []
    with line_store(table, digest) as store:
        gone = 0
        if table.exists():
            if read_about(table).get("digest") == digest:
                _take_over(store, table)
            names = {one.name for one in photos}
            gone = sum(one not in names for one in photos_in(table))
        tasks = [*_to_do(store, photos)]
        known = len(photos) - len(tasks)
        for outcome in run(partial(find_line, method), tasks):
            if isinstance(outcome, Failure):
                failures[outcome.name] = outcome
                continue
            photo = outcome.photo
            if outcome.unseen:
                unseen.append(Failure(photo.name, outcome.unseen))
                known += 1
                continue
            row = outcome.row
            if row is None:
                known += 1
                row = stamped_row(store.row(photo.name) or b"", photo.stamp)
            store.keep(photo.name, photo.stamp, outcome.sha256, row)
        rows = _rows(store, photos, failures)
        write_lines(table, rows, {**about, "digest": digest})
    store_of(table).unlink(missing_ok=True)
    return Summary(len(photos), known, [*failures.values()], unseen, gone)


def find_line(method: Method, task: LineTask) -> FoundLine:
    """Detect a photo, unless its content is known.

    Raises:
        PhotoError: It cannot be read.
        StorageError: It cannot be downloaded.
    """
    from skyline_viz.running.warming import warm_up  # noqa: PLC0415 - loads what detects

    photo = task.photo
    try:
        sha256, pixels = photo.read(task.known)
    except UnseenError as error:
        if not task.may_stay:
            raise
        reason = f"{str(error).rstrip('.')}; its row of an earlier run stays."
        return FoundLine(photo, task.known, None, reason)
    if pixels is None:
        return FoundLine(photo, sha256, None)
    warm_up()
    row = found_row(photo.name, photo.stamp, sha256, method.detect(pixels))
    return FoundLine(photo, sha256, row)


def _take_over(store: LineStore, table: Path) -> None:
    """Put what a table holds into the store, but for photos that failed or are in it already."""
    for known, row in read_rows(table):
        photo, sha256 = known["photo"], known["sha256"]
        if known["error"] is None and sha256 and store.known(photo) is None:
            store.keep(photo, known["stamp"] or "", sha256, row)


def _to_do(store: LineStore, photos: Sequence[StoredPhoto]) -> Iterator[LineTask]:
    for photo in photos:
        known = store.known(photo.name)
        if known is None:
            yield LineTask(photo)
        elif not photo.stamp or photo.stamp != known.stamp:
            told = bool(photo.stamp and known.stamp)  # that it is another one
            yield LineTask(photo, known.sha256, may_stay=not told)


def _rows(
    store: LineStore, photos: Sequence[StoredPhoto], failures: Mapping[str, Failure]
) -> Iterator[bytes]:
    for photo in photos:
        failure = failures.get(photo.name)
        row = None if failure else store.row(photo.name)
        if row is None:
            row = failed_row(photo.name, failure.reason if failure else "it was not reached")
        yield row
