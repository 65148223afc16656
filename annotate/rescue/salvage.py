"""Rows that can still be read from a damaged file of labels, whatever else of it is lost.

Rows are read in their order, and where a page of the file is damaged, one by one behind it. The
index of operations tells of which labels operations are lost; those of photos and of labels hold
enough to know whose label of which photo each was.
"""

from __future__ import annotations

import json
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from annotate.store.database import APPLICATION, DamagedError, StoreError, migrate, prepare
from annotate.store.journal import replay
from annotate.store.lines import Line, LineError

_TABLES = ("photos", "detectors", "labels", "operations", "set_aside")
_FAR = 10_000  # rows that are looked for behind the last one, where their number is unknown
_TALLEST = 1_000_000  # rows that a photo can have
_FAULTS = (sqlite3.DatabaseError, UnicodeError, OverflowError)


@dataclass
class Salvage:
    """What could be read."""

    labels: sqlite3.Connection
    """It, in memory, as labels of the present version."""

    lost: dict[int, str] = field(default_factory=dict)
    """Why a label is not whole, by its id."""

    said: list[str] = field(default_factory=list)
    """A sentence for all else that is lost."""

    left: list[dict[str, Any]] = field(default_factory=list)
    """Operations of labels that are lost: rows of their table, to be kept elsewhere."""


def salvaged(path: Path) -> Salvage:
    """Read what can be read from a damaged file of labels.

    Raises:
        StoreError: It is somebody else's, or nothing of it can be read.
    """
    with tempfile.TemporaryDirectory(prefix="skyline-labels-") as folder:
        copy = Path(folder) / path.name
        try:
            incomplete = replay(path, copy)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise StoreError(f"{path} cannot be copied to be read: {reason}.") from error
        with closing(sqlite3.connect(copy, isolation_level=None)) as there:
            prepare(there)
            try:
                if there.execute("PRAGMA application_id").fetchone()[0] != APPLICATION:
                    raise StoreError(f"{path} is no database of skyline-annotate that can be read.")
                there.execute("SELECT 1 FROM operations LIMIT 0")
            except _FAULTS as error:
                raise DamagedError(
                    f"{path} is so damaged that nothing of it can be read; restore it from a "
                    "backup."
                ) from error
            found = _read(there)
    if incomplete:
        found.said.append("its journal was damaged: changes that were kept last may be missing.")
    return found


def _read(there: sqlite3.Connection) -> Salvage:
    here = sqlite3.connect(":memory:", isolation_level=None, check_same_thread=False)
    prepare(here)
    migrate(here, 0)
    here.execute("PRAGMA foreign_keys = OFF")  # rows may come without those they refer to
    found = Salvage(here)
    for table in _TABLES:
        known = {row[1] for row in here.execute(f"PRAGMA table_info({table})")}
        missed = sum(not _keep(found, table, row, known) for row in _rows(there, table))
        if missed:
            found.said.append(f"{missed} rows of {table} are damaged, and are left out.")
    _tell_lost(there, found)
    _keep_indexed_labels(there, found)
    _keep_indexed_photos(there, found)
    _make_consistent(found)
    here.execute("PRAGMA foreign_keys = ON")
    return found


def _rows(database: sqlite3.Connection, table: str) -> Iterator[dict[str, Any]]:
    """Rows of a table that can be read, by their number."""
    place, top = 0, _top(database, table)
    while True:
        try:
            for number, row in _read_rows(database, table, "> ?", place):
                if number <= place:
                    raise sqlite3.DatabaseError("pages in a circle")
                place = number
                yield row
            return
        except _FAULTS:
            last = top if top > place else place + _FAR
            for number in range(place + 1, last + 1):
                found = _row_at(database, table, number)
                if found is not None:
                    place = number
                    yield found
                    break
            else:
                return


def _row_at(database: sqlite3.Connection, table: str, number: int) -> dict[str, Any] | None:
    """A row by its number; None where it cannot be read."""
    with suppress(*_FAULTS):
        for found, row in _read_rows(database, table, "= ?", number):
            return row if found == number else None
    return None


def _read_rows(
    database: sqlite3.Connection, table: str, which: str, number: int
) -> Iterator[tuple[int, dict[str, Any]]]:
    rows = database.execute(
        f"SELECT rowid, * FROM {table} NOT INDEXED WHERE rowid {which} ORDER BY rowid",  # noqa: S608
        (number,),
    )
    names = [column[0] for column in rows.description[1:]]
    for at, *values in rows:
        yield int(at), dict(zip(names, values, strict=True))


def _top(database: sqlite3.Connection, table: str) -> int:
    """The largest number of a row of a table; 0 where it cannot be found out."""
    for question in (
        f"SELECT max(rowid) FROM {table}",  # noqa: S608
        f"SELECT seq FROM sqlite_sequence WHERE name = '{table}'",  # noqa: S608
    ):
        with suppress(*_FAULTS):
            row = database.execute(question).fetchone()
            if row and isinstance(row[0], int) and 0 < row[0] <= 10**7:
                return row[0]
    return 0


def _keep(found: Salvage, table: str, row: dict[str, Any], known: set[str]) -> bool:
    """Add a row; False where it is none that the table can hold."""
    kept = {name: value for name, value in row.items() if name in known}
    for name, value in kept.items():
        if isinstance(value, str):
            kept[name] = plain = value.encode("utf-8", "replace").decode()
            owner = {"labels": "id", "operations": "label"}.get(table)
            if plain != value and owner:
                found.lost[row[owner]] = "some of its text is damaged"
    columns, marks = ", ".join(kept), ", ".join("?" * len(kept))
    try:
        done = found.labels.execute(
            f"INSERT OR IGNORE INTO {table} ({columns}) VALUES ({marks})",  # noqa: S608
            list(kept.values()),
        )
    except _FAULTS:
        return False
    return done.rowcount == 1


