"""Columns in which the line cannot be seen, each run with what hides it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple


class Hidden(NamedTuple):
    """A run of columns in which the line cannot be seen."""

    first: int
    """Its first column."""

    last: int
    """Its last column."""

    why: str = ""
    """What hides it, in a word or two; empty where nobody has said it."""


def hidden_too(spans: Iterable[Hidden], span: Hidden) -> tuple[Hidden, ...]:
    """Runs from left to right with one more, which counts where it meets others.

    Neighbours that are hidden by the same are one run.

    >>> hidden_too([Hidden(2, 9, "fog")], Hidden(5, 6, "cloud"))
    (Hidden(first=2, last=4, why='fog'), Hidden(first=5, last=6, why='cloud'), \
Hidden(first=7, last=9, why='fog'))
    >>> hidden_too([Hidden(2, 4, "fog")], Hidden(5, 6, "fog"))
    (Hidden(first=2, last=6, why='fog'),)
    """
    found: list[Hidden] = []
    for one in sorted([*shown_again(spans, span.first, span.last), span]):
        before = found[-1] if found else None
        if before and before.why == one.why and before.last + 1 == one.first:
            found[-1] = before._replace(last=one.last)
        else:
            found.append(one)
    return tuple(found)


def shown_again(spans: Iterable[Hidden], first: int, last: int) -> tuple[Hidden, ...]:
    """What is left of runs when the columns from `first` to `last` can be seen.

    >>> shown_again([Hidden(2, 9, "fog")], 0, 5)
    (Hidden(first=6, last=9, why='fog'),)
    """
    parts = (
        part
        for one in spans
        for part in (
            one._replace(last=min(one.last, first - 1)),
            one._replace(first=max(one.first, last + 1)),
        )
    )
    return tuple(part for part in parts if part.first <= part.last)
