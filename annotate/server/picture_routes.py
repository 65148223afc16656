"""Routes of a photo's pictures. Their types are fixed, whatever the file is called."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, HTTPException, Query, Response

from annotate.server.dependencies import Bench, PhotoId, Tile
from annotate.server.photo_routes import BLIND
from annotate.work import images

router = APIRouter(prefix="/photos/{photo}", default_response_class=Response)


@router.get("/image")
def image(bench: Bench, photo: PhotoId) -> Response:
    """The whole photo, exact where it is small enough."""
    data, kind = images.view(bench.session(photo).pixels)
    return Response(data, media_type=kind)


@router.get("/thumbnail")
def thumbnail(bench: Bench, photo: PhotoId) -> Response:
    """A small picture."""
    return Response(bench.thumbnail(photo), media_type="image/jpeg")


@router.get("/tiles/{across}/{down}")
def tile(bench: Bench, photo: PhotoId, across: Tile, down: Tile) -> Response:
    """Exact pixels of a part of the photo."""
    data = images.tile(bench.session(photo).pixels, across, down)
    if data is None:
        raise HTTPException(404, "there is no such tile.")
    return Response(data, media_type="image/png")


@router.get("/stages/{stage}")
def stage(bench: Bench, photo: PhotoId, stage: str) -> Response:
    """A stage or a term of the cost, to be laid over the photo."""
    if bench.session(photo).blind:
        raise HTTPException(403, BLIND)
    detection = bench.detection(photo)
    if stage not in (known := images.overlays(detection)):
        raise HTTPException(404, f"there is no such stage; there are {', '.join(known)}.")
    return Response(images.stage(detection, stage), media_type="image/png")


@router.get("/strip")
def strip(
    bench: Bench, photo: PhotoId, width: Annotated[int, Query(ge=16, le=4096)] = 1024
) -> Response:
    """The straightened strip along the line."""
    return Response(bench.strip(photo, width), media_type="image/png")
