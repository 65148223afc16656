"""The labels of a folder: photos, and the log of what was done to each, which only grows.

A photo is known by the SHA-256 of its file, so a folder that was moved or renamed finds its labels.
A label is one pass of one annotator over a photo. Its state follows from its log, and is kept
beside it (`kept_states`).
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from time import time
from typing import Any

import numpy as np

from annotate import standings
from annotate.database import NAME, StoreError, connect, sentences
from annotate.folder import photos_below
from annotate.kept_detectors import pack, unpack
from annotate.kept_states import KeptStates, Request, StaleError, add, known, last_line, revision
from annotate.labels import Label
from annotate.lines import Line
from annotate.log import State
from annotate.standings import Standing
from skyline_viz.methods.protocol import Method
from skyline_viz.photo import PhotoError, photo_size

__all__ = ["Card", "Photo", "StaleError", "State", "Store"]


@dataclass(frozen=True)
class Photo:
    """A photo of the folder."""

    id: int
    name: str
    """Its file below the folder, with ``/`` between folders."""

    digest: str
    width: int
    height: int


@dataclass(frozen=True)
class Card:
    """A label in short, as lists show it."""

    photo: Photo
    label: int | None
    """Its id; None where nobody has begun."""

    status: str
    tags: tuple[str, ...]
    margin: float | None
    """How sure the detector was of its proposal; None where there is none yet."""

    blind: bool
    seconds: float
    problem: str = ""
    """A sentence that says why its log cannot be read, if so."""


class Store:
    """The labels of a folder of photos, open for reading and writing."""

    def __init__(self, folder: Path) -> None:
        """Open them, and begin where there are none.

        Raises:
            StoreError: They cannot be opened; the message says why.
        """
        self.folder = folder
        self._lock = threading.RLock()
        self._connection = connect(folder)
        self._states = KeptStates()
        self.id: str = self._connection.execute("SELECT id FROM folder").fetchone()[0]
        """What tells these labels from those of other folders; a copy of the file has it, too."""
        self.problems: list[str] = []
        """A sentence for each file that `find` had to leave out."""

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._connection.close()

    def find(self) -> list[Photo]:
        """Photos that are in the folder now, by name; new ones are added to the store.

        Two files with the same content are one photo. Files that cannot be read are left out.
        """
        with self._reading() as database:
            known = {
                row[0]: row[1:]
                for row in database.execute("SELECT name, size, changed, digest FROM photos")
            }
        found: dict[str, tuple[str, int, int, int, int]] = {}
        problems = []
        for path in photos_below(self.folder):
            name = path.relative_to(self.folder).as_posix()
            try:
                name.encode()
                status = path.stat()
                size, changed = status.st_size, status.st_mtime_ns
                before = known.get(name)
                same = before is not None and before[:2] == (size, changed)
                digest = before[2] if before and same else _digest(path)
                height, width = photo_size(path)
            except UnicodeEncodeError:
                problems.append(f"{name!a} has a name that is no text, and is left out.")
                continue
            except (OSError, PhotoError) as error:
                problems.append(f"{name} is left out: {error}")
                continue
            if digest in found:
                problems.append(f"{name} has the same content as {found[digest][0]}.")
            found.setdefault(digest, (name, width, height, size, changed))
        self.problems = problems
        with self._writing() as database:
            database.executemany(
                "INSERT INTO photos (digest, name, width, height, size, changed)"
                " VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT (digest) DO UPDATE SET"
                " name = excluded.name, size = excluded.size, changed = excluded.changed",
                [(digest, *values) for digest, values in found.items()],
            )
        photos = [photo for photo in self.photos() if photo.digest in found]
        return sorted(photos, key=lambda photo: photo.name)

    def photos(self) -> list[Photo]:
        """Every photo that was ever seen, by name."""
        with self._reading() as database:
            rows = database.execute("SELECT id, name, digest, width, height FROM photos")
            return sorted((Photo(*row) for row in rows), key=lambda photo: photo.name)

    def begin(self, photo: int, annotator: str, number: int, *, blind: bool = False) -> int:
        """Id of a label, which is made where there is none."""
        with self._writing() as database:
            database.execute(
                "INSERT OR IGNORE INTO labels (photo, annotator, number, blind)"
                " VALUES (?, ?, ?, ?)",
                (photo, annotator, number, blind),
            )
            row = database.execute(
                "SELECT id FROM labels WHERE photo = ? AND annotator = ? AND number = ?",
                (photo, annotator, number),
            ).fetchone()
            return int(row[0])

    def is_blind(self, label: int) -> bool:
        """Whether a label is made without a proposal."""
        with self._reading() as database:
            row = database.execute("SELECT blind FROM labels WHERE id = ?", (label,)).fetchone()
            return bool(row[0])

    def propose(self, label: int, line: Line, detector: Method | None, margin: float) -> None:
        """Keep the proposal of a label, and what made it.

        Raises:
            StaleError: Somebody has worked on it already.
        """
        with self._writing() as database:
            if now := revision(database, label):
                raise StaleError(
                    "the photo has been worked on, so its proposal stays as it is.", now
                )
            made_by = None if detector is None else _keep_detector(database, detector)
            database.execute(
                "UPDATE labels SET proposal = ?, detector = ?, margin = ? WHERE id = ?",
                (line.packed(), made_by, margin, label),
            )

    def detector(self, label: int) -> Method | None:
        """The detector that made the proposal of a label; None where there is no proposal."""
        with self._reading() as database:
            row = database.execute(
                "SELECT config, bank FROM detectors"
                " WHERE id = (SELECT detector FROM labels WHERE id = ?)",
                (label,),
            ).fetchone()
        if row is None:
            return None
        return unpack(*row)

    def append(
        self,
        label: int,
        revision: int,
        kind: str,
        body: dict[str, Any],
        line: Line | None = None,
        id: str | None = None,  # noqa: A002
    ) -> int:
        """Add an operation to the log of a label. When this returns, it is on the disk.

        Args:
            label: The label.
            revision: The `State.revision` that the operation was made on; -1 for any.
            kind: What it is.
            body: The operation itself, for JSON.
            line: The line after it, where it changes the line.
            id: What it is known by when it comes again; nothing is added then.

        Returns:
            The revision that it got, now or when it came first.

        Raises:
            StaleError: The label has another revision by now, or the id is another operation's.
            EditError: It makes no sense for the photo.
            StoreError: The disk is full, or the file cannot be written; nothing was added.
        """
        asked = Request(label, revision, kind, body, id)
        with self._writing() as database:
            before = known(database, asked)
            if before is not None:
                return before
            state = add(database, asked, self._states.read(database, label), time(), line)
        with self._lock:
            self._states.remember(label, state)
        return state.revision

    def known(self, asked: Request) -> int | None:
        """Revision that an operation got when it came before; None when it may be done.

        Raises:
            StaleError: As `append` does.
        """
        with self._reading() as database:
            return known(database, asked)

    def insert(
        self, label: int, log: Iterable[tuple[float, str, dict[str, Any]]], line: Line
    ) -> None:
        """Give a label that nobody has worked on a log from elsewhere, and the line at its end.

        Args:
            label: The label.
            log: Time, kind and body of each operation, oldest first.
            line: The line.

        Raises:
            StaleError: Somebody has worked on it.
        """
        rows = [(label, at, kind, _json(kind, body), None) for at, kind, body in log]
        with self._writing() as database:
            if now := revision(database, label):
                raise StaleError("the photo has been worked on, so nothing is imported.", now)
            for number, row in enumerate(rows, 1):
                whole = (*row[:-1], line.packed()) if number == len(rows) else row
                database.execute(
                    "INSERT INTO operations (label, at, kind, body, line) VALUES (?, ?, ?, ?, ?)",
                    whole,
                )

    def state(self, label: int) -> State:
        """Where a label stands.

        Raises:
            LogError: Its log cannot be read.
        """
        with self._reading() as database:
            state = self._states.read(database, label)
            return state if state.revision else replace(state, line=last_line(database, label))

    def line(self, label: int) -> Line | None:
        """The line of a label as it was acknowledged; None where there is none."""
        with self._reading() as database:
            return last_line(database, label)

    def cards(self, annotator: str, number: int) -> dict[int, Card]:
        """Labels of a pass in short, by the id of their photo, for all photos."""
        fresh = self._missing_standings()
        with self._reading() as database:
            labels = database.execute(
                "SELECT photo, id, margin, blind FROM labels WHERE annotator = ? AND number = ?",
                (annotator, number),
            ).fetchall()
            stand = standings.kept(database, annotator, number) | fresh
        begun = {photo: rest for photo, *rest in labels}
        cards = {}
        for photo in self.photos():
            label, margin, blind = begun.get(photo.id, (None, None, False))
            one = stand.get(label or 0, Standing())
            cards[photo.id] = Card(photo, label, margin=margin, blind=bool(blind), **vars(one))
        return cards

    def passes(self) -> list[tuple[str, int]]:
        """Annotators and their passes, by name."""
        with self._reading() as database:
            return list(
                database.execute("SELECT DISTINCT annotator, number FROM labels ORDER BY 1, 2")
            )

    def labels(self, annotator: str | None = None, number: int | None = None) -> Iterator[Label]:
        """Labels with all that is known about them, by the name of the photo.

        Args:
            annotator: Only theirs.
            number: Only of this pass.
        """
        with self._reading() as database:
            rows = database.execute(
                "SELECT labels.id, name, photos.digest, width, height, annotator, number, blind,"
                " coalesce(about, '') FROM labels JOIN photos ON photos.id = photo"
                " LEFT JOIN detectors ON detectors.id = detector"
                " WHERE annotator = coalesce(?, annotator) AND number = coalesce(?, number)"
                " ORDER BY name, annotator, number",
                (annotator, number),
            ).fetchall()
        for label, name, digest, width, height, who, which, blind, about in rows:
            state = self.state(label)
            with self._reading() as database:
                log = database.execute(
                    "SELECT at, kind, body FROM operations WHERE label = ? ORDER BY id", (label,)
                ).fetchall()
            yield Label(
                name=name,
                digest=digest,
                width=width,
                height=height,
                annotator=who,
                number=which,
                status=state.status,
                tags=state.tags,
                skyline=state.line.skyline if state.line else None,
                origin=state.line.origin if state.line else np.zeros(width, np.uint8),
                operations=tuple(
                    {**json.loads(body), "kind": kind, "at": at} for at, kind, body in log
                ),
                seconds=state.seconds,
                detector=about,
                blind=bool(blind),
            )

    def _missing_standings(self) -> dict[int, Standing]:
        """Standings of labels that had none, by the label's id; they are kept from now on."""
        with self._reading() as database:
            if not standings.missing(database):
                return {}
        try:
            with self._writing() as database:
                return standings.made(database, keeping=True)
        except StoreError:  # they can still be read
            with self._reading() as database:
                return standings.made(database, keeping=False)

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection]:
        with self._lock, sentences(self.folder / NAME):
            yield self._connection

    @contextmanager
    def _writing(self) -> Iterator[sqlite3.Connection]:
        with self._lock, sentences(self.folder / NAME):
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
                self._connection.execute("COMMIT")
            except BaseException:
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")
                raise


def _json(kind: str, body: dict[str, Any]) -> str:
    return json.dumps({**body, "kind": kind})


def _keep_detector(database: sqlite3.Connection, detector: Method) -> int:
    """Id of a detector, which is added where it is new."""
    kept = pack(detector)
    database.execute(
        "INSERT OR IGNORE INTO detectors (digest, about, config, bank) VALUES (?, ?, ?, ?)",
        (kept.digest, kept.about, kept.config, kept.bank),
    )
    row = database.execute("SELECT id FROM detectors WHERE digest = ?", (kept.digest,)).fetchone()
    return int(row[0])


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
