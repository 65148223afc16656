"""Rerun's viewer in a browser, on a page of our own: it contacts the server it comes from alone.

Rerun's own page fetches fonts, asks for news, and reports its use to its makers; its server answers
whoever reaches its port, under any name. So this page has the viewer's program from that server
once, and `RecordingServer` is called by one of the names of this machine, at an address that nobody
can guess. The labelling server serves the same page behind its own checks.
"""

from __future__ import annotations

import contextlib
import json
import secrets
import shutil
import threading
import urllib.request
from collections.abc import Iterator, Sequence
from functools import cache
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any, BinaryIO
from urllib.parse import urlencode

from skyline_viz.viewer import process as viewer
from skyline_viz.viewer.process import LOOPBACK, ViewerError

POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; "
    "img-src 'self' blob: data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)
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
_HEADERS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
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
    return found


def fragment(recordings: Sequence[str], token: str = "") -> str:
    """What stands behind the ``#`` of the page's address.

    >>> fragment(["0.rrd"])
    'recording=0.rrd'
    """
    words = [("recording", one) for one in recordings]
    return urlencode([*words, ("token", token)] if token else words)


@contextlib.contextmanager
def served(files: Sequence[Path]) -> Iterator[str]:
    """Serve recordings to a browser on this machine, for as long as the block lasts.

    Yields:
        The address to open. Whoever does not know it is answered nothing.

    Raises:
        ViewerError: The viewer's program cannot be had.
    """
    viewer_program()  # so that what is wrong with it is told here
    with _RecordingServer(files) as server:
        thread = threading.Thread(target=server.serve_forever, name="recordings", daemon=True)
        thread.start()
        try:
            yield server.address
        finally:
            server.shutdown()
            thread.join()


class _RecordingServer(ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, files: Sequence[Path]) -> None:
        super().__init__((LOOPBACK, 0), _Handler)
        port = self.server_address[1]
        self.hosts = {f"{name}:{port}" for name in (LOOPBACK, "localhost", "[::1]")}
        self.origins = {f"http://{host}" for host in self.hosts}
        self.root = f"/{secrets.token_urlsafe(24)}/"
        self.recordings = {f"{place}.rrd": one for place, one in enumerate(files)}
        self.address = f"http://{LOOPBACK}:{port}{self.root}#{fragment(list(self.recordings))}"

    def handle_error(self, *_: object) -> None:
        """A browser that goes away while it is answered is nothing to tell."""


class _Handler(BaseHTTPRequestHandler):
    server: _RecordingServer
    protocol_version = "HTTP/1.1"
    timeout = 60  # seconds that a silent connection is kept

    def do_GET(self) -> None:
        """Answer with a file of the page, or a recording."""
        hosts = self.headers.get_all("host") or []
        origin = self.headers.get("origin")
        if len(hosts) != 1 or hosts[0].lower() not in self.server.hosts:
            self._refuse(HTTPStatus.MISDIRECTED_REQUEST, "this server is not called by that name.")
        elif origin is not None and origin.lower() not in self.server.origins:
            self._refuse(HTTPStatus.FORBIDDEN, "another website may not call this server.")
        else:
            self._answer(self.path.partition("?")[0])

    def _answer(self, path: str) -> None:
        known = secrets.compare_digest(path[: len(self.server.root)].encode(), self._root)
        name = path[len(self.server.root) :]
        if known and name in self.server.recordings:
            try:
                with self.server.recordings[name].open("rb") as file:
                    self._send(file, file.seek(0, 2), "application/octet-stream")
            except OSError:
                self._refuse(HTTPStatus.GONE, "the recording is not there any more.")
        elif known and (found := page_file(name)):
            self._send(found[0], len(found[0]), found[1])
        else:
            self._refuse(HTTPStatus.NOT_FOUND, "there is nothing at this address.")

    @property
    def _root(self) -> bytes:
        return self.server.root.encode()

    def _send(self, content: bytes | BinaryIO, length: int, kind: str, status: int = 200) -> None:
        self.send_response(status)
        for header, value in _HEADERS.items():
            self.send_header(header, value)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(length))
        self.end_headers()
        if isinstance(content, bytes):
            self.wfile.write(content)
        else:
            content.seek(0)
            shutil.copyfileobj(content, self.wfile)

    def _refuse(self, status: HTTPStatus, detail: str) -> None:
        said = json.dumps({"detail": detail}).encode()
        self._send(said, len(said), "application/json", status)

    def version_string(self) -> str:
        """No need to tell."""
        return "skyline-viz"

    def log_message(self, *_: Any) -> None:  # noqa: ANN401
        """The address is a secret: nothing is logged."""
