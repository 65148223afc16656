"""Saying which labels belong to photos that are not there."""

from __future__ import annotations

from collections.abc import Sequence

from annotate.store.identity import short
from annotate.store.labels import Label
from skyline_viz.system.names import shortened

_NAMED = 5  # labels that a sentence names


def gone(orphans: Sequence[Label], where: str = "here any more") -> list[str]:
    """A sentence that names labels whose photo is not there; none where there are none."""
    if not orphans:
        return []
    names = [
        f"{shortened(one.name)} ({short(one.digest or one.pixels)})" for one in orphans[:_NAMED]
    ]
    if more := len(orphans) - len(names):
        names.append(f"and {more} more")
    if len(orphans) == 1:
        return [f"1 label belongs to a photo that is not {where}: {names[0]}."]
    return [f"{len(orphans)} labels belong to photos that are not {where}: {', '.join(names)}."]
