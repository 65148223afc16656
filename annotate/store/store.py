"""The labels of a folder: photos, and the log of what was done to each, which only grows.

A photo is known by its content (`identity`), so a folder that was moved finds its labels. A label
is one pass of one annotator over a photo. Its state follows from its log, and is kept beside it
(`kept_states`).
"""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from annotate.store import standings
from annotate.store.cards import Card, cards_of, labels_of_pass
from annotate.store.database import (
    NAME,
    Place,
    StoreError,
    connect,
    journal_fault,
    sentences,
    shown,
)
from annotate.store.history import LogError, State
from annotate.store.identity import Photo, Stamp, pixel_digest, scan
from annotate.store.kept_detectors import keep_detector, unpack
from annotate.store.kept_states import (
    KeptStates,
    Request,
    StaleError,
    add_all,
    known,
    last_line,
    revision,
)
from annotate.store.label_table import Log, begin, insert, labels_of, whole_label
from annotate.store.labels import Label
from annotate.store.lines import Line
from annotate.store.opened import Present, read_whole
from annotate.store.photo_table import (
    every_photo,
    is_news,
    keep_file,
    keep_found,
    known_photos,
    photo_of,
)
from annotate.store.readable import reading_label
from annotate.store.snapshot import snapshot
from annotate.store.standings import Standing
from skyline_viz.method import Method
from skyline_viz.photo import PhotoError

__all__ = ["Photo", "StaleError", "State", "Store"]


