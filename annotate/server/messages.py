"""What the server is asked and what it answers, as JSON."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from annotate.engine.edits import ORIGINS
from annotate.engine.guide import Guide
from annotate.engine.hidden import Hidden
from annotate.engine.steering import Ground, Side, Stroke
from annotate.formats import TITLES
from annotate.store.cards import Card
from annotate.store.labels import HIDDEN_BY, NO_SKYLINE, STATUSES, TAGS, Comment, Status
from annotate.store.operations import Operation, Place, spoken
from annotate.work.choices import spans_apart
from annotate.work.images import BAND, TILE
from annotate.work.session import Session
from annotate.work.workbench import Progress
from skyline_viz.arrays import F64, Int
from skyline_viz.overlay import ALTERNATIVE, ANCHOR, HALO, PATH, css
from skyline_viz.system.memory import photo_limit

Revision = Annotated[int, Field(ge=-1, le=2**62)]
"""The revision that a request was made on; -1 for any."""


RequestId = Annotated[str, Field(pattern=r"^[A-Za-z0-9-]{1,64}$")]
"""Made by the page for each change: when it comes again, it is the same change, done once."""


class _Request(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class Apply(_Request):
    """Do an operation."""

    id: RequestId
    revision: Revision
    operation: Operation


class Step(_Request):
    """Undo or redo."""

    id: RequestId
    revision: Revision


class Pixel(_Request):
    """Where the cursor is, and which anchor it drags, if any."""

    column: Place
    row: Place
    lifted: Place | None = None
    within: Annotated[int, Field(ge=0, le=1000)] = 0
    """The anchor is the best edge no more than so many rows away; 0 for exactly here."""


class Nothing(_Request):
    """A request that says nothing but that it is one."""


class Colours(BaseModel):
    """Colours of what is drawn over a photo, as CSS writes them."""

    line: str
    """The line as it is."""

    preview: str
    """Another line: a preview, and what waits for the server."""

    anchor: str
    halo: str
    """What surrounds all of them."""


class ShownFormat(BaseModel):
    """A format in which labels leave."""

    name: str
    says: str


class Legend(BaseModel):
    """What is the same for every photo: words and colours that the page shows."""

    statuses: tuple[Status, ...]
    tags: tuple[str, ...]
    """Tags that are offered."""

    hidden_by: tuple[str, ...]
    """What may hide the line in some columns."""

    stages: dict[str, str]
    """Stages, and terms of the cost, that can be laid over a photo, and how each reads."""

    formats: tuple[ShownFormat, ...]
    colours: Colours
    tile: int
    """Side of a tile, in pixels."""

    band: int
    """Rows above and below the line in a strip."""

    @classmethod
    def made(cls, stages: dict[str, str]) -> Legend:
        """Put together what is defined elsewhere, and what can be laid over a photo."""
        return cls(
            statuses=STATUSES,
            tags=TAGS,
            hidden_by=HIDDEN_BY,
            stages=stages,
            formats=tuple(ShownFormat(name=name, says=says) for name, says in TITLES.items()),
            colours=Colours(
                line=css(PATH), preview=css(ALTERNATIVE), anchor=css(ANCHOR), halo=css(HALO)
            ),
            tile=TILE,
            band=BAND,
        )


class ShownComment(BaseModel):
    """What was said with a status, and who said it."""

    text: str
    by: str

    @classmethod
    def of(cls, comment: Comment | None) -> ShownComment | None:
        """Show a comment."""
        return cls(**vars(comment)) if comment else None


class OwnGuideline(BaseModel):
    """What a folder says of how it is to be labelled."""

    text: str | None
    """Plain text; None where the folder says nothing, and the page's own guideline holds."""


class ShownPhoto(BaseModel):
    """A photo in the list."""

    id: int
    name: str
    width: int
    height: int
    status: Status
    tags: tuple[str, ...]
    confidence: float | None
    blind: bool
    missing: bool
    too_large: bool
    """Whether it is over the limit, and will not be read."""

    seconds: float
    comment: ShownComment | None
    problem: str
    """Why its label cannot be read; empty where it can."""

    nothing_visible: bool
    """Whether a tag says that nothing of its skyline can be seen."""

    finished_by: tuple[str, ...]
    """Other passes that are done with it, whatever they found."""

    @classmethod
    def of(cls, card: Card, *, missing: bool) -> ShownPhoto:
        """Show a card."""
        photo = card.photo
        return cls(
            id=photo.id,
            name=shown_name(photo.name),
            width=photo.width,
            height=photo.height,
            status=card.status,  # type: ignore[arg-type]  # the log holds nothing else
            tags=card.tags,
            confidence=card.confidence,
            blind=card.blind,
            missing=missing,
            too_large=photo.height * photo.width > photo_limit() * 1e6,
            seconds=card.seconds,
            comment=ShownComment.of(card.comment),
            problem=card.problem,
            nothing_visible=NO_SKYLINE in card.tags,
            finished_by=tuple(map(shown_name, card.finished_by)),
        )


class ShownProgress(BaseModel):
    """How far a pass is."""

    done: int
    total: int
    seconds_a_photo: float | None
    seconds_left: float | None

    @classmethod
    def of(cls, progress: Progress) -> ShownProgress:
        """Show a progress."""
        return cls(**vars(progress))


