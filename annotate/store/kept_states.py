"""Where each label stands, kept beside its log and never trusted further than the log.

Whoever adds an operation adds, in the same transaction, what follows from it: the standing of the
label, which lists show, and now and then a checkpoint, from which the state is folded. A trigger
takes the standing away with each operation that gets in, so one that is there is right; where it is
missing, as in labels of an older version, it is made from the log.
"""

from __future__ import annotations

import json
import sqlite3
from collections import OrderedDict
from collections.abc import Iterable
from dataclasses import dataclass, replace
from time import time
from typing import Any

from annotate.engine.edits import Edits
from annotate.store import checkpoints
from annotate.store.history import State, folded
from annotate.store.lines import Line
from annotate.store.operations import LOGGED, Logged
from annotate.store.readable import reading_label

_KEPT = 8  # states in memory


class StaleError(ValueError):
    """The label is not what the request was made on, or its id belongs to another request.

    It has been changed since by another tab or program.
    """

    def __init__(self, message: str, revision: int) -> None:
        """Say why, and which revision the label has now."""
        super().__init__(message)
        self.revision = revision


@dataclass(frozen=True)
class Request:
    """An operation that somebody asks for."""

    label: int
    """The label."""

    revision: int
    """The revision that it was made on; -1 for any."""

    kind: str
    """What it is."""

    body: dict[str, Any]
    """All else about it, for JSON."""

    id: str | None = None
    """An id by which it is known when it comes again."""

    @property
    def text(self) -> str:
        """The operation as the log keeps it."""
        return json.dumps({**self.body, "kind": self.kind})

    def operation(self) -> Logged:
        """What is to be done."""
        return LOGGED.validate_json(self.text)


class KeptStates:
    """States of the labels that were asked for last, and what a database keeps of all."""

    def __init__(self) -> None:
        """Begin with none."""
        self._states: OrderedDict[int, State] = OrderedDict()

    def read(self, database: sqlite3.Connection, label: int) -> State:
        """The state of a label.

        Raises:
            LogError: Its log cannot be read.
        """
        state = self._states.get(label)
        found = database.execute("SELECT last FROM standings WHERE label = ?", (label,)).fetchone()
        if state is None or state.last != (found[0] if found else 0):
            state = read(database, label)
            if found:  # else somebody who may write keeps where it stands first
                self.remember(label, state)
        return state

    def remember(self, label: int, state: State) -> None:
        """Keep a state in memory, once it is on the disk."""
        self._states[label] = state
        self._states.move_to_end(label)
        while len(self._states) > _KEPT:
            self._states.popitem(last=False)


def known(database: sqlite3.Connection, asked: Request) -> int | None:
    """Revision that a request got when it came before; None when it is new and may be done.

    Raises:
        StaleError: It was made on another revision, or its id belongs to another request.
    """
    now = revision(database, asked.label)
    before = (
        asked.id
        and database.execute(
            "SELECT id, label, kind, body FROM operations WHERE request = ?", (asked.id,)
        ).fetchone()
    )
    if before:
        if before[1:3] != (asked.label, asked.kind) or _asked(before[3]) != _asked(asked.text):
            raise StaleError("the id of this request belongs to another one.", now)
        return _revision_at(database, asked.label, before[0])
    if asked.revision not in (-1, now):
        raise StaleError("the photo was changed in another tab, and is shown as it is now.", now)
    return None


def add(
    database: sqlite3.Connection, asked: Request, before: State, at: float, line: Line | None
) -> State:
    """Do what is asked, which `known` has let pass.

    Args:
        database: Where, in a transaction.
        asked: The request.
        before: The state of the label.
        at: The time.
        line: The line after it, where it changes the line.

    Returns:
        The state after it.

    Raises:
        EditError: It makes no sense for the photo.
    """
    operation = asked.operation()
    cursor = database.execute(
        "INSERT INTO operations (label, at, kind, body, line, request) VALUES (?, ?, ?, ?, ?, ?)",
        (asked.label, at, asked.kind, asked.text, line and line.packed(), asked.id),
    )
    state = before.after(operation, at, int(cursor.lastrowid or 0), line)
    keep(database, asked.label, state, checkpoint=state.count % checkpoints.EVERY == 0)
    return state


