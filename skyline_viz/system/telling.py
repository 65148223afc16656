"""How much programs tell on the way: less with ``--quiet``, more with ``--verbose``."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from enum import IntEnum


class Telling(IntEnum):
    """How much is told."""

    RESULTS = 0
    """Results, and what went wrong."""

    USUAL = 1
    """Also what was done, and how far long work is."""

    EVERYTHING = 2
    """Also each photo as it is done, and the time that all took."""


WORDS = {"--quiet": Telling.RESULTS, "--verbose": Telling.EVERYTHING}
"""The words of a command line that say so."""

_now: ContextVar[Telling] = ContextVar("telling", default=Telling.USUAL)


def telling() -> Telling:
    """How much is told now."""
    return _now.get()


@contextmanager
def told(much: Telling) -> Iterator[None]:
    """Tell so much in the block."""
    before = _now.set(much)
    try:
        yield
    finally:
        _now.reset(before)


def asked_to_tell(words: Sequence[str]) -> tuple[Telling, list[str]]:
    """How much a command line asks to be told, and its other words.

    Raises:
        ValueError: It asks for less and for more.

    >>> asked_to_tell(["detect", "a.jpg", "--quiet"])
    (<Telling.RESULTS: 0>, ['detect', 'a.jpg'])
    """
    asked = {WORDS[word] for word in words if word in WORDS}
    if len(asked) > 1:
        raise ValueError("--quiet and --verbose exclude each other.")
    others = [word for word in words if word not in WORDS]
    return next(iter(asked), Telling.USUAL), others
