"""Who may call a server of this machine, and what its answers forbid a browser.

Both servers, the one for labelling and the one for recordings and flags, ask here. Their other
checks differ: one wants a token in a header, the other an address that nobody can guess.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from http import HTTPStatus
from ipaddress import IPv4Address, ip_address

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

_HOST = re.compile(r"(\[[0-9A-Fa-f:.]+\]|[^:\[\]/@\s]+)(?::[0-9]{1,5})?")


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


def allowed_hosts(*others: str) -> frozenset[str]:
    """Names under which a server may be called: those of loopback, and others.

    Args:
        others: More names, or addresses.

    >>> sorted(allowed_hosts("Lab-PC", "FE80:0::1"))
    ['127.0.0.1', '[::1]', '[fe80::1]', 'lab-pc', 'localhost']
    """
    return frozenset(spelled(name) for name in (LOOPBACK, "localhost", "::1", *others))


def spelled(name: str) -> str:
    """A name or an address as browsers write it.

    >>> spelled("FE80:0::1"), spelled("::ffff:10.0.0.1"), spelled("Lab-PC")
    ('[fe80::1]', '10.0.0.1', 'lab-pc')
    """
    try:
        address = ip_address(name)
    except ValueError:
        return name.lower()
    if isinstance(address, IPv4Address):
        return str(address)
    return str(address.ipv4_mapped or f"[{address}]")


def called(header: str) -> str:
    """The name in a ``Host`` header, without the port; empty where there is none.

    >>> called("LOCALHOST:80"), called("[::1]"), called("evil.example:80:80")
    ('localhost', '[::1]', '')
    """
    found = _HOST.fullmatch(header)
    return found[1].lower() if found else ""


def why_refused(
    hosts: Sequence[str], origin: str | None, allowed: Collection[str]
) -> tuple[HTTPStatus, str] | None:
    """Status and sentence for a caller who is not answered; None for one who is.

    The name stops DNS rebinding, by which another website makes its own name point here. Its port
    tells nothing: that of a tunnel is another one. The origin, which is this very name and port,
    stops the scripts of other websites.

    Args:
        hosts: All ``Host`` headers of the request; there must be one.
        origin: Its ``Origin`` header.
        allowed: What `allowed_hosts` gives.

    >>> why_refused(["localhost:80"], "http://localhost:80", allowed_hosts())
    >>> why_refused(["evil.example"], None, allowed_hosts())[1]
    'this server is not called by that name.'
    """
    if len(hosts) != 1 or called(hosts[0]) not in allowed:
        return HTTPStatus.MISDIRECTED_REQUEST, "this server is not called by that name."
    if origin is not None and origin.lower() != f"http://{hosts[0].lower()}":
        return HTTPStatus.FORBIDDEN, "another website may not call this server."
    return None
