"""What a run has finished, in one file beside its table: each photo once, also after a kill.

It is an SQLite database: a photo is in it whole or not at all, is found by its name, and costs a
few microseconds. When the table has been written, the file goes.
"""

from __future__ import annotations

import errno
import os
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from skyline_viz.files import make_folder

SUFFIX = ".unfinished"
"""What is put to the name of the table."""

_MAKE = """
create table if not exists about (digest text not null);
create table if not exists photos (
    photo text primary key, stamp text not null, sha256 text not null, line blob not null
) without rowid;
"""


class StoreError(ValueError):
    """The file cannot be used; the message is one sentence that names it."""


class Known(NamedTuple):
    """What is known of a photo that is finished."""

    stamp: str
    """What its storage said of its content."""

    sha256: str
    """Digest of its content."""


class LineStore:
    """Rows of a table that is not written yet."""

    def __init__(self, database: sqlite3.Connection) -> None:
        self._database = database

    def known(self, photo: str) -> Known | None:
        """What is known of a photo; None where it is not finished."""
        asked = "select stamp, sha256 from photos where photo = ?"
        found = self._database.execute(asked, (photo,)).fetchone()
        return Known(*found) if found else None

    def row(self, photo: str) -> bytes | None:
        """The row of a photo; None where it is not finished."""
        asked = "select line from photos where photo = ?"
        found = self._database.execute(asked, (photo,)).fetchone()
        return bytes(found[0]) if found else None

    def keep(self, photo: str, stamp: str, sha256: str, row: bytes) -> None:
        """Keep the row of a photo, in place of an earlier one."""
        told = (photo, stamp, sha256, row)
        self._database.execute("insert or replace into photos values (?, ?, ?, ?)", told)

    def __len__(self) -> int:
        return int(self._database.execute("select count(*) from photos").fetchone()[0])


def store_of(table: Path) -> Path:
    """The file of the store of a table."""
    return table.with_name(table.name + SUFFIX)


@contextmanager
def line_store(table: Path, digest: str) -> Iterator[LineStore]:
    """Open the store of a table; what was made otherwise is forgotten.

    Args:
        table: The table.
        digest: Of all that a row is made from, but for its photo.

    Raises:
        StoreError: Another run writes the table, it cannot be written there, or the file is
            damaged.
        OSError: The disk is full.
    """
    file = store_of(table)
    make_folder(file.parent)
    try:
        database = sqlite3.connect(file, timeout=0, isolation_level=None)
        try:
            database.execute("pragma locking_mode = exclusive")  # needs no memory that is shared
            database.execute("pragma journal_mode = wal")
            database.execute("pragma synchronous = normal")
            database.executescript(_MAKE)
            made = database.execute("select digest from about").fetchone()
            if made != (digest,):
                for forget in ("delete from about", "delete from photos"):
                    database.execute(forget)
                database.execute("insert into about values (?)", (digest,))
            yield LineStore(database)
        finally:
            database.close()
    except sqlite3.OperationalError as error:
        if "locked" in str(error):
            raise StoreError(f"another run is writing {table}.") from error
        if "full" in str(error):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(file)) from error
        raise StoreError(f"{table} cannot be written: {_reason(file) or error}.") from error
    except sqlite3.DatabaseError as error:
        raise StoreError(f"{file} is damaged; remove it to begin anew.") from error


def _reason(file: Path) -> str:
    """Why a file cannot be written; empty where it can."""
    try:
        file.open("ab").close()
    except FileNotFoundError:
        return f"{file.parent} takes no file"
    except OSError as error:
        return (error.strerror or str(error)).lower()
    return ""
