"""Rerun's viewer in a browser, on a page of our own: it contacts the server it comes from alone.

Rerun's own page fetches fonts, asks for news, and reports its use to its makers; its server answers
whoever reaches its port, under any name. So this page has the viewer's program from that server
once, and a `local_server` serves it. The labelling server serves it behind its own checks.
"""

from __future__ import annotations

import threading
import urllib.request
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from urllib.parse import urlencode

from skyline_viz.system import local_server
from skyline_viz.system.local_server import Answer, Request
from skyline_viz.system.loopback import policy
from skyline_viz.viewer.program import process as viewer
from skyline_viz.viewer.program.rerun_internals import ViewerError, check_program_for_browsers

POLICY = policy(scripts="'wasm-unsafe-eval'", images="blob: data:")
"""Content security policy of the page: the browser itself keeps it from contacting others."""

_PAGE = Path(__file__).with_name("viewer_page")
_TYPES = {
    "": "text/html; charset=utf-8",
    "style.css": "text/css; charset=utf-8",
    "start.js": "text/javascript; charset=utf-8",
    "re_viewer.js": "text/javascript; charset=utf-8",
    "re_viewer_bg.wasm": "application/wasm",
}
_PROGRAM = ("re_viewer.js", "re_viewer_bg.wasm")
_taking = threading.Lock()


def page_file(name: str) -> tuple[bytes, str] | None:
    """A file of the page and its content type; None where there is no such file.

    Args:
        name: Its name; empty for the page itself.

    Raises:
        ViewerError: The viewer's program cannot be had.
    """
    if name not in _TYPES:
        return None
    if name not in _PROGRAM:
        return (_PAGE / (name or "index.html")).read_bytes(), _TYPES[name]
    with _taking:  # once, however many ask
        return viewer_program()[name], _TYPES[name]


@cache
def viewer_program() -> dict[str, bytes]:
    """The viewer's program for browsers, 43 MB: it lies inside Rerun's program, which serves it.

    Raises:
        ViewerError: Rerun's program does not start, or does not serve it.
    """
    with viewer.web_server() as address:
        try:
            found = {}
            for name in _PROGRAM:
                with urllib.request.urlopen(f"{address}/{name}", timeout=30) as answer:  # noqa: S310
                    found[name] = answer.read()
        except OSError as error:
            raise ViewerError(f"the viewer's program cannot be fetched: {error}.") from error
    check_program_for_browsers(found["re_viewer.js"])
    return found


def fragment(recordings: Sequence[str], token: str = "") -> str:
    """What stands behind the ``#`` of the page's address.

    >>> fragment(["0.rrd"])
    'recording=0.rrd'
    """
    words = [("recording", one) for one in recordings]
    return urlencode([*words, ("token", token)] if token else words)


@contextmanager
def served(files: Sequence[Path]) -> Iterator[str]:
    """Serve recordings to a browser on this machine, for as long as the block lasts.

    Yields:
        The address to open. Whoever does not know it is answered nothing.

    Raises:
        ViewerError: The viewer's program cannot be had.
    """
    viewer_program()  # so that what is wrong with it is told here
    recordings = {f"{place}.rrd": one for place, one in enumerate(files)}

    def answer(request: Request) -> Answer | None:
        if request.body is not None:
            return None
        if request.name in recordings:
            return Answer(recordings[request.name], "application/octet-stream")
        found = page_file(request.name)
        return Answer(*found) if found else None

    with local_server.served(answer, POLICY) as address:
        yield f"{address}#{fragment(list(recordings))}"
