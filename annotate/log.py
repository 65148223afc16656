"""What follows from the log of a label: which edits hold, its status, its tags, its time."""

from __future__ import annotations

import json
from collections.abc import Iterable

from annotate.operations import EDIT, Edit

IDLE_SECONDS = 60.0
"""Longer pauses between two operations on a photo count as this long."""


def cursor(log: Iterable[tuple[str, str, float]]) -> tuple[list[Edit], list[Edit]]:
    """Edits that hold and edits that were undone, the next one to redo last.

    Args:
        log: Kind, body and time of each operation, oldest first.
    """
    done: list[Edit] = []
    undone: list[Edit] = []
    for kind, body, _ in log:
        if kind == "undo" and done:
            undone.append(done.pop())
        elif kind == "redo" and undone:
            done.append(undone.pop())
        elif kind not in ("undo", "redo", "tag", "status", "open"):
            done.append(EDIT.validate_json(body))
            undone.clear()
    return done, undone


def summary(log: Iterable[tuple[str, str, float]]) -> tuple[str, tuple[str, ...], float]:
    """Status, tags and seconds that follow from a log."""
    status, edited, tags = "", False, dict[str, bool]()
    seconds, before = 0.0, None
    for kind, body, at in log:
        if before is not None and kind != "open":
            seconds += min(max(at - before, 0.0), IDLE_SECONDS)
        before = at
        if kind == "status":
            status = json.loads(body)["status"]
        elif kind == "tag":
            said = json.loads(body)
            tags.pop(said["tag"], None)
            if said["on"]:
                tags[said["tag"]] = True
        elif kind != "open":
            edited = True
            status = "" if status in ("accepted", "to do") else status
    return status or ("in progress" if edited else "to do"), tuple(tags), seconds
