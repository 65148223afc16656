"""Routes of one photo: what was done to it, previews, and everything that changes it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

from fastapi import APIRouter, HTTPException, Query, Response

from annotate.server.alternatives import Alternatives, ShownAlternative
from annotate.server.dependencies import Bench, Column, PhotoId, Row
from annotate.server.explained import Explained
from annotate.server.messages import (
    Apply,
    Document,
    Margins,
    Part,
    Pixel,
    Step,
)
from annotate.store.operations import Rough
from annotate.store.store import StaleError
from annotate.work.carrying import carry_over
from annotate.work.choices import choices, nearest_span, spans_apart
from annotate.work.session import Session
from annotate.work.workbench import Workbench
from skyline_viz.diagnosis.explanation import explain_pixel
from skyline_viz.photo import PhotoError
from skyline_viz.viewer.program.in_memory import recorded

router = APIRouter(prefix="/photos/{photo}")

BLIND = "the photo is labelled blind, so nothing of the detector is shown."


@router.get("")
def document(bench: Bench, photo: PhotoId) -> Document:
    """A photo with everything that was done to it; the next one is prepared meanwhile.

    Where it continues a sequence, the line of its neighbour is proposed.
    """
    session = bench.session(photo)
    carry_over(bench, session)
    bench.prepare_after(photo)
    with session.lock:
        return Document.of(session, bench.doubts.get(photo))


@router.get("/margins")
def margins(bench: Bench, photo: PhotoId) -> Margins:
    """How sure the line is, column by column."""
    return Margins.of(*bench.session(photo).margins())


@router.post("/preview")
def preview(bench: Bench, photo: PhotoId, pixel: Pixel) -> Part:
    """The part of the line that an anchor would change."""
    session = bench.session(photo)
    with session.lock:
        wire = session.wire
        rows = wire.preview(pixel.column, pixel.row, pixel.lifted, pixel.within).rows.astype(int)
        return Part.of(rows, None if wire.empty else wire.skyline.rows.astype(int))


@router.post("/guide")
def guide(bench: Bench, photo: PhotoId, stroke: Rough) -> Part:
    """The part of the line that a guide along a rough stroke would change."""
    session = bench.session(photo)
    with session.lock:
        wire = session.wire
        line = wire.preview_guide(stroke.points, stroke.radius, stroke.times)
        return Part.of(line.rows.astype(int), None if wire.empty else wire.skyline.rows.astype(int))


@router.get("/alternatives")
def alternatives(
    bench: Bench, photo: PhotoId, column: Annotated[int, Query(ge=0, le=100_000)] = 0
) -> Alternatives:
    """Whole lines along other ridges: second opinions first, then the cheapest ones.

    In the consensus, where passes differ, their lines, for the span that is nearest to a column.
    """
    session = bench.session(photo)
    with session.lock:
        line = None if session.wire.empty else session.wire.skyline
        spans = spans_apart(session.state, line)
        state = session.state
    if line is not None and spans:
        labels = list(bench.store.labels(photo=photo))
        found = choices(state, labels, nearest_span(spans, column))
        return Alternatives(alternatives=[ShownAlternative.of_pass(one, line) for one in found])
    second = session.opinions
    with session.lock:
        others = session.wire.alternatives(second)
    return Alternatives(alternatives=[ShownAlternative.of(one) for one in others])


@router.post("/operations")
def operate(bench: Bench, photo: PhotoId, asked: Apply) -> Document:
    """Do something to a photo. When this is answered, it is on the disk."""
    return _change(
        bench, photo, lambda session: session.apply(asked.operation, asked.revision, asked.id)
    )


@router.post("/undo")
def undo(bench: Bench, photo: PhotoId, asked: Step) -> Document:
    """Take the last edit or status back."""
    return _change(bench, photo, lambda session: session.undo(asked.revision, asked.id))


@router.post("/redo")
def redo(bench: Bench, photo: PhotoId, asked: Step) -> Document:
    """Do again what was taken back."""
    return _change(bench, photo, lambda session: session.redo(asked.revision, asked.id))


@router.get("/recording", response_class=Response)
def recording(bench: Bench, photo: PhotoId) -> Response:
    """The stages of a photo for Rerun's viewer, with the line as it is now as truth."""
    session = bench.session(photo)
    if session.blind:
        raise HTTPException(403, BLIND)
    with session.lock:
        line = session.wire.skyline
    data = recorded(bench.detection(session), line, session.photo.name)
    return Response(data, media_type="application/octet-stream")


@router.get("/pixels/{column}/{row}")
def explain(bench: Bench, photo: PhotoId, column: Column, row: Row) -> Explained:
    """One pixel, all the way down: its edge, its filter, and what it pays for each term."""
    session = bench.session(photo)
    if session.blind:
        raise HTTPException(403, BLIND)
    try:
        return Explained.of(explain_pixel(bench.detection(session), row, column))
    except ValueError as error:
        raise HTTPException(422, str(error)) from error


def _change(bench: Workbench, photo: int, how: Callable[[Session], int]) -> Document:
    session = bench.session(photo)
    try:
        with session.lock:
            kept = how(session)
            document = Document.of(session, bench.doubts.get(photo), kept)
    except StaleError as error:
        if error.revision != session.state.revision:  # another program has changed the label
            bench.close_photo(photo)
        raise
    except PhotoError:
        bench.close_photo(photo)  # to be read again
        raise
    bench.refresh(session)
    return document
