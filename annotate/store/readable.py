"""A single label that cannot be read is a sentence that names it, and hides no other label."""

from __future__ import annotations

import sqlite3
import zlib
from collections.abc import Iterator
from contextlib import contextmanager

from annotate.store.database import shown
from annotate.store.history import LogError
from annotate.store.lines import LineError
from skyline_viz.filter_bank import FilterBankError
from skyline_viz.method import MethodError

_FAULTS = (
    ValueError,
    TypeError,
    LookupError,
    ArithmeticError,
    AttributeError,
    RecursionError,
    MemoryError,
    zlib.error,
)
"""What damaged or hostile values raise, in whatever they are used."""


@contextmanager
def reading_label(database: sqlite3.Connection, label: int) -> Iterator[None]:
    """Turn whatever is wrong with a label into a sentence that names it.

    Raises:
        LogError: The label cannot be read.
    """
    try:
        yield
    except _FAULTS as error:
        raise LogError(f"{named(database, label)} cannot be read: {_reason(error)}") from error


def named(database: sqlite3.Connection, label: int) -> str:
    """A label in words: photo, annotator, pass."""
    row = database.execute(
        "SELECT name, coalesce(set_aside.annotator, labels.annotator),"
        " coalesce(set_aside.number, labels.number) FROM labels"
        " LEFT JOIN photos ON photos.id = photo LEFT JOIN set_aside ON label = labels.id"
        " WHERE labels.id = ?",
        (label,),
    ).fetchone()
    name, annotator, number = row or (None, None, None)
    return f"the label of {shown(str(name))} by {shown(str(annotator))}, pass {number},"


def _reason(error: Exception) -> str:
    if isinstance(error, LogError | LineError):
        said = shown(str(error)).rstrip(".")
    elif isinstance(error, FilterBankError | MethodError):
        said = "what proposed for it is damaged"
    else:
        said = "it is damaged"
    return f"{said}."
