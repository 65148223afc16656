"""Routes of the whole folder: its photos, its guideline, exports, learning."""

from __future__ import annotations

from fastapi import APIRouter, HTTPException, Response

from annotate.formats import FORMATS, archive
from annotate.server.dependencies import Bench, TheLearner
from annotate.server.messages import (
    Legend,
    Nothing,
    OwnGuideline,
    PhotoList,
    ShownPhoto,
    ShownProgress,
)
from annotate.store.labels import CONSENSUS
from annotate.work.guideline import own_guideline
from annotate.work.learning import Learning

router = APIRouter()


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
        ahead="needs review" if who.annotator == CONSENSUS else "to do",
        photos=[ShownPhoto.of(one, missing=not bench.store.is_here(one.photo)) for one in cards],
        progress=ShownProgress.of(bench.progress(cards)),
    )


@router.get("/guideline")
def guideline(bench: Bench) -> OwnGuideline:
    """What the folder says of how it is to be labelled."""
    return OwnGuideline(text=own_guideline(bench.store.folder))


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
