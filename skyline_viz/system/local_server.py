"""A small web server for pages of our own on this machine, at an address that nobody can guess.

It listens on the loopback address, is called by one of the names of this machine, and answers
whoever knows the secret in its address; what it answers is up to its user. The standard library's
server does: there is one person at it.
"""

from __future__ import annotations

import json
import secrets
import shutil
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any, TypeAlias

from skyline_viz.system.loopback import HEADERS, LOOPBACK, allowed_hosts, why_refused

MOST_BYTES = 100_000
"""Largest body of a request."""

JSON = "application/json"


@dataclass(frozen=True)
class Request:
    """What somebody asks who knows the address."""

    name: str
    """What follows the secret in the path, without a query."""

    body: bytes | None = None
    """What is to be put there; None where something is to be read."""


@dataclass(frozen=True)
class Answer:
    """What a request is answered."""

    content: bytes | Path
    """The content, or the file that holds it."""

    kind: str = JSON
    """Its content type."""

    status: int = HTTPStatus.OK
    """HTTP status."""


Answers: TypeAlias = Callable[[Request], Answer | None]
"""Answers a request; None where there is nothing of that name. It is called from many threads."""


def told(document: Any, status: int = HTTPStatus.OK) -> Answer:  # noqa: ANN401
    """An answer in JSON."""
    return Answer(json.dumps(document).encode(), JSON, status)


def refused(status: int, sentence: str, **more: Any) -> Answer:  # noqa: ANN401
    """An answer that says in one sentence what is wrong."""
    return told({"detail": sentence, **more}, status)


@contextmanager
def served(answers: Answers, policy: str) -> Iterator[str]:
    """Serve for as long as the block lasts.

    Args:
        answers: What answers requests.
        policy: Content security policy of all answers, see `loopback.policy`.

    Yields:
        The address, which ends with a slash. Whoever does not know it is answered nothing.
    """
    with _Server(answers, policy) as server:
        thread = threading.Thread(target=server.serve_forever, name="pages", daemon=True)
        thread.start()
        try:
            yield f"http://{LOOPBACK}:{server.server_address[1]}{server.root}"
        finally:
            server.shutdown()
            thread.join()


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, answers: Answers, policy: str) -> None:
        super().__init__((LOOPBACK, 0), _Handler)
        self.answers, self.policy = answers, policy
        self.hosts = allowed_hosts()
        self.root = f"/{secrets.token_urlsafe(24)}/"

    def handle_error(self, *_: object) -> None:
        """A browser that goes away while it is answered is nothing to tell."""


class _Handler(BaseHTTPRequestHandler):
    server: _Server
    protocol_version = "HTTP/1.1"
    timeout = 60  # seconds that a silent connection is kept

    def do_GET(self) -> None:
        """Answer with what is at the address."""
        self._send(self._why_not() or self._answer(None))

    def do_PUT(self) -> None:
        """Have something changed; forms of other websites can send no such request."""
        length = self.headers.get("content-length", "")
        kind = self.headers.get("content-type", "").partition(";")[0].strip().lower()
        if answer := self._why_not():
            self.close_connection = True  # what it sent is not read
        elif kind != JSON:
            answer = refused(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, f"changes are sent as {JSON}.")
            self.close_connection = True
        elif not length.isdecimal() or int(length[:12]) > MOST_BYTES:
            too_large = f"a request holds at most {MOST_BYTES} bytes."
            answer = refused(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, too_large)
            self.close_connection = True
        else:
            answer = self._answer(self.rfile.read(int(length)))
        self._send(answer)

    def _why_not(self) -> Answer | None:
        """What is wrong with the caller; None where nothing is."""
        hosts = self.headers.get_all("host") or []
        if refusal := why_refused(hosts, self.headers.get("origin"), self.server.hosts):
            return refused(*refusal)
        known = self.path[: len(self.server.root)].encode()
        return None if secrets.compare_digest(known, self.server.root.encode()) else _NOTHING

    def _answer(self, body: bytes | None) -> Answer:
        name = self.path.partition("?")[0][len(self.server.root) :]
        return self.server.answers(Request(name, body)) or _NOTHING

    def _send(self, answer: Answer) -> None:
        if isinstance(answer.content, bytes):
            self._head(answer, len(answer.content))
            self.wfile.write(answer.content)
            return
        try:
            file = answer.content.open("rb")
        except OSError:
            self._send(refused(HTTPStatus.GONE, "the file is not there any more."))
            return
        with file:
            self._head(answer, file.seek(0, 2))
            file.seek(0)
            shutil.copyfileobj(file, self.wfile)

    def _head(self, answer: Answer, length: int) -> None:
        self.send_response(answer.status)
        for header, value in HEADERS.items():
            self.send_header(header, value)
        self.send_header("Content-Security-Policy", self.server.policy)
        self.send_header("Content-Type", answer.kind)
        self.send_header("Content-Length", str(length))
        self.end_headers()

    def version_string(self) -> str:
        """No need to tell."""
        return "skyline-viz"

    def log_message(self, *_: Any) -> None:  # noqa: ANN401
        """The address is a secret: nothing is logged."""


_NOTHING = refused(HTTPStatus.NOT_FOUND, "there is nothing at this address.")
