"""A photo that is being labelled: its live wire and its log, which always agree."""

from __future__ import annotations

import threading
from functools import cached_property
from time import sleep

import numpy as np

from annotate.engine.edits import EditError, Edits
from annotate.engine.live_wire import LiveWire
from annotate.engine.opinions import opinions
from annotate.store.history import COMMENTED
from annotate.store.kept_states import Request, StaleError
from annotate.store.label_table import require_fit
from annotate.store.lines import Line
from annotate.store.operations import (
    Carry,
    Edit,
    Found,
    Left,
    Logged,
    MoveAnchor,
    Open,
    Operation,
    Redo,
    SetAnchor,
    SetStatus,
    SetTag,
    Undo,
)
from annotate.store.store import Photo
from annotate.work.shared_photos import SharedPhotos
from skyline_viz.arrays import F64, U8, Int
from skyline_viz.constraints import PathError
from skyline_viz.detection import Detection
from skyline_viz.method import Method
from skyline_viz.methods.registry import method_digest

_PIECE = 256  # columns whose margins are measured at a time
_YIELD = 0.001  # seconds in which another thread takes the lock


class Session:
    """A photo, open for labelling. Its methods may be called from several threads."""

    def __init__(
        self,
        photos: SharedPhotos,
        photo: Photo,
        label: int,
        detector: Method,
        *,
        blind: bool,
        keep: bool = False,
        by: str = "",
    ) -> None:
        """Read the photo, and find its proposal or what has been made of it.

        Args:
            photos: What everybody who labels the folder shares.
            photo: The photo.
            label: The label to work on.
            detector: What proposes, unless the label has begun with another one.
            blind: Whether nothing is proposed.
            keep: Whether the detection stays with the photo, see `LiveWire`.
            by: Who says what is said of it.

        Raises:
            PhotoError: The photo has vanished, or cannot be read any more.
        """
        self.photo, self.label, self.blind, self.by = photo, label, blind, by
        self.lock = threading.RLock()
        self.compared: set[tuple[int, int]] = set()
        """Neighbours, by photo and revision, whose lines were tried as a proposal."""
        store = self._store = photos.store
        self._opened = photos.opened(photo)
        self.pixels: U8 = self._opened.pixels
        begun = store.state(label).revision > 0  # before, whatever proposes now may
        self.detector = (begun and store.detector(label)) or detector
        self._proposing = photos.sharing(self.detector, self._opened)
        self.wire = LiveWire(self.pixels, None if blind else self._proposing, keep=keep)
        self.state = store.state(label)
        if self.state.revision == 0 and not blind:
            store.propose(label, self._line(), self.detector, self.wire.confidence)
            self.state = store.state(label)
        self._resume()

    @property
    def content(self) -> str:
        """What the open pixels are known by, `identity.pixel_digest`."""
        return self._opened.known

    @cached_property
    def opinions(self) -> list[Int]:
        """Rows ``(W,)`` of the lines that two other detectors find; made when first asked for."""
        return [] if self.blind else list(opinions(self.detector, self.pixels))

    @cached_property
    def proposer(self) -> str:
        """What the detector is known by: SHA-256 of its settings and of what it has learned."""
        return method_digest(self.detector)

    def detect(self) -> Detection:
        """All stages of the photo, by the detector that made its proposal."""
        return self._proposing.detect(self.pixels)

    def apply(self, operation: Operation, revision: int, id: str | None = None) -> int:  # noqa: A002
        """Do something, and keep it: when this returns, it is on the disk.

        Args:
            operation: What to do.
            revision: The revision that it was made on; -1 for any.
            id: What it is known by when it comes again; nothing is done then.

        Returns:
            The revision that it got, now or when it came first.

        Raises:
            StaleError: The photo has another revision, or the id is another operation's.
            EditError: It makes no sense for the photo.
            PathError: No line is possible then.
            PhotoError: The photo's file holds other pixels than those that are open.
            StoreError: It could not be kept. In all cases nothing has changed.
        """
        revision = -1 if isinstance(operation, Open) else revision  # to look at it needs none
        if isinstance(operation, SetStatus):
            by = self.by if operation.comment else ""  # whatever the page says
            operation = operation.model_copy(update={"by": by})
        with self.lock:
            asked = self._asked(operation, revision, id)
            kept = self._store.known(asked)
            if kept is not None:
                return kept
            self._confirm()
            if isinstance(operation, SetStatus):
                self._require_sense(operation)
            if isinstance(operation, SetTag | SetStatus | Open):
                return self._append(asked, None)
            found = self._found(operation)
            return self._edit(found.on(self.wire.edits), self._asked(found, revision, id))

    def _found(self, operation: Edit) -> Edit:
        """An operation with what it comes to on this photo as it is now."""
        if not isinstance(operation, SetAnchor | MoveAnchor):
            return operation
        lifted = operation.from_column if isinstance(operation, MoveAnchor) else None
        where = operation.column, operation.row
        row, left = self.wire.clicked(*where, operation.within, lifted)
        piece = Left(points=list(left.points), radius=left.radius) if left else None
        return operation.model_copy(update={"found": Found(row=row, left=piece)})

    def carry(self, carried: Carry) -> None:
        """Propose a line that is carried over, where the detector proposes another one.

        Nothing is done once somebody has worked on the photo, or where it is labelled blind.

        Raises:
            EditError: It lies outside the photo.
            PathError: The line of this photo does not lead along it.
            PhotoError: The photo's file holds other pixels than those that are open.
            StoreError: It could not be kept. In all cases nothing has changed.
        """
        with self.lock:
            if self.blind or self.state.revision:
                return
            edits = carried.on(self.wire.edits)
            line = self.wire.preview_guide(carried.points, carried.radius)
            if np.array_equal(line.rows, self.wire.skyline.rows):
                return
            self._confirm()
            self._edit(edits, self._asked(carried, 0, None))

    def undo(self, revision: int, id: str | None = None) -> int:  # noqa: A002
        """Take the last edit or status back; arguments, result and errors are those of `apply`."""
        return self._step(Undo(status=True), revision, id)

    def redo(self, revision: int, id: str | None = None) -> int:  # noqa: A002
        """Do again what was taken back; arguments, result and errors are those of `apply`."""
        return self._step(Redo(status=True), revision, id)

    def _confirm(self) -> None:
        """Make sure that an operation can be kept, and is of the photo that is open.

        The labels come first: where the whole folder is away, it may come back with its photos.
        """
        self._store.confirm_place()
        self._opened.confirm()

    def refresh(self) -> None:
        """Do now what the next preview would wait for."""
        with self.lock:
            self.wire.refresh()

    def margins(self) -> tuple[int, F64]:
        """The revision, and how sure its line is in each column.

        They are measured a piece at a time, and between two pieces whoever wants to change the line
        comes first.
        """
        while True:
            with self.lock:
                if not self.wire.measure(_PIECE):
                    return self.state.revision, self.wire.margin
            sleep(_YIELD)

    def _step(self, operation: Undo | Redo, revision: int, known_by: str | None) -> int:
        with self.lock:
            asked = self._asked(operation, revision, known_by)
            kept = self._store.known(asked)
            if kept is not None:
                return kept
            self._confirm()
            state = self.state
            if not (state.steps if isinstance(operation, Undo) else state.taken):
                raise EditError(f"there is nothing to {operation.kind}.")
            after = state.after(operation, 0.0, 0).edits
            if after == state.edits:  # a status: the line stays, whoever has solved it
                return self._append(asked, self._kept_line())
            return self._edit(after, asked)

    def _require_sense(self, operation: SetStatus) -> None:
        """Refuse a status that says nothing new, which undo would not find, or nothing at all."""
        words, before = operation.comment, self.state.comment
        if operation.status == self.state.status and words in ("", before.text if before else ""):
            raise EditError(f"{self.photo.name} is {operation.status} already.")
        if words and operation.status not in COMMENTED:
            raise EditError("a comment is said of a photo that needs review, or is rejected.")
        if operation.status == "accepted" and self.wire.empty:
            raise EditError(f"{self.photo.name} has no line yet, so there is nothing to accept.")

    def _edit(self, edits: Edits, asked: Request) -> int:
        before = self.wire.edits
        self.wire.edits = edits
        try:
            return self._append(asked, self._kept_line())
        except BaseException:
            self.wire.edits = before
            raise

    def _append(self, asked: Request, line: Line | None) -> int:
        """Keep an operation that fits the state which is open."""
        before = self.state
        revision = -1 if asked.kind == "open" else before.revision
        kept = self._store.append(self.label, revision, asked.kind, asked.body, line, asked.id)
        after = self._store.state(self.label)
        if after.count != before.count + 1:  # somebody else works on this label
            raise StaleError("the photo was changed elsewhere meanwhile.", after.revision)
        self.state = after
        return kept

    def _asked(self, operation: Logged, revision: int, known_by: str | None) -> Request:
        body = operation.model_dump(mode="json", by_alias=True, exclude={"kind"})
        return Request(self.label, revision, operation.kind, body, known_by)

    def _kept_line(self) -> Line | None:
        return None if self.wire.empty else self._line()

    def _line(self) -> Line:
        return Line(self.wire.skyline, self.wire.origin)

    def _resume(self) -> None:
        """Go on where the log ends, with the very line that was acknowledged."""
        state = self.state
        if not state.revision or state.line is None:
            return
        require_fit(state.line, self.photo.width)
        try:
            self.wire.edits = state.edits
            same = not self.wire.empty and self.wire.skyline == state.line.skyline
        except PathError:
            same = False
        if not same:  # solved by another version of the program: what was acknowledged holds
            rows = state.line.skyline.rows.astype(int).tolist()
            self.wire.edits = Edits(self.photo.height, self.photo.width).draw(0, rows)
            for first, last, why in state.edits.hidden:
                self.wire.hide(first, last, why=why)
