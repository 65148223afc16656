"""A photo that is being labelled: its live wire and its log, which always agree."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from annotate.edits import Edits
from annotate.lines import Line
from annotate.live_wire import LiveWire
from annotate.operations import Edit, Open, Operation, SetStatus, SetTag
from annotate.store import Photo, StaleError, Store
from skyline_viz.arrays import U8
from skyline_viz.constraints import PathError
from skyline_viz.methods.protocol import Method
from skyline_viz.notes import note
from skyline_viz.photo import PhotoError, read_photo_with_notes
from skyline_viz.verdict import Verdict


class Session:
    """A photo, open for labelling. Its methods may be called from several threads."""

    def __init__(
        self, store: Store, photo: Photo, label: int, detector: Method, *, blind: bool
    ) -> None:
        """Read the photo, and find its proposal or what has been made of it.

        Args:
            store: Where labels are kept.
            photo: The photo.
            label: The label to work on.
            detector: What proposes, unless the label has begun with another one.
            blind: Whether nothing is proposed.

        Raises:
            PhotoError: The photo has vanished, or cannot be read any more.
        """
        self.photo, self.label, self.blind = photo, label, blind
        self.lock = threading.RLock()
        self._store = store
        self.pixels: U8 = read_whole(store.folder, photo)
        kept = store.detector(label)
        self.detector = kept if kept and store.state(label).revision else detector
        self.wire = LiveWire(self.pixels, None if blind else self.detector)
        self.state = store.state(label)
        if self.state.revision == 0 and not blind:
            margin = Verdict.of(self.wire.skyline, self.wire.margin, photo.height, None).margin
            store.propose(label, self._line(), self.detector, margin)
            self.state = store.state(label)
        self._resume()

    def apply(self, operation: Operation, revision: int) -> None:
        """Do something, and keep it: when this returns, it is on the disk.

        Raises:
            StaleError: The photo has another revision.
            EditError: It makes no sense for the photo.
            PathError: No line is possible then.
            StoreError: It could not be kept. In all cases nothing has changed.
        """
        body = operation.model_dump(mode="json", by_alias=True, exclude={"kind"})
        with self.lock:
            self._require(revision)
            if isinstance(operation, SetTag | SetStatus | Open):
                self._append(operation.kind, body, None)
            else:
                self._edit(operation.on(self.wire.edits), operation.kind, body)

    def undo(self, revision: int) -> None:
        """Take the last edit back; raises as `apply` does."""
        self._step("undo", revision)

    def redo(self, revision: int) -> None:
        """Do again what was taken back; raises as `apply` does."""
        self._step("redo", revision)

    def refresh(self) -> None:
        """Do now what the next preview would wait for."""
        with self.lock:
            self.wire.refresh()

    def _step(self, kind: str, revision: int) -> None:
        with self.lock:
            self._require(revision)
            done, undone = self.state.done, self.state.undone
            if not (done if kind == "undo" else undone):
                raise StaleError(f"there is nothing to {kind}.")
            done = done[:-1] if kind == "undo" else (*done, undone[-1])
            self._edit(folded(done, self.wire), kind, {})

    def _edit(self, edits: Edits, kind: str, body: dict[str, Any]) -> None:
        before = self.wire.edits
        self.wire.edits = edits
        try:
            self._append(kind, body, None if self.wire.empty else self._line())
        except BaseException:
            self.wire.edits = before
            raise

    def _append(self, kind: str, body: dict[str, Any], line: Line | None) -> None:
        revision = -1 if kind == "open" else self.state.revision
        self._store.append(self.label, revision, kind, body, line)
        self.state = self._store.state(self.label)

    def _require(self, revision: int) -> None:
        if revision not in (-1, self.state.revision):
            raise StaleError("the photo was changed in another tab, and is shown as it is now.")

    def _line(self) -> Line:
        return Line(self.wire.skyline, self.wire.origin)

    def _resume(self) -> None:
        """Go on where the log ends, with the very line that was acknowledged."""
        state = self.state
        if not state.revision or state.line is None:
            return
        try:
            self.wire.edits = state.edits
            same = not self.wire.empty and self.wire.skyline == state.line.skyline
        except PathError:
            same = False
        if not same:  # solved by another version of the program: what was acknowledged holds
            rows = state.line.skyline.rows.astype(int).tolist()
            self.wire.edits = Edits(self.photo.height, self.photo.width).draw(0, rows)
            for first, last in state.edits.hidden:
                self.wire.hide(first, last)


def folded(done: Iterable[Edit], wire: LiveWire) -> Edits:
    """Edits that hold after some operations."""
    edits = Edits(wire.height, wire.width)
    for edit in done:
        edits = edit.on(edits)
    return edits


def read_whole(folder: Path, photo: Photo) -> U8:
    """Read a photo, and make sure that it is still the one that was labelled.

    Raises:
        PhotoError: It has vanished, cannot be read, or has another size.
    """
    pixels, notes = read_photo_with_notes(folder / photo.name)
    for one in notes:
        note(one)
    if pixels.shape[:2] != (photo.height, photo.width):
        raise PhotoError(
            f"{photo.name} is another photo now: it was {photo.width}x{photo.height} pixels, and "
            f"is {pixels.shape[1]}x{pixels.shape[0]}."
        )
    return pixels
