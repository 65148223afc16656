"""The file in which labels are kept: an SQLite database that is refused when it is not sound.

Every commit is synchronous: when it returns, it is on the disk. Beside other programs on one
machine the database works with a write-ahead log; on network file systems, where that is unsafe,
with a plain journal.
"""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from skyline_viz.files import replacing

NAME = "skyline-labels.sqlite"
"""The file's name, in the folder of the photos."""

_APPLICATION = 0x534B594C  # "SKYL": says whose database it is
_NETWORK = ("nfs", "cifs", "smb", "sshfs", "9p", "afs", "ceph", "gluster", "lustre", "fuse.")

MIGRATIONS = (
    """
    CREATE TABLE photos (
        id INTEGER PRIMARY KEY,
        digest TEXT NOT NULL UNIQUE,     -- SHA-256 of the file
        name TEXT NOT NULL,              -- where it was seen last, below the folder
        width INTEGER NOT NULL,
        height INTEGER NOT NULL,
        size INTEGER NOT NULL,           -- bytes and time of change of the file, to
        changed INTEGER NOT NULL         -- hash it again only when one of them differs
    );
    CREATE TABLE detectors (
        id INTEGER PRIMARY KEY,
        digest TEXT NOT NULL UNIQUE,     -- of bank and settings
        about TEXT NOT NULL,
        config TEXT NOT NULL,
        bank BLOB NOT NULL
    );
    CREATE TABLE labels (
        id INTEGER PRIMARY KEY,
        photo INTEGER NOT NULL REFERENCES photos,
        annotator TEXT NOT NULL,
        number INTEGER NOT NULL,         -- 1 for the first pass over the photo
        blind INTEGER NOT NULL DEFAULT 0,
        detector INTEGER REFERENCES detectors,
        proposal BLOB,                   -- the line that was proposed, or imported
        margin REAL,                     -- how sure the detector was of it
        UNIQUE (photo, annotator, number)
    );
    CREATE TABLE operations (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        label INTEGER NOT NULL REFERENCES labels,
        at REAL NOT NULL,
        kind TEXT NOT NULL,
        body TEXT NOT NULL,
        line BLOB                        -- the line after it, where it changed the line
    );
    CREATE INDEX operations_of ON operations (label, kind);
    CREATE TRIGGER operations_stay BEFORE UPDATE ON operations
        BEGIN SELECT RAISE(ABORT, 'operations are never changed'); END;
    CREATE TRIGGER operations_remain BEFORE DELETE ON operations
        BEGIN SELECT RAISE(ABORT, 'operations are never deleted'); END;
    """,
    """
    ALTER TABLE operations ADD COLUMN request TEXT;  -- the id that the page gave it
    CREATE UNIQUE INDEX operations_asked ON operations (request) WHERE request IS NOT NULL;
    DROP INDEX operations_of;
    CREATE INDEX operations_of ON operations (label);
    CREATE TABLE standings (             -- where each label stands: follows from its log
        label INTEGER PRIMARY KEY REFERENCES labels,
        last INTEGER NOT NULL,           -- its last operation
        revision INTEGER NOT NULL,       -- its last operation that is more than a look
        status TEXT NOT NULL,
        tags TEXT NOT NULL,              -- JSON
        seconds REAL NOT NULL
    );
    CREATE TABLE checkpoints (           -- all that follows from a log up to some operation
        label INTEGER PRIMARY KEY REFERENCES labels,
        state BLOB NOT NULL
    );
    CREATE TRIGGER operations_move AFTER INSERT ON operations  -- however one gets in
        BEGIN DELETE FROM standings WHERE label = new.label; END;
    """,
    """
    CREATE TABLE folder (id TEXT NOT NULL);  -- tells these labels from those of other folders
    INSERT INTO folder VALUES (lower(hex(randomblob(16))));
    """,
)
"""What leads from each version of the schema to the next; the number of them is the version."""


class StoreError(OSError):
    """Labels cannot be read or kept; the message is one sentence that says why."""