class PhotoList(BaseModel):
    """All photos, in their order."""

    folder: str
    annotator: str
    number: int
    ahead: Status
    """Status of the photos that are to be worked on: in the consensus those that need review."""

    photos: list[ShownPhoto]
    progress: ShownProgress


class ShownSpan(BaseModel):
    """A span."""

    kind: str
    first: int
    last: int


class ShownSide(BaseModel):
    """Columns in which all above a stroke is sky, or all below it is terrain."""

    first: int
    rows: list[int]
    ground: Ground


class Document(BaseModel):
    """A photo with everything that was done to it."""

    id: int
    name: str
    width: int
    height: int
    revision: int
    status: Status
    tags: tuple[str, ...]
    blind: bool
    rows: list[int] | None
    hidden: tuple[Hidden, ...]
    """Runs of columns that are not visible: the first, the last, and what hides it."""

    nothing_visible: bool
    """Whether a tag says that nothing of the skyline can be seen, so that no column counts."""

    anchors: list[tuple[int, int]]
    spans: list[ShownSpan]
    forbidden: tuple[Stroke, ...]
    guides: list[tuple[int, int]]
    """First and last column of each guide."""

    sides: list[ShownSide]
    """Columns in which the line keeps to one side of a stroke."""

    can_undo: bool
    can_redo: bool
    undo_what: str | None
    """What undo will take back, in words: ``the anchor``, ``accepted``."""

    kept: int | None
    """The revision that the change got which this answers; None where it answers none."""

    origins: dict[str, int]
    doubtful: int | None
    """A column that a diagnosis asks to look at."""

    doubt: str
    """What the detector says of its proposal where it is no skyline, or not everywhere; nothing
    once somebody has worked on the photo."""

    carried: str
    """The photo from which the line is carried over, where nothing else was done to it."""

    comment: ShownComment | None
    """What is to be looked at, or why it is rejected."""

    apart: list[tuple[int, int]]
    """In the consensus: first and last column of spans in which passes differ, still to decide."""

    @classmethod
    def of(cls, session: Session, doubtful: int | None, kept: int | None = None) -> Document:
        """Show a session; hold its lock meanwhile."""
        wire, state, edits = session.wire, session.state, session.wire.edits
        counts = np.bincount(wire.origin, minlength=len(ORIGINS)).tolist()
        return cls(
            id=session.photo.id,
            name=shown_name(session.photo.name),
            width=session.photo.width,
            height=session.photo.height,
            revision=state.revision,
            status=state.status,
            tags=state.tags,
            blind=session.blind,
            rows=None if wire.empty else wire.skyline.rows.astype(int).tolist(),
            hidden=edits.hidden,
            nothing_visible=NO_SKYLINE in state.tags,
            anchors=sorted(edits.anchors.items()),
            spans=[ShownSpan(kind=one.kind, first=one.first, last=one.last) for one in edits.spans],
            forbidden=tuple(one for one in edits.strokes if isinstance(one, Stroke)),
            guides=[one.columns for one in edits.strokes if isinstance(one, Guide)],
            sides=[
                ShownSide(first=one.first, rows=list(one.rows), ground=one.ground)
                for one in edits.strokes
                if isinstance(one, Side)
            ],
            can_undo=bool(state.steps),
            can_redo=bool(state.taken),
            undo_what=spoken(state.steps[-1].change) if state.steps else None,
            kept=kept,
            origins=dict(zip(ORIGINS, counts, strict=True)),
            doubtful=doubtful,
            doubt=wire.doubt if state.status == "to do" and not state.carried else "",
            carried=state.carried,
            comment=ShownComment.of(state.comment),
            apart=spans_apart(state, None if wire.empty else wire.skyline),
        )


class Part(BaseModel):
    """The part of a line that differs from the current one."""

    first: int
    rows: list[int]

    @classmethod
    def of(cls, rows: Int, before: Int | None) -> Part:
        """What differs, and a column more on either side, so that it can be joined."""
        first, stop = 0, len(rows)
        if before is not None:
            changed = np.flatnonzero(rows != before)
            if len(changed) == 0:
                return cls(first=0, rows=[])
            first, stop = max(int(changed[0]) - 1, 0), int(changed[-1]) + 2
        return cls(first=first, rows=rows[first:stop].tolist())


class Margins(BaseModel):
    """How sure the line is, column by column; null where its row is fixed."""

    revision: int
    margins: list[float | None]
    uncertain: list[int]

    @classmethod
    def of(cls, revision: int, margins: F64) -> Margins:
        """Show margins, and the least certain columns, apart from each other."""
        apart = max(len(margins) // 20, 1)
        uncertain: list[int] = []
        for column in np.argsort(margins, kind="stable").tolist():
            if len(uncertain) == _MOST_UNCERTAIN or not math.isfinite(margins[column]):
                break
            if all(abs(column - one) >= apart for one in uncertain):
                uncertain.append(column)
        values = [finite(value, 4) for value in margins.tolist()]
        return cls(revision=revision, margins=values, uncertain=uncertain)


_MOST_UNCERTAIN = 20


def finite(value: float | None, digits: int = 6) -> float | None:
    """A number that JSON can hold, or None."""
    return None if value is None or not math.isfinite(value) else round(value, digits)


def shown_name(name: str) -> str:
    """A file's name as text: bytes that are no text become question marks."""
    return name.encode("utf-8", "replace").decode("utf-8")
