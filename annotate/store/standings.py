"""Where the labels of a pass stand, in short: what lists show, without reading a log."""

from __future__ import annotations

import json
import sqlite3
from dataclasses import dataclass

from annotate.store import checkpoints
from annotate.store.history import LogError, State
from annotate.store.kept_states import keep, read
from annotate.store.labels import STATUSES, Comment
from annotate.store.readable import reading_label

_SOUND = (  # a standing that is damaged counts as none
    f"status IN ({', '.join(map(repr, STATUSES))}) AND typeof(seconds) = 'real'"
    " AND json_valid(tags) AND json_type(tags) = 'array'"
    " AND (comment IS NULL OR typeof(comment) = 'text' AND typeof(commented_by) = 'text')"
)


@dataclass(frozen=True)
class Standing:
    """Where a label stands, in short."""

    status: str = "to do"
    """One of `labels.STATUSES`."""

    tags: tuple[str, ...] = ()
    """What has been noted about the photo."""

    seconds: float = 0.0
    """Time spent on it."""

    comment: Comment | None = None
    """What was said with the status; None where nothing was."""

    problem: str = ""
    """A sentence that says why its log cannot be read, if so."""

    @classmethod
    def of(cls, state: State) -> Standing:
        """What lists show of a state."""
        return cls(state.status, state.tags, state.seconds, state.comment)


def kept(database: sqlite3.Connection, annotator: str, number: int) -> dict[int, Standing]:
    """Standings of a pass, as they were kept with the logs, by the id of the label."""
    rows = database.execute(
        "SELECT label, status, tags, seconds, comment, commented_by"  # noqa: S608
        " FROM standings JOIN labels ON labels.id = label"
        f" WHERE annotator = ? AND number = ? AND {_SOUND}",
        (annotator, number),
    )
    return {
        int(label): Standing(
            status, tuple(json.loads(tags)), seconds, Comment(words, by) if words else None
        )
        for label, status, tags, seconds, words, by in rows
    }


def finished_by_others(
    database: sqlite3.Connection, annotator: str, number: int
) -> dict[int, tuple[str, ...]]:
    """Other passes that have accepted or rejected a photo, in words, by the id of the photo."""
    rows = database.execute(
        "SELECT photo, annotator, number FROM standings JOIN labels ON labels.id = label"  # noqa: S608
        f" WHERE NOT (annotator = ? AND number = ?) AND {_SOUND}"
        " AND status IN ('accepted', 'rejected')"
        " AND labels.id NOT IN (SELECT label FROM set_aside) ORDER BY annotator, number",
        (annotator, number),
    )
    found: dict[int, tuple[str, ...]] = {}
    for photo, who, which in rows:
        said = who if which == 1 else f"{who}, pass {which}"
        found[photo] = (*found.get(photo, ()), said)
    return found


def missing(database: sqlite3.Connection) -> list[int]:
    """Labels that have a log and no standing: of an older version, imported, or not readable."""
    rows = database.execute(
        f"SELECT id FROM labels WHERE id NOT IN (SELECT label FROM standings WHERE {_SOUND})"  # noqa: S608
        " AND id NOT IN (SELECT label FROM set_aside)"
        " AND EXISTS (SELECT 1 FROM operations WHERE label = labels.id)"
    )
    return [int(row[0]) for row in rows]


def made(database: sqlite3.Connection, *, keeping: bool) -> dict[int, Standing]:
    """Standings that are missing, from the logs, by the id of the label.

    Args:
        database: Where; in a transaction that writes, if they are kept.
        keeping: Whether to keep them, so that they are made once.
    """
    found = {}
    for label in missing(database):
        try:
            with reading_label(database, label):
                state = read(database, label)
        except LogError as error:
            found[label] = Standing("needs review", problem=str(error))
            continue
        found[label] = Standing.of(state)
        if keeping:
            keep(database, label, state, checkpoint=state.count >= checkpoints.EVERY)
    return found
