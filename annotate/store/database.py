"""The file in which labels are kept: an SQLite database that is refused when it is not sound.

Every commit is synchronous: when it returns, it is on the disk. Beside other programs on one
machine the database works with a write-ahead log; on network file systems, where that is unsafe,
with a plain journal.
"""

from __future__ import annotations

import os
import re
import sqlite3
import stat
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from annotate.store import journal
from skyline_viz.files import flush, replacing
from skyline_viz.system.names import shortened

NAME = "skyline-labels.sqlite"
"""The file's name, in the folder of the photos."""

APPLICATION = 0x534B594C
"""``SKYL``: says whose database it is."""

_LONGEST = 200  # characters of what a file says that are shown
_BEGINS = b"SQLite format 3\0"
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
    ALTER TABLE photos ADD COLUMN pixels TEXT;      -- SHA-256 of its upright pixels, once read
    ALTER TABLE photos ADD COLUMN touched INTEGER;  -- change of the file's entry, as `changed`
    CREATE TABLE set_aside (
        label INTEGER PRIMARY KEY REFERENCES labels,
        annotator TEXT NOT NULL,         -- whose label it was
        number INTEGER NOT NULL,         -- and of which pass; the label itself has -id
        reason TEXT NOT NULL
    );
    """,
    """
    CREATE TABLE folder (id TEXT NOT NULL);  -- tells these labels from those of other folders
    INSERT INTO folder VALUES (lower(hex(randomblob(16))));
    """,
    """
    ALTER TABLE labels RENAME COLUMN margin TO confidence;  -- of the proposal, in [0, 1]
    UPDATE labels SET confidence = NULL;                    -- until a photo is proposed for again
    """,
    """
    ALTER TABLE standings ADD COLUMN comment TEXT;       -- what was said with the status, if any
    ALTER TABLE standings ADD COLUMN commented_by TEXT;  -- and who said it
    """,
)
"""What leads from each version of the schema to the next; the number of them is the version."""


class StoreError(OSError):
    """Labels cannot be read or kept; the message is one sentence that says why."""


class DamagedError(StoreError):
    """A file of labels is not as SQLite wrote it; the message is one sentence that says so."""


def connect(folder: Path) -> sqlite3.Connection:
    """Open the labels of a folder; make the file where there is none.

    A file that is refused is not touched.

    Raises:
        StoreError: Damaged, of a newer version, somebody else's, or not writable.
    """
    path = folder / NAME
    exists = holds_something(path)
    if not exists and not os.access(folder, os.W_OK):
        raise StoreError(f"{folder} is read-only, and labels are kept in it.")
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise StoreError(f"{path} is read-only, and labels are kept in it.")
    version = examine(path) if exists else 0
    with sentences(path):
        connection = sqlite3.connect(
            path, isolation_level=None, check_same_thread=False, timeout=10
        )
        try:
            prepare(connection)
            mode = "DELETE" if on_network(folder) else "WAL"
            connection.execute(f"PRAGMA journal_mode = {mode}")
            connection.execute("PRAGMA synchronous = FULL")
            migrate(connection, version)
            if version < len(MIGRATIONS):  # so that the file can be told without its journal
                connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            flush(folder)  # SQLite waits for the content of a new file, but not for its name
        except BaseException:
            connection.close()
            raise
    return connection


def prepare(connection: sqlite3.Connection) -> None:
    """Set what every connection to labels needs."""
    connection.execute("PRAGMA foreign_keys = ON")
    # damaged text is a fault of the label that it belongs to, and must not hide the others
    connection.text_factory = lambda data: data.decode("utf-8", "surrogateescape")


class Place:
    """Where a file that is open lies: writing into one that was moved away would keep nothing."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._files = [path, path.with_name(f"{path.name}-wal")]
        self._known: dict[Path, tuple[int, int]] = {}
        self._by_number = not on_network(path.parent)  # elsewhere a file's number may change

    def confirm(self) -> None:
        """Make sure that the file, and its journal once there is one, are where they were.

        Raises:
            StoreError: They were moved, removed, or replaced.
        """
        for file in self._files:
            try:
                found = file.stat()
            except OSError:
                found = None
            before = self._known.get(file)
            if found is None and (before or file == self._path):
                raise StoreError(self._moved())
            if found is None:
                continue
            number = (found.st_dev, found.st_ino)
            if before and self._by_number and before != number:
                raise StoreError(self._moved())
            self._known[file] = number

    def _moved(self) -> str:
        return (
            f"{self._path} was moved, removed or replaced while it was open, so nothing is kept "
            "in it any more; put it back where it was, and open the folder again."
        )


def backup(folder: Path, path: Path) -> str:
    """Copy the labels of a folder into a file, also while they are being changed.

    Returns:
        What is missing because the journal is damaged, in a sentence; empty where nothing is.

    Raises:
        StoreError: There are none, they are damaged, or the copy cannot be written.
    """
    from annotate.store.snapshot import read_into  # noqa: PLC0415  # which needs this module

    source = folder / NAME
    if not holds_something(source):
        raise StoreError(f"{folder} has no labels to back up.")
    said = journal_fault(source)
    with closing(sqlite3.connect(":memory:")) as labels:
        read_into(labels, source)
        version_of(labels, source)
        with replacing(path) as temporary, sentences(path):
            write_into(temporary, labels)
    return said


