"""Who may call the server: the pages of those who were given an address, and nobody else.

- Every route checks the ``Host`` header against a list, which stops DNS rebinding.
- Everything but the code of the page needs a token, which no other website can know or send. It
  tells, too, whose labels are meant: each person has one.
- Requests that change something come from this origin, and carry JSON of a limited size.
- Every answer says whose labels of which folder it is about, and a request that is meant for others
  is refused: a page that stays open may meet another server at its address.
- Nothing is kept by a browser but pictures of photos, for itself alone, and not used unasked.
- What the server sends loads nothing from elsewhere, is never framed, and keeps its type.
"""

from __future__ import annotations

import secrets
from collections.abc import Awaitable, Callable, Mapping, MutableMapping
from html import escape
from http import HTTPStatus
from typing import Any, TypeAlias
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import HTMLResponse, JSONResponse, Response

from annotate.server.desks import Desk
from annotate.server.hosts import arrived_at, is_name
from skyline_viz.system.loopback import HEADERS, called, policy, why_refused
from skyline_viz.viewer.program.web_viewer import POLICY as VIEWER_POLICY

Scope: TypeAlias = MutableMapping[str, Any]
Message: TypeAlias = MutableMapping[str, Any]
Receive: TypeAlias = Callable[[], Awaitable[Message]]
Send: TypeAlias = Callable[[Message], Awaitable[None]]
App: TypeAlias = Callable[[Scope, Receive, Send], Awaitable[None]]

TOKEN_HEADER = "X-Skyline-Token"  # noqa: S105  # a name, not a secret
"""Header that carries the token."""

PASS_HEADER = "X-Skyline-Pass"  # noqa: S105  # neither
"""Header that says which pass an answer is about, or a request is meant for."""

NOBODY = "nobody"
"""What that header says where an answer is about no pass."""

MOST_BYTES = 2_000_000
"""Largest body of a request."""

_POLICY = policy(images="blob:")
_VIEWER = "/static/stages/"  # the page with Rerun's viewer, which is WebAssembly
_CHANGING = ("POST", "PUT", "PATCH", "DELETE")
_NO_TOKEN = "the token is missing or wrong; open the address that was printed."  # noqa: S105
_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>skyline-annotate</title>
<h1>skyline-annotate</h1>
<p>{}</p>
</html>
"""


class Guard:
    """Wraps a web application, and lets through what is allowed.

    What the person who asks works with goes along, as ``request.state.desk``.
    """

    def __init__(self, app: App, desks: Mapping[str, Desk], hosts: frozenset[str]) -> None:
        """Guard an application.

        Args:
            app: The application.
            desks: What each person works with, by the token that the person's page has to know.
            hosts: Names under which the server may be called.
        """
        self._app, self._desks, self._hosts = app, desks, hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":  # a web socket, which no check below would see
            await send({"type": "websocket.close", "code": 1008})
            return
        headers = Headers(scope=scope)
        desk = self._desk(headers.get(TOKEN_HEADER, ""))
        shown = desk.shown if desk else self._meant(headers)

        async def sealed(message: Message) -> None:
            if message["type"] == "http.response.start":
                answered = MutableHeaders(scope=message)
                kept = answered.get("Cache-Control")  # of pictures, which the browser may keep
                for name, value in HEADERS.items():
                    answered[name] = value
                if kept:
                    answered["Cache-Control"] = kept
                answered["Content-Security-Policy"] = _POLICY
                answered[PASS_HEADER] = shown
                if scope["path"].startswith(_VIEWER):
                    answered["Content-Security-Policy"] = VIEWER_POLICY
            await send(message)

        if refusal := self._refusal(scope, headers, desk, shown):
            await refusal(scope, receive, sealed)
            return
        scope = {**scope, "state": {**scope.get("state", {}), "desk": desk}}
        if scope["method"] not in _CHANGING:
            await self._app(scope, receive, sealed)
        elif (body := await _whole_body(receive)) is None:
            await _TOO_LARGE(scope, receive, sealed)
        else:
            await self._app(scope, _replay(body, receive), sealed)

    def _refusal(
        self, scope: Scope, headers: Headers, desk: Desk | None, shown: str
    ) -> Response | None:
        """What is wrong with a request; None where nothing is."""
        hosts, origin = headers.getlist("host"), headers.get("origin")
        if refusal := why_refused(hosts, origin, self._hosts | arrived_at(scope)):
            name = called(hosts[0]) if len(hosts) == 1 else ""
            if refusal[0] == HTTPStatus.MISDIRECTED_REQUEST and is_name(name.strip("[]")):
                said = (
                    f"this server is not called {name}; --allow-host {name} lets it be called so."
                )
                return refused(headers, 421, said)
            return refused(headers, *refusal)
        if not desk and not self._needs_no_token(scope):
            return refused(headers, 401, _NO_TOKEN)
        if headers.get(PASS_HEADER, shown) != shown:
            said = "this server shows another folder, or another annotator's labels."
            return refused(headers, 412, said)
        return _body_refusal(headers) if scope["method"] in _CHANGING else None

    def _desk(self, given: str) -> Desk | None:
        """What the person works with who has a token; None where nobody has it."""
        found = None
        for token, desk in self._desks.items():  # all of them, so that the time tells nothing
            if secrets.compare_digest(given.encode(), token.encode()):
                found = desk
        return found

    def _meant(self, headers: Headers) -> str:
        """Id of the pass that somebody without a token means, if it is shown here."""
        meant = headers.get(PASS_HEADER, "")
        return meant if any(desk.shown == meant for desk in self._desks.values()) else NOBODY

    def _needs_no_token(self, scope: Scope) -> bool:
        """Whether a request is for code, the same for everybody.

        A page that is loaded again has no token yet; one that is opened with an old one is told so.
        """
        if scope["path"].startswith("/static/"):
            return True
        given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [])
        return scope["path"] == "/" and all(self._desk(one) for one in given)


def _body_refusal(headers: Headers) -> JSONResponse | None:
    kind = headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind != "application/json":
        return _no(415, "requests that change something are application/json.")
    length = headers.get("content-length", "0")
    return None if length.isdecimal() and int(length[:12]) <= MOST_BYTES else _TOO_LARGE


async def _whole_body(receive: Receive) -> bytes | None:
    """The body of a request; None as soon as it is too large, whatever its headers said."""
    body = b""
    while True:
        message = await receive()
        body += bytes(message.get("body", b""))
        if len(body) > MOST_BYTES:
            return None
        if not message.get("more_body", False):
            return body


def _replay(body: bytes, receive: Receive) -> Receive:
    """A source of messages that gives a body which has been read already."""
    given = False

    async def again() -> Message:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": body, "more_body": False}

    return again


def refused(headers: Headers, status: int, sentence: str) -> Response:
    """A refusal: a page that somebody can read who has followed a link, else JSON."""
    if "text/html" not in headers.get("accept", ""):
        return _no(status, sentence)
    said = escape(sentence[:1].upper() + sentence[1:])
    return HTMLResponse(_PAGE.format(said), status)


def _no(status: int, detail: str) -> JSONResponse:
    return JSONResponse({"detail": detail}, status)


_TOO_LARGE = _no(413, f"a request holds at most {MOST_BYTES} bytes.")