def _tell_lost(there: sqlite3.Connection, found: Salvage) -> None:
    """Find out of which labels operations are lost."""
    kept = dict(found.labels.execute("SELECT id, label FROM operations"))
    indexed: dict[int, int] = {}
    try:
        index = there.execute("SELECT label, rowid FROM operations INDEXED BY operations_of")
        indexed.update((number, label) for label, number in index)
        gaps = [number for number in indexed if number not in kept]
    except _FAULTS:
        top = max(_top(there, "operations"), *kept, *indexed, 0, 0)
        gaps = [number for number in range(1, top + 1) if number not in kept]
    counts: dict[int, int] = {}
    unknown = 0
    for number in gaps:
        if number in indexed:
            counts[indexed[number]] = counts.get(indexed[number], 0) + 1
            continue
        unknown += 1
        for label in _around(kept, number):
            found.lost.setdefault(label, "operations beside its own are lost, perhaps some of it")
    for label, count in counts.items():
        found.lost[label] = f"{count} of its operations are lost"
    if unknown:
        found.said.append(f"{unknown} operations are lost, and nothing tells of which labels.")


def _around(kept: dict[int, int], number: int) -> set[int]:
    """Labels of the operations just before and after one that is lost."""
    before = next((kept[at] for at in range(number - 1, 0, -1) if at in kept), None)
    last = max(kept, default=0)
    after = next((kept[at] for at in range(number + 1, last + 1) if at in kept), None)
    return {label for label in (before, after) if label is not None}


def _indexed(there: sqlite3.Connection, columns: str, table: str) -> list[tuple[Any, ...]]:
    """What the index of a table that makes its rows unique holds of them, as far as it is read."""
    found: list[tuple[Any, ...]] = []
    with suppress(*_FAULTS):
        found.extend(
            there.execute(
                f"SELECT {columns}, rowid FROM {table} INDEXED BY sqlite_autoindex_{table}_1"  # noqa: S608
            )
        )
    return found


def _keep_indexed_labels(there: sqlite3.Connection, found: Salvage) -> None:
    """Keep labels whose rows are lost: their index says of which photo, and whose they are."""
    for photo, who, number, label in _indexed(there, "photo, annotator, number", "labels"):
        row = {"id": label, "photo": photo, "annotator": who, "number": number}
        _keep(found, "labels", row, set(row))  # ignored where it is there


def _keep_indexed_photos(there: sqlite3.Connection, found: Salvage) -> None:
    """Keep photos of labels whose rows are lost: all else is found with a file of the digest."""
    labels = found.labels
    digests = {number: digest for digest, number in _indexed(there, "digest", "photos")}
    lost = "SELECT DISTINCT photo FROM labels WHERE photo NOT IN (SELECT id FROM photos)"
    unknown = 0
    for (photo,) in labels.execute(lost).fetchall():
        width, height = _size(labels, photo)
        unknown += photo not in digests
        labels.execute(
            "INSERT OR IGNORE INTO photos (id, digest, name, width, height, size, changed)"
            " VALUES (?, ?, ?, ?, ?, 0, 0)",
            (photo, digests.get(photo, f"lost-{photo}"), f"unknown-{photo}", width, height),
        )
    if unknown:
        found.said.append(f"{unknown} photos of labels are lost, and nothing tells which they are.")


def _size(labels: sqlite3.Connection, photo: int) -> tuple[int, int]:
    """Columns of a photo, and rows that it has at least, by what was done to it."""
    width, height = 1, 1
    for line, body in labels.execute(
        "SELECT line, body FROM operations JOIN labels ON labels.id = label WHERE photo = ?"
        " UNION ALL SELECT proposal, '' FROM labels WHERE photo = ?",
        (photo, photo),
    ):
        with suppress(LineError):
            skyline = Line.unpacked(line).skyline
            width, height = skyline.width, max(height, int(skyline.rows.max()) + 1)
        with suppress(ValueError, TypeError, LookupError, RecursionError):
            done = json.loads(body)
            rows = [done[name] for name in ("row", "to_row") if name in done]
            rows += [*done.get("rows", ()), *(point[1] for point in done.get("points", ()))]
            height = max([height, *(row + 1 for row in rows if row < _TALLEST)])
    return width, height


def _make_consistent(found: Salvage) -> None:
    """Leave out, with a sentence, what refers to rows that are lost."""
    labels = found.labels
    proposals = labels.execute(
        "UPDATE labels SET detector = NULL, proposal = NULL, confidence = NULL"
        " WHERE detector NOT IN (SELECT id FROM detectors)"
    ).rowcount
    if proposals:
        found.said.append(f"{proposals} proposals are forgotten with what made them.")
    labels.execute("DELETE FROM labels WHERE photo NOT IN (SELECT id FROM photos)")
    labels.execute("DELETE FROM set_aside WHERE label NOT IN (SELECT id FROM labels)")
    rows = labels.execute(
        "SELECT * FROM operations WHERE label NOT IN (SELECT id FROM labels) ORDER BY id"
    )
    names = [column[0] for column in rows.description]
    found.left = [dict(zip(names, row, strict=True)) for row in rows]
    labels.execute("DROP TRIGGER operations_remain")
    labels.execute("DELETE FROM operations WHERE label NOT IN (SELECT id FROM labels)")
    labels.execute(
        "CREATE TRIGGER operations_remain BEFORE DELETE ON operations"
        " BEGIN SELECT RAISE(ABORT, 'operations are never deleted'); END"
    )
