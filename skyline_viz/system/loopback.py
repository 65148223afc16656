"""Who may call a server of this machine, and what its answers forbid a browser.

Both servers, the one for labelling and the one for recordings and flags, ask here. Their other
checks differ: one wants a token in a header, the other an address that nobody can guess.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from http import HTTPStatus

LOOPBACK = "127.0.0.1"
"""The only address on which anything listens."""

HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""Headers of every answer: it keeps its type, is never framed, and is for this page alone."""


def policy(scripts: str = "", images: str = "") -> str:
    """Content security policy of a page that contacts its own server and nobody else.

    Args:
        scripts: What its scripts may be besides files of the server.
        images: The same for its images.

    >>> policy(images="blob:").split("; ")[3]
    "img-src 'self' blob:"
    """
    own = "'self'"
    return "; ".join(
        [
            "default-src 'none'",
            f"script-src {own} {scripts}".rstrip(),
            f"style-src {own}",
            f"img-src {own} {images}".rstrip(),
            f"connect-src {own}",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'none'",
        ]
    )


def allowed_hosts(host: str, port: int) -> frozenset[str]:
    """Names under which a server may be called that listens on `host`.

    >>> sorted(allowed_hosts("127.0.0.1", 8000))
    ['127.0.0.1:8000', '[::1]:8000', 'localhost:8000']
    """
    names = {LOOPBACK, "localhost", "[::1]", f"[{host}]" if ":" in host else host}
    return frozenset(f"{name.lower()}:{port}" for name in names)


def why_refused(
    hosts: Sequence[str], origin: str | None, allowed: Collection[str]
) -> tuple[HTTPStatus, str] | None:
    """Status and sentence for a caller who is not answered; None for one who is.

    The name stops DNS rebinding, by which another website makes its own name point here. The
    origin stops its scripts.

    Args:
        hosts: All ``Host`` headers of the request; there must be one.
        origin: Its ``Origin`` header.
        allowed: What `allowed_hosts` gives.

    >>> why_refused(["localhost:80"], "http://localhost:80", {"localhost:80"})
    >>> why_refused(["evil.example"], None, {"localhost:80"})[1]
    'this server is not called by that name.'
    """
    if len(hosts) != 1 or hosts[0].lower() not in allowed:
        return HTTPStatus.MISDIRECTED_REQUEST, "this server is not called by that name."
    scheme, _, name = (origin or "").lower().partition("://")
    if origin is not None and (scheme != "http" or name not in allowed):
        return HTTPStatus.FORBIDDEN, "another website may not call this server."
    return None
