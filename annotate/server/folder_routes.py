"""Routes of the whole folder: its photos, sheets of strips, exports, learning."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, HTTPException, Query, Response

from annotate.formats import FORMATS, archive
from annotate.server.dependencies import Bench, TheLearner
from annotate.server.messages import Legend, Nothing, PhotoList, Sheet, ShownPhoto, ShownProgress
from annotate.store.cards import Card
from annotate.work.learning import Learning
from annotate.work.workbench import Workbench

router = APIRouter()

_SHEET = 24  # strips a page


@router.get("/legend")
def legend(bench: Bench) -> Legend:
    """Words and colours that are the same for every photo."""
    return Legend.made(bench.overlays())


@router.get("/photos")
def photos(bench: Bench) -> PhotoList:
    """All photos, in the order in which they are labelled."""
    who = bench.assignment
    cards = bench.cards()
    return PhotoList(
        folder=bench.store.folder.resolve().name,
        annotator=who.annotator,
        number=who.number,
        photos=_shown(bench, cards),
        progress=ShownProgress.of(bench.progress(cards)),
    )


@router.get("/sheet")
def sheet(
    bench: Bench,
    status: Annotated[str, Query(max_length=20)] = "to do",
    page: Annotated[int, Query(ge=0, le=10**6)] = 0,
) -> Sheet:
    """A page of photos with one status, or with ``all`` of them."""
    cards = [card for card in bench.cards() if status in ("all", card.status)]
    pages = max(-(-len(cards) // _SHEET), 1)
    first = min(page, pages - 1) * _SHEET
    return Sheet(photos=_shown(bench, cards[first : first + _SHEET]), pages=pages)


@router.post("/learn")
def learn(learner: TheLearner, _: Nothing) -> Learning:
    """Begin to learn from the accepted photos."""
    learner.start()
    return learner.now()


@router.get("/learn")
def learned(learner: TheLearner) -> Learning:
    """How far learning is."""
    return learner.now()


@router.get("/exports/{format}", response_class=Response)
def export(bench: Bench, format: str) -> Response:  # noqa: A002
    """All accepted labels, as a ZIP file."""
    if format not in FORMATS:
        raise HTTPException(404, f"there is no such format; there are {', '.join(FORMATS)}.")
    found = bench.joined()
    accepted = [one for one in found.labels if one.status == "accepted"]
    data = archive(accepted, bench.store.folder, format, found.contents, found.notes)
    name = f'attachment; filename="skylines-{format}.zip"'
    return Response(data, media_type="application/zip", headers={"Content-Disposition": name})


def _shown(bench: Workbench, cards: list[Card]) -> list[ShownPhoto]:
    return [ShownPhoto.of(one, missing=not bench.store.is_here(one.photo)) for one in cards]
