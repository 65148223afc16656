"""Labels as they are now, for whoever only reads them: nothing is written, wherever they lie.

A snapshot is a copy in memory. It can be had of labels on a full disk, in a folder that is
read-only, of an older version, and while a server is writing them.
"""

from __future__ import annotations

import shutil
import sqlite3
import tempfile
from contextlib import closing, suppress
from pathlib import Path

from annotate.store.database import (
    MIGRATIONS,
    NAME,
    StoreError,
    holds_something,
    journal_fault,
    migrate,
    prepare,
    require_database,
    sentences,
    version_of,
)

_TRIES = 3  # of reading a file that nobody seems to write


def snapshot(folder: Path, open_already: sqlite3.Connection | None = None) -> sqlite3.Connection:
    """A copy of the labels of a folder, in memory; empty where there are none.

    Args:
        folder: The folder.
        open_already: A connection to them, where this process has one: their file must not be
            opened once more then, or the locks on it would end with that.

    Raises:
        StoreError: They cannot be read.
    """
    path = folder / NAME
    copy = sqlite3.connect(":memory:", isolation_level=None, check_same_thread=False)
    try:
        version = 0
        if open_already is not None:
            with sentences(path):
                open_already.backup(copy)
            version = len(MIGRATIONS)
        elif holds_something(path):
            read_into(copy, path)
            version = version_of(copy, path)
        with sentences(path):
            prepare(copy)
            migrate(copy, version)
    except BaseException:
        copy.close()
        raise
    return copy


def read_into(copy: sqlite3.Connection, path: Path) -> None:
    """Copy a file of labels into an empty database, writing nothing beside the file.

    Where nobody is at work on it, it has no journal, and is all there is. Otherwise SQLite reads it
    together with its journal; and where it cannot, because the folder is read-only or its disk
    full, it reads copies of both.

    Raises:
        StoreError: It cannot be read.
    """
    require_database(path)
    for _ in range(_TRIES):
        before = _written(path)
        if _journals(path):
            break
        with sentences(path):
            _copy(copy, path, "immutable=1")
        if not _journals(path) and _written(path) == before:
            return None  # nobody has begun to write meanwhile
    if not _journals(path) or (
        path.with_name(f"{path.name}-shm").exists() and not journal_fault(path)
    ):  # SQLite would mend the index of a journal that is damaged, which tells what is missing
        with suppress(sqlite3.OperationalError):  # what a journal needs cannot be made here
            return _copy(copy, path, "mode=ro")
    try:
        with tempfile.TemporaryDirectory(prefix="skyline-labels-") as folder, sentences(path):
            for file in (path, *_journals(path)):
                shutil.copyfile(file, Path(folder) / file.name)
            _copy(copy, Path(folder) / path.name, "mode=rw")
    except StoreError:
        raise
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise StoreError(
            f"{path} cannot be read without a copy of it and its journal, and there is no room "
            f"for one in {tempfile.gettempdir()}: {reason}."
        ) from error


def _copy(copy: sqlite3.Connection, path: Path, how: str) -> None:
    address = f"{path.absolute().as_uri()}?{how}"
    with closing(sqlite3.connect(address, uri=True, timeout=10)) as labels:
        labels.backup(copy)


def _journals(path: Path) -> list[Path]:
    """Files beside a database that belong to it."""
    beside = [path.with_name(f"{path.name}{end}") for end in ("-wal", "-journal")]
    return [file for file in beside if file.exists() and file.stat().st_size]


def _written(path: Path) -> tuple[int, int]:
    status = path.stat()
    return status.st_size, status.st_mtime_ns