def add_all(
    database: sqlite3.Connection, wanted: Iterable[tuple[Request, Line | None]], states: KeptStates
) -> tuple[list[int], dict[int, State]]:
    """Do what is asked, one after the other, but for what is known already.

    Args:
        database: Where, in a transaction.
        wanted: Requests, each with the line after it, where it changes the line.
        states: States of labels as they are.

    Returns:
        The revision of each request, and the states of the labels that were added to.

    Raises:
        StaleError: As `known` does.
        EditError: It makes no sense for the photo.
        LogError: The log of a label cannot be read.
    """
    revisions: list[int] = []
    after: dict[int, State] = {}
    for asked, line in wanted:
        before = known(database, asked)
        if before is None:
            with reading_label(database, asked.label):
                state = after.get(asked.label) or states.read(database, asked.label)
            after[asked.label] = add(database, asked, state, time(), line)
            before = after[asked.label].revision
        revisions.append(before)
    return revisions, after


def keep(database: sqlite3.Connection, label: int, state: State, *, checkpoint: bool) -> None:
    """Keep where a label stands; with a checkpoint, also all else about its state.

    It has to be done in the transaction in which the log was read or added to.
    """
    database.execute(
        "INSERT OR REPLACE INTO standings"
        " (label, last, revision, status, tags, seconds, comment, commented_by)"
        " VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
        (
            label,
            state.last,
            state.revision,
            state.status,
            json.dumps(state.tags),
            state.seconds,
            state.comment and state.comment.text,
            state.comment and state.comment.by,
        ),
    )
    if checkpoint:
        database.execute(
            "INSERT OR REPLACE INTO checkpoints (label, state) VALUES (?, ?)",
            (label, checkpoints.packed(state, label)),
        )


def revision(database: sqlite3.Connection, label: int) -> int:
    """Revision of a label; 0 where nobody has worked on it."""
    row = database.execute("SELECT revision FROM standings WHERE label = ?", (label,)).fetchone()
    return int(row[0]) if row else _revision_at(database, label, 2**62)


def last_line(database: sqlite3.Connection, label: int) -> Line | None:
    """The line of a label as it was acknowledged; the proposal where nothing has changed it."""
    row = database.execute(
        "SELECT line FROM operations WHERE label = ?"
        " AND (line IS NOT NULL OR kind NOT IN ('open', 'tag', 'status'))"
        " ORDER BY id DESC LIMIT 1",
        (label,),
    ).fetchone()
    if row is None:
        row = database.execute("SELECT proposal FROM labels WHERE id = ?", (label,)).fetchone()
    return Line.unpacked(row[0]) if row and row[0] else None


def read(database: sqlite3.Connection, label: int) -> State:
    """The state of a label, from its last checkpoint and what was done since.

    Raises:
        LogError: Its log cannot be read.
    """
    width, height = database.execute(
        "SELECT width, height FROM labels JOIN photos ON photos.id = photo WHERE labels.id = ?",
        (label,),
    ).fetchone()
    empty = Edits(height, width)
    found = database.execute("SELECT state FROM checkpoints WHERE label = ?", (label,)).fetchone()
    start = found and checkpoints.unpacked(found[0], label, empty)
    if not start or not _fits(database, label, start):
        start = State(empty)
    log = database.execute(
        "SELECT id, at, kind, body FROM operations WHERE label = ? AND id > ? ORDER BY id",
        (label, start.last),
    )
    return replace(folded(start, log), line=last_line(database, label))


def _asked(text: str) -> dict[str, Any]:
    """What somebody asked for, without what was found when it was done, and who it was.

    What was left open counts as not there: an older program may have known nothing of it.
    """
    body: dict[str, Any] = json.loads(text)
    left = ("found", "by")
    return {name: one for name, one in body.items() if name not in left and one is not None}


def _fits(database: sqlite3.Connection, label: int, start: State) -> bool:
    """Whether a checkpoint counts as many operations as the log has up to there."""
    count, last = database.execute(
        "SELECT count(*), max(id) FROM operations WHERE label = ? AND id <= ?", (label, start.last)
    ).fetchone()
    return bool((count, last) == (start.count, start.last))


def _revision_at(database: sqlite3.Connection, label: int, number: int) -> int:
    """Revision of a label just after one of its operations."""
    row = database.execute(
        "SELECT id FROM operations WHERE label = ? AND id <= ? AND kind != 'open'"
        " ORDER BY id DESC LIMIT 1",
        (label, number),
    ).fetchone()
    return int(row[0]) if row else 0
