"""The table of labels: whole labels out of it, and labels from elsewhere into it."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from annotate.store.history import State
from annotate.store.kept_states import revision
from annotate.store.labels import NO_SKYLINE, Label
from annotate.store.lines import Line, LineError
from skyline_viz.skyline import Skyline


@dataclass(frozen=True, eq=False)
class Log:
    """A label from elsewhere, which has been checked: what was done, and the line at its end."""

    photo: int
    """Id of the photo."""

    annotator: str
    number: int
    """Of the pass."""

    blind: bool
    operations: Sequence[tuple[float, str, str]]
    """Time, kind, and all of it as JSON, oldest first; at least one."""

    line: Line


def begin(
    database: sqlite3.Connection, photo: int, annotator: str, number: int, *, blind: bool
) -> int:
    """Id of a label, which is made where there is none."""
    database.execute(
        "INSERT OR IGNORE INTO labels (photo, annotator, number, blind) VALUES (?, ?, ?, ?)",
        (photo, annotator, number, blind),
    )
    row = database.execute(
        "SELECT id FROM labels WHERE photo = ? AND annotator = ? AND number = ?",
        (photo, annotator, number),
    ).fetchone()
    return int(row[0])


def insert(database: sqlite3.Connection, log: Log) -> bool:
    """Add a label from elsewhere; False, and nothing, where somebody has worked on it."""
    label = begin(database, log.photo, log.annotator, log.number, blind=log.blind)
    if revision(database, label):
        return False
    database.execute("UPDATE labels SET blind = ? WHERE id = ?", (log.blind, label))
    last = len(log.operations) - 1
    database.executemany(
        "INSERT INTO operations (label, at, kind, body, line) VALUES (?, ?, ?, ?, ?)",
        [
            (label, at, kind, body, log.line.packed() if place == last else None)
            for place, (at, kind, body) in enumerate(log.operations)
        ],
    )
    return True


def labels_of(
    database: sqlite3.Connection,
    annotator: str | None,
    number: int | None,
    photo: int | None = None,
) -> list[int]:
    """Ids of labels, by the name of the photo; those that were set aside are left out."""
    rows = database.execute(
        "SELECT labels.id FROM labels JOIN photos ON photos.id = photo"
        " WHERE annotator = coalesce(?, annotator) AND number = coalesce(?, number)"
        " AND photo = coalesce(?, photo)"
        " AND labels.id NOT IN (SELECT label FROM set_aside)"
        " ORDER BY name, annotator, number",
        (annotator, number, photo),
    )
    return [int(row[0]) for row in rows]


def require_fit(line: Line | None, width: int) -> None:
    """Make sure that a line is one of its photo.

    Raises:
        LineError: It has another width.
    """
    if line is not None and line.skyline.width != width:
        raise LineError(f"its line has {line.skyline.width} columns, its photo {width}.")


def whole_label(database: sqlite3.Connection, label: int, state: State) -> Label:
    """A label with all that is known about it.

    Raises:
        ValueError: It is damaged.
    """
    row = database.execute(
        "SELECT name, photos.digest, pixels, width, height, annotator, number, blind,"
        " coalesce(about, '') FROM labels JOIN photos ON photos.id = photo"
        " LEFT JOIN detectors ON detectors.id = detector WHERE labels.id = ?",
        (label,),
    ).fetchone()
    name, digest, pixels, width, height, who, which, blind, about = row
    for text in (name, who, about):
        text.encode()
    require_fit(state.line, width)
    log = database.execute(
        "SELECT at, kind, body FROM operations WHERE label = ? ORDER BY id", (label,)
    )
    return Label(
        name=name,
        digest=digest,
        width=width,
        height=height,
        annotator=who,
        number=which,
        status=state.status,
        tags=state.tags,
        skyline=seen(state.line.skyline, state.tags) if state.line else None,
        origin=state.line.origin if state.line else np.zeros(width, np.uint8),
        operations=tuple({**json.loads(body), "kind": kind, "at": at} for at, kind, body in log),
        seconds=state.seconds,
        detector=about,
        blind=bool(blind),
        comment=state.comment,
        pixels=pixels or "",
        hidden=state.edits.hidden,
    )


def seen(line: Skyline, tags: Sequence[str]) -> Skyline:
    """A line as it counts: nothing of it is visible where the tags say that no skyline is."""
    if NO_SKYLINE not in tags:
        return line
    return Skyline(rows=line.rows, visible=np.zeros(line.width, np.bool_))
