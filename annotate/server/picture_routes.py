"""Routes of a photo's pictures. Their types are fixed, whatever the file is called.

A browser keeps them for itself, and asks each time whether they are still right: it names the tag
of what it has, and is told by status 304 that nothing has changed.
"""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, HTTPException, Query, Request, Response

from annotate.server.dependencies import Bench, PhotoId, ThePictures, Tile
from annotate.server.photo_routes import BLIND
from annotate.work.pictures import Picture

router = APIRouter(prefix="/photos/{photo}", default_response_class=Response)


@router.get("/image")
def image(request: Request, pictures: ThePictures, photo: PhotoId) -> Response:
    """The whole photo, exact where it is small enough."""
    return _shown(request, pictures.whole(photo))


@router.get("/thumbnail")
def thumbnail(request: Request, pictures: ThePictures, photo: PhotoId) -> Response:
    """A small picture."""
    return _shown(request, pictures.thumbnail(photo))


@router.get("/tiles/{across}/{down}")
def tile(
    request: Request, pictures: ThePictures, photo: PhotoId, across: Tile, down: Tile
) -> Response:
    """Exact pixels of a part of the photo."""
    return _shown(request, pictures.tile(photo, across, down))


@router.get("/stages/{stage}")
def stage(
    request: Request, bench: Bench, pictures: ThePictures, photo: PhotoId, stage: str
) -> Response:
    """A stage or a term of the cost, to be laid over the photo."""
    if bench.session(photo).blind:
        raise HTTPException(403, BLIND)
    return _shown(request, pictures.stage(photo, stage))


@router.get("/overview")
def overview(request: Request, pictures: ThePictures, photo: PhotoId) -> Response:
    """A small picture with the line on it."""
    return _shown(request, pictures.overview(photo))


@router.get("/strip")
def strip(
    request: Request,
    pictures: ThePictures,
    photo: PhotoId,
    width: Annotated[int, Query(ge=16, le=4096)] = 1024,
) -> Response:
    """The straightened strip along the line."""
    return _shown(request, pictures.strip(photo, width))


def _shown(request: Request, picture: Picture) -> Response:
    """A picture, or that the browser has it already."""
    tag = f'"{picture.tag}"'
    headers = {"ETag": tag, "Cache-Control": "private, no-cache"}
    asked = request.headers.get("if-none-match", "").split(",")
    if {tag, "*"} & {one.strip().removeprefix("W/") for one in asked}:
        return Response(status_code=304, headers=headers)
    return Response(picture.data, media_type=picture.kind, headers=headers)
