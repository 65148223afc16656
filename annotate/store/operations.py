"""What an annotator can do to a photo, as it is sent by the page and kept in the log.

Each operation is checked for form here (types, sizes) and for sense where it is applied, by `Edits`
and by the live wire. What undo takes back is told in the words of `spoken`.
"""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Field, Strict, TypeAdapter

from annotate.engine import steering
from annotate.engine.edits import EditError, Edits, Origin
from annotate.store.labels import LONGEST_COMMENT, LONGEST_NAME, Status

Place: TypeAlias = Annotated[int, Field(ge=-100_000, le=100_000)]
"""A row or a column; whether it lies inside the photo is checked against the photo."""

Point: TypeAlias = Annotated[tuple[Place, Place], Strict(False)]
"""Column and row; JSON knows lists only, which are no tuples to those who are strict."""

Points: TypeAlias = Annotated[list[Point], Field(min_length=1, max_length=5000)]
"""Column and row of each point of a stroke."""

Run: TypeAlias = Annotated[tuple[Origin, Annotated[int, Field(ge=1)]], Strict(False)]
"""An origin, and the number of columns that have it."""

Name: TypeAlias = Annotated[str, Field(min_length=1, max_length=LONGEST_NAME + 20)]
"""A pass by name: its annotator, and its number where that is not 1."""

Comment: TypeAlias = Annotated[
    str, Field(max_length=LONGEST_COMMENT, pattern=r"^([^\x00-\x1f\x7f]*[^\x00-\x1f\x7f\s])?$")
]
"""A short text on one line, or nothing."""

Time: TypeAlias = Annotated[int, Field(ge=0, le=2**40)]
"""Milliseconds since any moment."""


Words: TypeAlias = Annotated[str, Field(min_length=1, max_length=80, pattern=r"^[^\x00-\x1f]+$")]
"""A tag or a reason: one short line of text."""


