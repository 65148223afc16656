"""Labels of a damaged or poisoned folder: what can be read is saved, what cannot is set aside.

Nothing is deleted. A label that cannot be read keeps its rows, and its photo is free to be labelled
again. A damaged file and its journal keep their bytes under another name, and what can still be
read of them goes into a new one. Operations whose label is lost go into a JSON file beside it.
"""

from __future__ import annotations

import json
import shutil
import sqlite3
from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from annotate.rescue.salvage import salvaged
from annotate.store.database import (
    NAME,
    DamagedError,
    StoreError,
    connect,
    examine,
    holds_something,
    sentences,
    write_into,
)
from annotate.store.history import LogError
from annotate.store.kept_detectors import unpack
from annotate.store.kept_states import KeptStates
from annotate.store.label_table import whole_label
from annotate.store.labels import check_annotator
from annotate.store.lines import Line, LineError
from annotate.store.readable import named, reading_label
from annotate.store.store import Store
from skyline_viz.files import flush, replacing
from skyline_viz.method import UnnamedClassError


@dataclass
class Repaired:
    """What was done."""

    said: list[str] = field(default_factory=list)
    """A sentence for each thing; none where there was nothing to do."""

    whole: bool = True
    """Whether no label was lost, or set aside."""


def repair(folder: Path) -> Repaired:
    """Repair the labels of a folder, which nobody has open meanwhile.

    Raises:
        StoreError: There are none, they are of a newer version or not ours, nothing of them can be
            read, or the folder cannot be written.
    """
    path = folder / NAME
    if not holds_something(path):
        raise StoreError(f"{folder} has no labels to repair.")
    done = Repaired()
    lost: dict[int, str] = {}
    try:
        examine(path)
    except DamagedError:
        lost = _save(path, done)
        with closing(Store(folder)) as store:
            store.find()  # photos that are there say themselves what was lost of them
    with closing(connect(folder)) as database, sentences(path):
        database.execute("BEGIN IMMEDIATE")
        done.said += _drop_proposals(database)
        for label, reason in _unreadable(database, lost).items():
            _set_aside(database, label, reason)
            done.said.append(f"set aside: {reason}")
            done.whole = False
        database.execute("COMMIT" if done.said else "ROLLBACK")
    return done


def _save(path: Path, done: Repaired) -> dict[int, str]:
    """Put what can be read of a damaged file in its place; return why labels are not whole."""
    found = salvaged(path)
    date = datetime.now().astimezone().strftime("%Y-%m-%d-%H%M%S")
    kept = path.with_name(f"{path.stem}-damaged-{date}{path.suffix}")
    beside = [path.with_name(path.name + end) for end in ("-wal", "-journal", "-shm")]
    try:
        with closing(found.labels), sentences(path), replacing(path) as temporary:
            write_into(temporary, found.labels)
            for file in (path, *beside[:2]):
                if file.exists():
                    copy = kept.with_name(file.name.replace(path.name, kept.name))
                    shutil.copyfile(file, copy)
                    flush(copy)
            if found.left:
                aside = path.with_name(f"{path.stem}-set-aside-{date}.json")
                aside.write_text(json.dumps(found.left, default=_plain), encoding="utf-8")
                flush(aside)
            for file in beside:  # which belong to the damaged file, and not to the new one
                file.unlink(missing_ok=True)
    except StoreError:
        raise
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise StoreError(f"{path} cannot be repaired: {reason}.") from error
    done.said.append(
        f"{path} was damaged; what can be read is in a new one, and it is now {kept.name}."
    )
    if found.left:
        found.said.append(
            f"{len(found.left)} operations belong to labels that are lost, and are set aside in "
            f"{aside.name}."
        )
    done.said += found.said
    done.whole = not found.said
    return found.lost


def _plain(value: bytes) -> list[int] | str:
    """Bytes of a line for JSON: its rows where they can be read."""
    try:
        return [int(row) for row in Line.unpacked(value).skyline.rows]
    except LineError:
        return bytes(value).hex()


def _unreadable(database: sqlite3.Connection, lost: Mapping[int, str]) -> dict[int, str]:
    """Why labels cannot be read, by their id."""
    states, found = KeptStates(), {}
    for (label,) in database.execute(
        "SELECT id FROM labels WHERE id NOT IN (SELECT label FROM set_aside) ORDER BY id"
    ).fetchall():
        try:
            with reading_label(database, label):
                if label in lost:
                    raise LogError(lost[label])
                database.execute("DELETE FROM checkpoints WHERE label = ?", (label,))
                whole = whole_label(database, label, states.read(database, label))
                check_annotator(whole.annotator)
                if whole.number < 1:
                    raise LogError(f"there is no pass {whole.number}")
        except LogError as error:
            found[label] = str(error)
    return found


def _drop_proposals(database: sqlite3.Connection) -> list[str]:
    """Forget proposals that are damaged, and what made them: they can be made again."""
    said = []
    for label, proposal, config, bank in database.execute(
        "SELECT labels.id, proposal, config, bank FROM labels"
        " LEFT JOIN detectors ON detectors.id = detector"
        " WHERE proposal IS NOT NULL OR detector IS NOT NULL"
    ).fetchall():
        try:
            with reading_label(database, label):
                if proposal is not None:
                    Line.unpacked(proposal)
                if bank is not None:
                    unpack(config, bank)
        except LogError as error:
            if isinstance(error.__cause__, UnnamedClassError):
                continue  # nothing is damaged, and who wrote that class can name it
            database.execute(
                "UPDATE labels SET proposal = NULL, detector = NULL, confidence = NULL"
                " WHERE id = ?",
                (label,),
            )
            said.append(f"the proposal of {named(database, label)} was damaged, and is forgotten.")
    return said


def _set_aside(database: sqlite3.Connection, label: int, reason: str) -> None:
    """Keep a label where it hides no other, and its photo can be labelled again."""
    database.execute(
        "INSERT INTO set_aside (label, annotator, number, reason)"
        " SELECT id, annotator, number, ? FROM labels WHERE id = ?",
        (reason, label),
    )
    database.execute("UPDATE labels SET number = -id WHERE id = ?", (label,))
