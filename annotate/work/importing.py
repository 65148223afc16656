"""Labels from elsewhere, checked as a whole before the first of them is kept.

What was done to a photo is done again, by the same rules by which the page does it. So a log that
is let in never makes a label that cannot be read.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterable
from typing import Any

import numpy as np

from annotate.engine.edits import ORIGINS, Edits
from annotate.engine.hidden import Hidden, hidden_too
from annotate.formats import FormatError, Imported
from annotate.store.database import shown
from annotate.store.history import LogError, State, folded
from annotate.store.identity import Photo
from annotate.store.label_table import Log
from annotate.store.labels import MOST_PASSES, NO_SKYLINE, check_annotator
from annotate.store.lines import Line
from skyline_viz.arrays import runs
from skyline_viz.skyline import Skyline

_LONGEST_TAG = 80  # characters
_LATEST = 1e12  # seconds; beyond it a time is none


def checked(
    one: Imported, photo: Photo, annotator: str, number: int, *, status: str, source: str
) -> Log:
    """A label that can be kept.

    A label that comes with its log keeps it. Any other, also one that was only looked at, counts as
    drawn by hand; in a column that is all sky the line cannot be seen.

    Args:
        one: What was read.
        photo: The photo that it is of.
        annotator: Whose label it is.
        number: Of which pass.
        status: Its status, where it comes without one.
        source: Where it is from, to be named.

    Raises:
        FormatError: An operation is unknown, or makes no sense for the photo.
    """
    told = one.label
    place = f"{source}: the label of {shown(photo.name)} by {shown(annotator)}, pass {number}"
    try:
        check_annotator(annotator)
        if not 1 <= number <= MOST_PASSES:
            raise ValueError(f"passes are numbered from 1 to {MOST_PASSES:,}.")
        worked_on = told is not None and any(one.get("kind") != "open" for one in told.operations)
        if told is not None and worked_on:
            line = Line(one.skyline, told.origin)
            operations = [_operation(place, said) for place, said in enumerate(told.operations, 1)]
        else:
            done = told.status if told and told.status != "to do" else status
            operations, line = _drawn(one, photo.height, done)
        rows = [(place, *operation) for place, operation in enumerate(operations, 1)]
        state = folded(State(Edits(photo.height, photo.width)), rows)
        if told is not None and worked_on and state.status != told.status:
            raise LogError(f"it says {told.status}, and its log ends with {state.status}.")
        if NO_SKYLINE in state.tags:  # the tag says so; the line is as visible as its log says
            visible = ~state.edits.hidden_mask()
            line = Line(Skyline(rows=line.skyline.rows, visible=visible), line.origin)
    except (LogError, ValueError) as error:
        raise FormatError(
            f"{place}: {shown(str(error)).rstrip('.')}; it is not imported."
        ) from error
    return Log(photo.id, annotator, number, bool(told and told.blind), operations, line)


def _operation(place: int, said: dict[str, Any]) -> tuple[float, str, str]:
    """Time, kind and JSON of an operation, whose sense is still to be checked."""
    kind, at = said.get("kind"), said.get("at", 0.0)
    if not isinstance(kind, str):
        raise LogError(f"operation {place} of the log has no kind.")
    if isinstance(at, bool) or not isinstance(at, int | float) or not abs(at) <= _LATEST:
        raise LogError(f"operation {place} of the log has no sound time.")
    body = {name: value for name, value in said.items() if name not in ("kind", "at")}
    try:
        text = json.dumps({**body, "kind": kind}, allow_nan=False)
    except (ValueError, TypeError, RecursionError) as error:
        raise LogError(f"operation {place} of the log is no plain JSON.") from error
    return float(at), kind, text


def _drawn(one: Imported, height: int, status: str) -> tuple[list[tuple[float, str, str]], Line]:
    """The log of a label that comes without one, and its line."""
    inside = np.minimum(one.skyline.rows, height - 1)
    skyline = Skyline(rows=inside, visible=one.skyline.visible & (one.skyline.rows < height))
    log: list[dict[str, Any]] = [
        {"kind": "drawn", "first": 0, "rows": inside.astype(int).tolist()},
    ]
    tags = dict.fromkeys(_plain(tag) for tag in one.tags)
    if NO_SKYLINE not in tags or skyline.visible.any():  # else the tag says it all
        log += [
            {"kind": "hidden", **span._asdict(), "why": span.why or None}
            for span in _hidden(skyline, one.hidden)
        ]
    log += [{"kind": "tag", "tag": tag, "on": True} for tag in tags if tag]
    log.append({"kind": "status", "status": status})
    origin = np.full(skyline.width, ORIGINS.index("drawn"), np.uint8)
    now = time.time()
    return [(now, said["kind"], json.dumps(said)) for said in log], Line(skyline, origin)


def _hidden(skyline: Skyline, told: Iterable[Hidden]) -> tuple[Hidden, ...]:
    """Columns in which a line is not visible, with what was told to hide them."""
    hidden = ~skyline.visible
    spans = tuple(Hidden(*run) for run in runs(hidden))
    for one in told:
        inside = np.zeros_like(hidden)
        inside[one.first : one.last + 1] = True
        for first, last in runs(hidden & inside):
            spans = hidden_too(spans, Hidden(first, last, _plain(one.why)))
    return spans


def _plain(tag: str) -> str:
    """A tag of another program as one of ours: a short line of text."""
    words = "".join(one if one.isprintable() else " " for one in tag).split()
    return " ".join(words)[:_LONGEST_TAG]