class Store:
    """The labels of a folder of photos, open for reading and writing."""

    def __init__(self, folder: Path, *, reading: bool = False, of: Store | None = None) -> None:
        """Open them, and begin where there are none.

        Args:
            folder: The folder.
            reading: Whether they are only read: nothing is written then, so it works in every
                folder, and what is read is how they are now.
            of: A store of the folder, of which a copy is only read.

        Raises:
            StoreError: They cannot be opened; the message says why.
        """
        self.folder = folder
        self._lock = threading.RLock()
        self._place = None if reading or of else Place(folder / NAME)
        self.fault = journal_fault(folder / NAME) if reading and not of else ""
        """A sentence that says what is not read because the journal is damaged, if so."""
        if of:
            with of._reading() as database:
                self._connection = snapshot(folder, database)
        else:
            self._connection = snapshot(folder) if reading else connect(folder)
        self._states = KeptStates()
        self._present = Present()
        self._unreadable: dict[int, str] = {}
        self.problems: list[str] = []
        """A sentence for each file that `find` had to leave out."""
        self.unreadable: list[str] = []
        """A sentence for each label that `labels` had to leave out."""

    @property
    def id(self) -> str:
        """What tells these labels from those of other folders; a copy of the file has it, too."""
        with self._reading() as database:
            return str(database.execute("SELECT id FROM folder").fetchone()[0])

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._connection.close()

    def find(self) -> list[Photo]:
        """Photos that are in the folder now, by name; new ones are added to the store.

        Two files with the same content are one photo. Files that cannot be read are left out.
        Labels follow a photo that was renamed, or whose metadata was edited.
        """
        with self._reading() as database:
            known = known_photos(database)
        found, self.problems = scan(self.folder, known)
        if is_news(found, known):
            with self._writing() as database:
                keep_found(database, found, known)
        self._read_pixels({one.digest for one in found})
        here = {one.digest: one.stamp for one in found}
        photos = [photo for photo in self.photos() if photo.digest in here]
        self._present.found({photo.id: here[photo.digest] for photo in photos})
        return photos

    def is_here(self, photo: Photo) -> bool:
        """Whether a photo is still in the folder, and not another one under its name."""
        return self._present.holds(self, photo)

    def photos(self) -> list[Photo]:
        """Every photo that was ever seen, by name."""
        with self._reading() as database:
            return sorted(every_photo(database), key=lambda photo: photo.name)

    def photo(self, photo: int) -> Photo:
        """What is known of a photo now, by its id."""
        with self._reading() as database:
            return photo_of(database, photo)

    def keep_file(self, photo: Photo, digest: str, pixels: str, stamp: Stamp) -> None:
        """Keep what the file of a photo is now, whose pixels are the same.

        Raises:
            StoreError: It cannot be kept.
        """
        before = self.photo(photo.id)
        if (before.digest, before.pixels, before.name) != (digest, pixels, photo.name):
            with self._writing() as database:
                keep_file(database, photo.id, digest, pixels, stamp, photo.name)

    def _read_pixels(self, here: set[str]) -> None:
        """Read the pixels of photos with labels, once, so that their metadata may be edited."""
        if self._place is None:
            return  # it would be forgotten
        with self._reading() as database:
            known = [one for one in known_photos(database) if one.labelled]
        for one in known:
            photo = one.photo
            if photo.pixels or photo.digest not in here:
                continue
            with suppress(PhotoError, OSError):  # said when it is opened
                pixels = pixel_digest(read_whole(self, photo))
                with self._writing() as database:
                    database.execute(
                        "UPDATE photos SET pixels = ? WHERE id = ?", (pixels, photo.id)
                    )

    def begin(self, photo: int, annotator: str, number: int, *, blind: bool = False) -> int:
        """Id of a label, which is made where there is none."""
        with self._writing() as database:
            return begin(database, photo, annotator, number, blind=blind)

    def is_blind(self, label: int) -> bool:
        """Whether a label is made without a proposal."""
        with self._reading() as database:
            row = database.execute("SELECT blind FROM labels WHERE id = ?", (label,)).fetchone()
            return bool(row[0])

    def propose(self, label: int, line: Line, detector: Method | None, confidence: float) -> None:
        """Keep the proposal of a label, and what made it.

        Raises:
            StaleError: Somebody has worked on it already.
        """
        with self._writing() as database:
            if now := revision(database, label):
                raise StaleError(
                    "the photo has been worked on, so its proposal stays as it is.", now
                )
            made_by = None if detector is None else keep_detector(database, detector)
            database.execute(
                "UPDATE labels SET proposal = ?, detector = ?, confidence = ? WHERE id = ?",
                (line.packed(), made_by, confidence, label),
            )

    def detector(self, label: int) -> Method | None:
        """The detector that made the proposal of a label; None where there is no proposal.

        Raises:
            LogError: It is damaged.
        """
        with self._reading() as database:
            row = database.execute(
                "SELECT config, bank FROM detectors"
                " WHERE id = (SELECT detector FROM labels WHERE id = ?)",
                (label,),
            ).fetchone()
            if row is None:
                return None
            try:
                with reading_label(database, label):
                    return unpack(*row)
            except OSError as error:
                reason = (error.strerror or str(error)).lower()
                raise StoreError(f"there is no room to read what proposed: {reason}.") from error

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
        return self.append_all([(Request(label, revision, kind, body, id), line)])[0]

    def append_all(self, wanted: Iterable[tuple[Request, Line | None]]) -> list[int]:
        """Do as `append` does with several operations, all of them at once or none."""
        with self._writing() as database:
            revisions, after = add_all(database, wanted, self._states)
        with self._lock:
            for label, state in after.items():
                self._states.remember(label, state)
        return revisions

    def known(self, asked: Request) -> int | None:
        """Revision that an operation got when it came before; None when it may be done.

        Raises:
            StaleError: As `append` does.
        """
        with self._reading() as database:
            return known(database, asked)

    def insert(self, logs: Iterable[Log]) -> list[Log]:
        """Add labels from elsewhere, all of them at once or none.

        Returns:
            Those on which somebody has worked already; they stay as they are.
        """
        with self._writing() as database:
            return [log for log in logs if not insert(database, log)]

    def state(self, label: int) -> State:
        """Where a label stands.

        Raises:
            LogError: Its log cannot be read.
        """
        with self._whole(label) as database:
            state = self._states.read(database, label)
            return state if state.revision else replace(state, line=last_line(database, label))

    def line(self, label: int) -> Line | None:
        """The line of a label as it was acknowledged; None where there is none.

        Raises:
            LogError: It cannot be read.
        """
        with self._reading() as database, reading_label(database, label):
            return last_line(database, label)

    def cards(self, annotator: str, number: int) -> dict[int, Card]:
        """Labels of a pass in short, by the id of their photo, for all photos."""
        fresh = self._missing_standings()
        photos = self.photos()
        with self._reading() as database:
            of_pass = labels_of_pass(database, annotator, number)
            stand = standings.kept(database, annotator, number) | fresh
            finished = standings.finished_by_others(database, annotator, number)
        return cards_of(photos, of_pass, stand, self._unreadable, finished)

    def passes(self) -> list[tuple[str, int]]:
        """Annotators and their passes, by name."""
        with self._reading() as database:
            return list(
                database.execute(
                    "SELECT DISTINCT annotator, number FROM labels"
                    " WHERE id NOT IN (SELECT label FROM set_aside) ORDER BY 1, 2"
                )
            )

    def set_aside(self) -> list[str]:
        """A sentence for each label that `repair` has set aside."""
        with self._reading() as database:
            rows = database.execute("SELECT reason FROM set_aside ORDER BY label")
            return [f"set aside: {shown(str(row[0]))}" for row in rows]

    def labels(
        self, annotator: str | None = None, number: int | None = None, photo: int | None = None
    ) -> Iterator[Label]:
        """Labels with all that is known about them, by the name of the photo.

        Labels that cannot be read are left out, and told in `unreadable`.

        Args:
            annotator: Only theirs.
            number: Only of this pass.
            photo: Only of the photo with this id.
        """
        self.unreadable = []
        with self._reading() as database:
            labels = labels_of(database, annotator, number, photo)
        for label in labels:
            try:
                state = self.state(label)
                with self._whole(label) as database:
                    found = whole_label(database, label, state)
            except LogError as error:
                self.unreadable.append(str(error))
            else:
                yield found

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
    def _whole(self, label: int) -> Iterator[sqlite3.Connection]:
        """Read a label, and remember for `cards` when it cannot be read."""
        try:
            with self._reading() as database, reading_label(database, label):
                yield database
        except LogError as error:
            self._unreadable[label] = str(error)
            raise
        self._unreadable.pop(label, None)

    @contextmanager
    def _writing(self) -> Iterator[sqlite3.Connection]:
        with self._lock, sentences(self.folder / NAME):
            self.confirm_place()
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
                self._connection.execute("COMMIT")
            except BaseException:
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")
                raise
            self.confirm_place()  # else it was kept where nobody will find it

    def confirm_place(self) -> None:
        """Make sure that the labels still lie where they were opened.

        Raises:
            StoreError: They do not, and nothing can be kept.
        """
        if self._place:
            self._place.confirm()
