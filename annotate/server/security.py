"""Who may call the server: the page that it opened, and nobody else.

- Every route checks the ``Host`` header against a list, which stops DNS rebinding.
- Everything but the code of the page needs the token, which no other website can know or send.
- Requests that change something come from this origin, and carry JSON of a limited size.
- Every answer says whose labels of which folder it is about, and a request that is meant for others
  is refused: a page that stays open may meet another server at its address.
- Nothing is kept by a browser but pictures of photos, for itself alone, and not used unasked.
- What the server sends loads nothing from elsewhere, is never framed, and keeps its type.
"""

from __future__ import annotations

import secrets
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any, TypeAlias

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import JSONResponse

from skyline_viz.system.loopback import HEADERS, policy, why_refused
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

MOST_BYTES = 2_000_000
"""Largest body of a request."""

_POLICY = policy(images="blob:")
_VIEWER = "/static/stages/"  # the page with Rerun's viewer, which is WebAssembly
_CHANGING = ("POST", "PUT", "PATCH", "DELETE")


class Guard:
    """Wraps a web application, and lets through what is allowed."""

    def __init__(self, app: App, token: str, hosts: frozenset[str], shown: str = "") -> None:
        """Guard an application.

        Args:
            app: The application.
            token: What the page has to know.
            hosts: Host names with ports under which the server may be called.
            shown: Id of the pass that the application shows.
        """
        self._app, self._token, self._hosts, self._shown = app, token, hosts, shown

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":  # a web socket, which no check below would see
            await send({"type": "websocket.close", "code": 1008})
            return

        async def sealed(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                kept = headers.get("Cache-Control")  # of pictures, which the browser may keep
                for name, value in HEADERS.items():
                    headers[name] = value
                if kept:
                    headers["Cache-Control"] = kept
                headers["Content-Security-Policy"] = _POLICY
                headers[PASS_HEADER] = self._shown
                if scope["path"].startswith(_VIEWER):
                    headers["Content-Security-Policy"] = VIEWER_POLICY
            await send(message)

        if refusal := self._refusal(scope):
            await refusal(scope, receive, sealed)
            return
        if scope["method"] not in _CHANGING:
            await self._app(scope, receive, sealed)
        elif (body := await _whole_body(receive)) is None:
            await _TOO_LARGE(scope, receive, sealed)
        else:
            await self._app(scope, _replay(body, receive), sealed)

    def _refusal(self, scope: Scope) -> JSONResponse | None:
        """What is wrong with a request; None where nothing is."""
        headers = Headers(scope=scope)
        hosts, origin = headers.getlist("host"), headers.get("origin")
        if refusal := why_refused(hosts, origin, self._hosts):
            return _no(*refusal)
        if not self._knows_token(scope, headers):
            return _no(401, "the token is missing or wrong; open the address that was printed.")
        if headers.get(PASS_HEADER, self._shown) != self._shown:
            return _no(412, "this server shows another folder, or another annotator's labels.")
        return _body_refusal(headers) if scope["method"] in _CHANGING else None

    def _knows_token(self, scope: Scope, headers: Headers) -> bool:
        if scope["path"] == "/" or scope["path"].startswith("/static/"):
            return (
                True  # code, the same for everybody; a page that is loaded again has no token yet
            )
        given = headers.get(TOKEN_HEADER, "").encode("latin-1")
        return secrets.compare_digest(given, self._token.encode())


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


def _no(status: int, detail: str) -> JSONResponse:
    return JSONResponse({"detail": detail}, status)


_TOO_LARGE = _no(413, f"a request holds at most {MOST_BYTES} bytes.")
