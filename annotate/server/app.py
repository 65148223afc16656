"""The labelling server: its routes put together, and its errors in plain sentences."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import asynccontextmanager
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, JSONResponse, Response
from fastapi.staticfiles import StaticFiles
from starlette.exceptions import HTTPException

from annotate.engine.edits import EditError
from annotate.formats import FormatError
from annotate.server import folder_routes, photo_routes, picture_routes
from annotate.server.desks import Desk
from annotate.server.security import Guard
from annotate.store.database import StoreError
from annotate.store.history import LogError
from annotate.store.lines import LineError
from annotate.store.opened import BusyError
from annotate.store.store import StaleError
from annotate.work.guideline import GuidelineError
from annotate.work.shown import NoPictureError
from annotate.work.workbench import UnknownPhotoError, Workbench
from skyline_viz.constraints import PathError
from skyline_viz.method import MethodError
from skyline_viz.photo import PhotoError
from skyline_viz.viewer.program.rerun_internals import ViewerError
from skyline_viz.viewer.program.web_viewer import page_file

STATIC = Path(__file__).parents[1] / "static"
"""The page."""

_STATUSES: dict[type[Exception], int] = {
    StaleError: 409,
    PathError: 422,
    EditError: 422,
    UnknownPhotoError: 404,
    NoPictureError: 404,
    PhotoError: 410,
    BusyError: 503,
    MethodError: 422,
    FormatError: 422,
    StoreError: 507,
    LogError: 422,
    LineError: 422,
    ViewerError: 503,
    GuidelineError: 422,
}


def make_app(benches: Mapping[str, Workbench], hosts: frozenset[str]) -> Guard:
    """The server's application.

    Args:
        benches: What each person works with, by the token that the person's page has to know. All
            are of the same labels, which are closed with the server.
        hosts: Names under which the server may be called, see `hosts.names_for`.
    """

    @asynccontextmanager
    async def alive(_: FastAPI) -> AsyncIterator[None]:
        yield
        for bench in benches.values():
            bench.finish()
        for bench in benches.values():
            bench.close()

    app = FastAPI(
        title="skyline-annotate",
        lifespan=alive,
        docs_url=None,
        redoc_url=None,
        openapi_url="/api/openapi.json",
    )
    for kind, status in _STATUSES.items():
        app.add_exception_handler(kind, _sentence(status))
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(HTTPException, _refused)
    app.add_api_route("/static/stages/{name:path}", _viewer_page, include_in_schema=False)
    app.mount("/static", StaticFiles(directory=STATIC), "static")
    app.add_api_route("/", _page, include_in_schema=False)
    for routes in (folder_routes, photo_routes, picture_routes):
        app.include_router(routes.router, prefix="/api")
    return Guard(app, {token: Desk.of(bench) for token, bench in benches.items()}, hosts)


def _page() -> FileResponse:
    return FileResponse(STATIC / "index.html", media_type="text/html; charset=utf-8")


def _viewer_page(name: str) -> Response:
    found = page_file(name)
    if found is None:
        raise HTTPException(404, "there is no such file.")
    return Response(found[0], media_type=found[1])


def _sentence(status: int) -> Callable[[Request, Exception], JSONResponse]:
    def answer(_: Request, error: Exception) -> JSONResponse:
        said = str(error)
        body: dict[str, str | int] = {"detail": said if said.endswith(".") else f"{said}."}
        if isinstance(error, StaleError):
            body["revision"] = error.revision
        return JSONResponse(body, status)

    return answer


def _invalid(_: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RequestValidationError)
    first = error.errors()[0]
    place = ".".join(str(part) for part in first["loc"] if part != "body")
    said = str(first["msg"])
    return JSONResponse({"detail": f"{place or 'the request'}: {said[:1].lower()}{said[1:]}."}, 422)


def _refused(_: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, HTTPException)
    said = str(error.detail)
    sentence = said if said.endswith(".") else f"{said.lower()}."
    return JSONResponse({"detail": sentence}, error.status_code, error.headers)