class _Operation(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Left(_Operation):
    """The piece of the line that a click has left for another ridge, see `steering.Left`."""

    points: Points
    radius: Annotated[int, Field(ge=0, le=1000)]


class Found(_Operation):
    """What a click came to on the photo as it was."""

    row: Place
    """Row of the anchor."""

    left: Left | None = None
    """The piece of the line that was left for it."""


class _Click(_Operation):
    column: Place
    row: Place
    within: Annotated[int, Field(ge=0, le=1000)] = 0
    """The anchor is the best edge no more than so many rows away; 0 for exactly here."""

    found: Found | None = None
    """Filled in before the operation is kept, so that the log says all. Logs of before know no such
    thing: their anchors lie where they were set, and nothing was left."""

    @property
    def _row(self) -> int:
        return self.found.row if self.found else self.row

    @property
    def _left(self) -> steering.Left | None:
        left = self.found and self.found.left
        return steering.Left(tuple(left.points), left.radius, self.column) if left else None


class SetAnchor(_Click):
    """The line passes through a pixel."""

    kind: Literal["anchor"] = "anchor"

    def on(self, edits: Edits) -> Edits:
        """Edits with the anchor."""
        return edits.anchor(self.column, self._row, self._left)


class MoveAnchor(_Click):
    """An anchor is dragged."""

    kind: Literal["move"] = "move"
    from_column: Place

    def on(self, edits: Edits) -> Edits:
        """Edits with the anchor elsewhere."""
        return edits.move(self.from_column, self.column, self._row, self._left)


class RemoveAnchor(_Operation):
    """An anchor is taken away."""

    kind: Literal["remove"] = "remove"
    column: Place

    def on(self, edits: Edits) -> Edits:
        """Edits without the anchor."""
        return edits.remove(self.column)


class Forbid(_Operation):
    """A stroke of the brush, or of its eraser."""

    kind: Literal["forbid"] = "forbid"
    points: Points
    radius: Annotated[int, Field(ge=0, le=1000)]
    allow: bool = False

    def on(self, edits: Edits) -> Edits:
        """Edits with the stroke."""
        return edits.forbid(self.points, self.radius, allow=self.allow)


class _Stroke(_Operation):
    points: Points
    radius: Annotated[int, Field(ge=1, le=1000)] | None = None
    """What the hand is uncertain by, in pixels; the photo's height says it where nobody does."""


class Rough(_Stroke):
    """A rough stroke, along which the line snaps."""

    times: Annotated[list[Time], Field(max_length=5000)] = []
    """When each point was reached, in milliseconds; empty where nobody knows."""


class Guide(Rough):
    """The line lies along a rough stroke."""

    kind: Literal["guide"] = "guide"

    def on(self, edits: Edits) -> Edits:
        """Edits with the guide."""
        return edits.guide(self.points, self.radius, self.times)


class Carry(_Stroke):
    """The line of a neighbouring photo is carried over to this one, where it snaps.

    The program does so by itself, to propose: nobody has worked on the photo then.
    """

    kind: Literal["carried"] = "carried"
    name: Annotated[str, Field(min_length=1, max_length=4096)]
    """The photo from which it is, as a file below the folder."""

    def on(self, edits: Edits) -> Edits:
        """Edits with a guide along the line as it was carried over."""
        return edits.guide(self.points, self.radius)


class Side(_Operation):
    """All above a stroke is sky, or all below it is terrain: the line keeps to the other side."""

    kind: Literal["side"] = "side"
    points: Points
    ground: steering.Ground

    def on(self, edits: Edits) -> Edits:
        """Edits with the side."""
        return edits.side(self.points, self.ground)


class Straight(_Operation):
    """The line is straight between two pixels."""

    kind: Literal["straight"] = "straight"
    column: Place
    row: Place
    to_column: Place
    to_row: Place

    def on(self, edits: Edits) -> Edits:
        """Edits with the straight span."""
        return edits.straight(self.column, self.row, self.to_column, self.to_row)


class Draw(_Operation):
    """The line is drawn by hand."""

    kind: Literal["drawn"] = "drawn"
    first: Place
    rows: Annotated[list[Place], Field(min_length=1, max_length=100_000)]

    def on(self, edits: Edits) -> Edits:
        """Edits with the drawn span."""
        return edits.draw(self.first, self.rows)


class Hide(_Operation):
    """The line cannot be seen in some columns, or can be seen again."""

    kind: Literal["hidden"] = "hidden"
    first: Place
    last: Place
    hidden: bool = True
    why: Words | None = None
    """What hides it. Logs of before say it nowhere, or in a tag of the photo."""

    def on(self, edits: Edits) -> Edits:
        """Edits with the columns hidden or visible."""
        return edits.hide(self.first, self.last, hidden=self.hidden, why=self.why or "")


class Release(_Operation):
    """What was asked for in some columns is dropped."""

    kind: Literal["release"] = "release"
    first: Place
    last: Place

    def on(self, edits: Edits) -> Edits:
        """Edits without it."""
        return edits.release(self.first, self.last)


class _Rows(_Operation):
    first: Place
    rows: Annotated[list[Place], Field(min_length=1, max_length=100_000)]
    origins: Annotated[list[Run], Field(min_length=1, max_length=100_000)]
    """Where the rows are from, as the passes say it: an origin, and in how many columns."""

    hidden: Annotated[list[Point], Field(max_length=100_000)] = []
    """First and last column of each run in which the line cannot be seen."""

    of: Annotated[list[Name], Field(min_length=1, max_length=1000)]
    """The passes, by name."""

    def on(self, edits: Edits) -> Edits:
        """Edits with these rows."""
        return edits.take(self.first, self.rows, self.origins, self.hidden)


class Take(_Rows):
    """The line of another pass is taken over in some columns."""

    kind: Literal["taken"] = "taken"


class Consensus(_Rows):
    """What several passes have in common, column by column; the program does so by itself."""

    kind: Literal["consensus"] = "consensus"
    apart: Annotated[list[Point], Field(max_length=100_000)] = []
    """First and last column of each span in which they do not agree. The line there is that of the
    pass nearest to the others, until somebody has decided."""

    def on(self, edits: Edits) -> Edits:
        """Edits with these rows."""
        whole = self.first == 0 and len(self.rows) == edits.width
        if not whole or any(not 0 <= one <= other < edits.width for one, other in self.apart):
            raise EditError("a consensus is one of all columns of its photo.")
        return super().on(edits)


class SetTag(_Operation):
    """A tag is put on the photo, or taken off."""

    kind: Literal["tag"] = "tag"
    tag: Words
    on_photo: Annotated[bool, Field(alias="on")] = True


class SetStatus(_Operation):
    """The photo is accepted, rejected, or to be looked at again."""

    kind: Literal["status"] = "status"
    status: Status
    comment: Comment = ""
    """What is to be looked at, or why it is rejected, in a sentence; mostly nothing."""

    by: Annotated[str, Field(max_length=LONGEST_NAME)] = ""
    """Who says so. Filled in before the operation is kept, where there is a comment."""


class Open(_Operation):
    """The photo is shown: the clock starts."""

    kind: Literal["open"] = "open"


class Undo(_Operation):
    """What was done last is taken back."""

    kind: Literal["undo"] = "undo"
    status: bool = False
    """Whether changes of the status count, too, and an edit gives back the status that was before
    it. Logs of version 1 know no such undo: theirs takes back the last edit, and nothing else."""


class Redo(_Operation):
    """What was taken back is done again."""

    kind: Literal["redo"] = "redo"
    status: bool = False
    """Whether changes of the status count, too, as for `Undo`."""


Edit: TypeAlias = Annotated[
    SetAnchor
    | MoveAnchor
    | RemoveAnchor
    | Forbid
    | Guide
    | Side
    | Straight
    | Draw
    | Hide
    | Release
    | Take,
    Field(discriminator="kind"),
]
"""What the page does to change the line."""

Drawn: TypeAlias = Edit | Carry | Consensus
"""What changes the line, whoever does it."""

Change: TypeAlias = Drawn | SetStatus
"""What can be undone."""

Operation: TypeAlias = Annotated[Edit | SetTag | SetStatus | Open, Field(discriminator="kind")]
"""Anything that the page does to a photo, but for undo and redo."""

Logged: TypeAlias = Annotated[
    Operation | Carry | Consensus | Undo | Redo, Field(discriminator="kind")
]
"""Anything that is kept in the log."""

LOGGED: TypeAdapter[Logged] = TypeAdapter(Logged)
"""Reads an operation from the log."""

_SPOKEN = {
    "anchor": "the anchor",
    "move": "the move of the anchor",
    "remove": "the removal of the anchor",
    "forbid": "the brush stroke",
    "guide": "the guide",
    "straight": "the straight span",
    "drawn": "the drawn span",
    "hidden": "the hidden columns",
    "release": "the release of the columns",
}


def spoken(change: Change) -> str:
    """What was done, in words that follow *undo*: ``the anchor``, ``accepted``.

    >>> spoken(SetAnchor(column=3, row=4)), spoken(SetStatus(status="accepted"))
    ('the anchor', 'accepted')
    """
    match change:
        case SetStatus(status=status):
            words: str = status
        case Forbid(allow=True):
            words = "the eraser stroke"
        case Carry(name=name):
            words = f"the line carried over from {name}"
        case Take(of=of) | Consensus(of=of):
            words = f"the line of {' and '.join(of)}"
        case Side(ground=ground):
            words = "all above is sky" if ground == "sky" else "all below is terrain"
        case Hide(hidden=True, why=str(why)) if why:
            words = f"hidden by {why}"
        case Hide(hidden=False):
            words = "the columns shown again"
        case _:
            words = _SPOKEN[change.kind]
    return words
