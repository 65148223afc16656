"""What copies of a storage are called: by their addresses, in all that is said to people."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path, PurePosixPath

from skyline_viz.storage.parts import file_part

_SAID_OF = r"((?:[/\\][^\s:,;\"]*[^\s:,;.\"])?)"  # a path below, without what ends a sentence

_copies: dict[str, str] = {}


def name_of(address: str) -> str:
    """The last name in an address: what a copy of it is called.

    >>> name_of("s3://datasets/hills"), name_of("zip://::s3://datasets/hills.zip")
    ('hills', 'hills')
    >>> name_of("https://host/eiger.jpg?raw=1")
    'eiger.jpg'
    """
    inner, _, around = address.partition("::")
    below = inner.partition("//")[2]
    whole = PurePosixPath(file_part(inner if below else around))
    name = whole.name if below else whole.stem
    return name or "photos"


def remember(copy: Path, address: str) -> None:
    """Let `by_address` know of a copy, until the next command of this process."""
    _copies[str(copy)] = address


def forget() -> None:
    """Forget the copies of an earlier command of this process."""
    _copies.clear()


def has_copies() -> bool:
    """Whether this command has made a copy, or brought one up to date."""
    return bool(_copies)


def by_address(text: str) -> str:
    """A sentence in which copies are called by their addresses.

    >>> remember(Path("/caches/1f/hills"), "zip://::hills.zip")
    >>> by_address("/caches/1f/hills/images/a.jpg is empty.")
    'zip://images/a.jpg::hills.zip is empty.'
    """
    for copy, address in _copies.items():
        if copy in text:
            named = partial(_below, address)
            text = re.sub(re.escape(copy) + _SAID_OF, named, text)
    return text


def _below(address: str, match: re.Match[str]) -> str:
    """The address of a path below the one that a copy was made of."""
    inner, chain, around = address.partition("::")
    own = match[1].replace("\\", "/").strip("/")
    gap = "/" if own and not inner.endswith("/") else ""
    return f"{inner}{gap}{own}{chain}{around}"