def connect(folder: Path) -> sqlite3.Connection:
    """Open the labels of a folder; make the file where there is none.

    A file that is refused is not touched.

    Raises:
        StoreError: Damaged, of a newer version, somebody else's, or not writable.
    """
    path = folder / NAME
    if path.exists() and path.stat().st_size > 0:
        version = _examine(path)
    else:
        version = 0
        if not os.access(folder, os.W_OK):
            raise StoreError(f"{folder} is read-only, and labels are kept in it.")
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise StoreError(f"{path} is read-only, and labels are kept in it.")
    with sentences(path):
        connection = sqlite3.connect(
            path, isolation_level=None, check_same_thread=False, timeout=10
        )
        try:
            connection.execute("PRAGMA foreign_keys = ON")
            mode = "DELETE" if on_network(folder) else "WAL"
            connection.execute(f"PRAGMA journal_mode = {mode}")
            connection.execute("PRAGMA synchronous = FULL")
            _migrate(connection, version)
        except BaseException:
            connection.close()
            raise
    return connection


def backup(folder: Path, path: Path) -> None:
    """Copy the labels of a folder into a file, also while they are being changed.

    Raises:
        StoreError: There are none, or the copy cannot be written.
    """
    source = folder / NAME
    if not source.is_file():
        raise StoreError(f"{folder} has no labels to back up.")
    _examine(source)
    with (
        sentences(source),
        replacing(path) as temporary,
        closing(sqlite3.connect(f"{source.absolute().as_uri()}?mode=ro", uri=True)) as labels,
        closing(sqlite3.connect(temporary)) as copy,
    ):
        labels.backup(copy)
        copy.execute("PRAGMA journal_mode = DELETE")  # one file, not three


@contextmanager
def sentences(path: Path) -> Iterator[None]:
    """Turn what SQLite says into a sentence that names the file."""
    try:
        yield
    except sqlite3.OperationalError as error:
        said = str(error)
        if "full" in said:
            raise StoreError(f"the disk is full, so nothing was added to {path}.") from error
        if "readonly" in said or "read-only" in said or "unable to open" in said:
            raise StoreError(f"{path} cannot be written: {said}.") from error
        if "locked" in said:
            raise StoreError(f"{path} is being written by another program; try again.") from error
        raise StoreError(f"{path}: {said}.") from error
    except sqlite3.IntegrityError:
        raise  # a fault of this program, not of the file
    except sqlite3.DatabaseError as error:
        raise StoreError(f"{path} is damaged: {error}; restore it from a backup.") from error


def on_network(folder: Path) -> bool:
    """Whether a folder lies on a file system of another machine, as far as can be told."""
    try:
        mounts = Path("/proc/mounts").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False  # not Linux
    best, kind = "", ""
    place = f"{folder.resolve()}/"
    for line in mounts.splitlines():
        _, point, found, *_ = [*line.split(" "), "", ""]
        point = point.replace("\\040", " ")
        if place.startswith(f"{point.rstrip('/')}/") and len(point) >= len(best):
            best, kind = point, found
    return kind.startswith(_NETWORK)


def _examine(path: Path) -> int:
    """Version of the schema of a file, read without changing it."""
    with (
        sentences(path),
        closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as labels,
    ):
        version = int(labels.execute("PRAGMA user_version").fetchone()[0])
        whose = int(labels.execute("PRAGMA application_id").fetchone()[0])
        if whose != _APPLICATION:
            raise StoreError(f"{path} is a database, but not one of skyline-annotate.")
        if version > len(MIGRATIONS):
            raise StoreError(
                f"{path} is of version {version}, and this program knows versions up to "
                f"{len(MIGRATIONS)}; install a newer one."
            )
        found = labels.execute("PRAGMA quick_check(1)").fetchone()[0]
        if found != "ok":
            raise StoreError(f"{path} is damaged: {found}; restore it from a backup.")
    return version


def _migrate(connection: sqlite3.Connection, version: int) -> None:
    for number, script in enumerate(MIGRATIONS[version:], version + 1):
        ends = f"PRAGMA application_id = {_APPLICATION}; PRAGMA user_version = {number};"
        connection.executescript(f"BEGIN IMMEDIATE; {script} {ends} COMMIT;")
