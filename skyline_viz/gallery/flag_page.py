"""The page in a browser on which photos of a gallery are reviewed and commented.

It is served beside the viewer by a `local_server`, at an address that nobody can guess. What it is
told is on the disk before it is answered. A change is about one photo, and names the comment that
it replaces, so two windows and the command line do not overwrite each other.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from http import HTTPStatus
from pathlib import Path
from typing import Any

from skyline_viz.gallery.documents import GalleryError
from skyline_viz.gallery.entry import Entry
from skyline_viz.gallery.flags import (
    LONGEST,
    Change,
    Flag,
    OvertakenError,
    change_flags,
    read_flags,
)
from skyline_viz.gallery.store import Gallery
from skyline_viz.running.batch import sentence
from skyline_viz.system import local_server
from skyline_viz.system.local_server import Answer, Request, refused, told
from skyline_viz.system.loopback import policy
from skyline_viz.system.names import printable, recording_id

POLICY = policy(images="data:")
"""Content security policy of the page."""

_STATIC = Path(__file__).with_name("static")
_PAGE = {
    "": ("index.html", "text/html; charset=utf-8"),
    "style.css": ("style.css", "text/css; charset=utf-8"),
    "flags.js": ("flags.js", "text/javascript; charset=utf-8"),
}
_FIELDS = {"reviewed": bool, "comment": str, "instead_of": str}


@contextmanager
def flag_page(gallery: Gallery, entries: Sequence[Entry]) -> Iterator[str]:
    """Serve the page for as long as the block lasts.

    Args:
        gallery: Its files.
        entries: Its photos, in the order in which to show them.

    Yields:
        The address to open.
    """
    with local_server.served(_Page(gallery, entries).answer, POLICY) as address:
        yield address


class _Page:
    def __init__(self, gallery: Gallery, entries: Sequence[Entry]) -> None:
        self._gallery = gallery
        self._entries = {recording_id(entry.name): entry for entry in entries}

    def answer(self, request: Request) -> Answer | None:
        """Answer a request; errors are sentences."""
        try:
            if request.body is not None:
                return self._change(request.name, request.body)
            return self._read(request.name)
        except OvertakenError as error:
            return refused(HTTPStatus.CONFLICT, sentence(error), now=asdict(error.flag))
        except GalleryError as error:
            return refused(HTTPStatus.UNPROCESSABLE_ENTITY, sentence(error))
        except OSError as error:
            return refused(HTTPStatus.INSUFFICIENT_STORAGE, f"{sentence(error)}.")

    def _read(self, name: str) -> Answer | None:
        if name in _PAGE:
            file, kind = _PAGE[name]
            return Answer((_STATIC / file).read_bytes(), kind)
        if name == "photos":
            return told(self._photos())
        folder, _, file = name.partition("/")
        entry = self._entries.get(file.removesuffix(".jpg"))
        if folder != "thumbnails" or entry is None:
            return None
        return Answer(self._gallery.thumbnail(entry.name), "image/jpeg")

    def _photos(self) -> dict[str, Any]:
        flags = read_flags(self._gallery.folder)
        photos = []
        for place, entry in self._entries.items():
            verdict, details = about(entry)
            flag = asdict(flags.get(entry.name, Flag()))
            name = printable(entry.name)
            photos.append(
                {"id": place, "name": name, "verdict": verdict, "details": details, "flag": flag}
            )
        return {
            "folder": printable(str(self._gallery.folder)),
            "longest": LONGEST,
            "photos": photos,
        }

    def _change(self, name: str, body: bytes) -> Answer | None:
        folder, _, place = name.partition("/")
        entry = self._entries.get(place)
        if folder != "flags" or entry is None:
            return None
        try:
            given = json.loads(body)
        except (ValueError, RecursionError):  # of text, or of JSON
            given = None
        if not _is_change(given):
            return refused(HTTPStatus.BAD_REQUEST, "this is no change of a flag.")
        flags = change_flags(self._gallery.folder, {entry.name: Change(**given)})
        return told(asdict(flags.get(entry.name, Flag())))


def about(entry: Entry) -> tuple[str, str]:
    """What a photo's detection came to, in two lines: the verdict with its causes, and details."""
    verdict, details = [], []
    if entry.difference is not None:
        verdict.append(f"{entry.difference:.2f} px from {printable(entry.compared)}")
        if entry.change is not None:
            verdict.append(f"A_err {entry.change:+.2f} px by it")
    if entry.shows not in (None, "skyline"):
        verdict.append(str(entry.shows))
    if entry.verdict.a_err is not None:
        verdict += [f"A_err {entry.verdict.a_err:.2f} px", *(entry.causes or ())]
        details.append(f"wrong {entry.wrong}" if entry.wrong else "no column wrong")
    if entry.parts_at:
        turned = f", turned by {printable(entry.turned_by)}" if entry.turned_by else ""
        details.append(f"part at {printable(entry.parts_at)}{turned}")
    details.append(f"margin {entry.verdict.margin:.2f} at {entry.verdict.unsure_column}")
    details.append(f"by {printable(entry.method)}")
    return " · ".join(verdict), " · ".join(details)


def _is_change(given: object) -> bool:
    return (
        isinstance(given, dict)
        and bool(given)
        and all(key in _FIELDS and type(value) is _FIELDS[key] for key, value in given.items())
    )