def write_into(path: Path, labels: sqlite3.Connection) -> None:
    """Write labels into a single file."""
    data = bytearray(labels.serialize())
    data[18:20] = b"\1\1"  # with a plain journal: one file, not three
    path.write_bytes(data)


@contextmanager
def sentences(path: Path) -> Iterator[None]:
    """Turn what SQLite says into a sentence that names the file."""
    try:
        yield
    except sqlite3.OperationalError as error:
        said = str(error)
        if "full" in said:
            raise StoreError(f"the disk is full, so nothing was added to {path}.") from error
        if "readonly" in said or "read-only" in said:
            raise StoreError(f"{path} cannot be written: {said}.") from error
        if "locked" in said:
            raise StoreError(f"{path} is being written by another program; try again.") from error
        raise StoreError(f"{path}: {said}.") from error
    except sqlite3.IntegrityError:
        raise  # a fault of this program, not of the file
    except sqlite3.DatabaseError as error:
        raise DamagedError(damaged(path, _where(str(error)))) from error
    except UnicodeError as error:
        raise DamagedError(damaged(path, "text")) from error


def damaged(path: Path, where: str = "") -> str:
    """The sentence about a file that is damaged, and what can be done."""
    place = f" ({where})" if where else ""
    return (
        f"{path} is damaged{place}; skyline-annotate repair {path.parent} saves what can be read, "
        "or restore it from a backup."
    )


def journal_fault(path: Path) -> str:
    """What is not read of labels because their journal is damaged, in a sentence; or empty.

    Raises:
        StoreError: The journal cannot be read.
    """
    try:
        said = journal.fault(path)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise StoreError(f"the journal of {path} cannot be read: {reason}.") from error
    if not said:
        return ""
    return (
        f"the journal {path}-wal {said}; skyline-annotate repair {path.parent} saves what can be "
        "read."
    )


def _where(said: str) -> str:
    """Where a file is damaged, from what SQLite says of it."""
    page = re.search(r"\bpage (\d+)", said, re.IGNORECASE)
    return f"page {page[1]}" if page else "a table" if "row" in said or "index" in said else ""


def holds_something(path: Path) -> bool:
    """Whether labels have been kept in a file.

    Raises:
        StoreError: It is no file, or cannot be looked at.
    """
    try:
        status = path.stat()
    except FileNotFoundError:
        return False
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise StoreError(f"{path} cannot be read: {reason}.") from error
    if not stat.S_ISREG(status.st_mode):
        raise StoreError(f"{path} is a folder or a device, and labels are kept in a file.")
    return status.st_size > 0


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


def examine(path: Path) -> int:
    """Version of the schema of a file, read without changing it.

    Raises:
        StoreError: It or its journal is damaged, of a newer version, or somebody else's.
    """
    require_database(path)
    if said := journal_fault(path):
        raise DamagedError(said)
    address = f"{path.absolute().as_uri()}?mode=ro"
    with sentences(path), closing(sqlite3.connect(address, uri=True, timeout=10)) as labels:
        return version_of(labels, path)


def require_database(path: Path) -> None:
    """Make sure that a file begins as a database does.

    Raises:
        StoreError: It does not, or cannot be read.
    """
    try:
        with path.open("rb") as file:
            begins = file.read(len(_BEGINS))
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise StoreError(f"{path} cannot be read: {reason}.") from error
    if begins != _BEGINS:
        raise DamagedError(damaged(path, "its beginning"))


def version_of(labels: sqlite3.Connection, path: Path) -> int:
    """Version of the schema of labels that are open, when they are sound.

    Args:
        labels: The labels.
        path: Their file, to be named.

    Raises:
        StoreError: They are damaged, of a newer version, or somebody else's.
    """
    with sentences(path):
        prepare(labels)
        version = int(labels.execute("PRAGMA user_version").fetchone()[0])
        whose = int(labels.execute("PRAGMA application_id").fetchone()[0])
        if not (whose or version or labels.execute("SELECT 1 FROM sqlite_schema").fetchone()):
            raise StoreError(
                f"{path} is an empty database, or its journal {path.name}-wal is missing: put that "
                "back beside it, or remove the file to begin anew."
            )
        if whose != APPLICATION:
            raise StoreError(f"{path} is a database, but not one of skyline-annotate.")
        if version > len(MIGRATIONS):
            raise StoreError(
                f"{path} is of version {version}, and this program knows versions up to "
                f"{len(MIGRATIONS)}; install a newer one."
            )
        found = str(labels.execute("PRAGMA integrity_check(1)").fetchone()[0])
        if found != "ok":
            raise DamagedError(damaged(path, _where(found)))
    return version


def migrate(connection: sqlite3.Connection, version: int) -> None:
    """Bring labels of an older version up to date."""
    for number, script in enumerate(MIGRATIONS[version:], version + 1):
        ends = f"PRAGMA application_id = {APPLICATION}; PRAGMA user_version = {number};"
        connection.executescript(f"BEGIN IMMEDIATE; {script} {ends} COMMIT;")


def shown(text: str) -> str:
    """Text from a file that may be damaged, as one short line that any terminal can show."""
    return shortened(text, _LONGEST)
