"""Labels of files with the same content: these are one photo, which gets one label."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from annotate.formats.common import Imported
from annotate.formats.importing import Found
from annotate.formats.rivals import difference
from skyline_viz.system.names import listed


def unite_copies(found: Found, copies: Mapping[str, str]) -> None:
    """Keep one label of each photo whose copies have labels, too, and say so.

    Args:
        found: The labels, each with the name that it came for.
        copies: The photo of each name that is another one of it.
    """
    first: dict[str, Imported] = {}
    others: dict[str, list[str]] = {}
    labels = []
    for one in sorted(found.labels, key=lambda one: one.name in copies):  # its own name first
        photo = copies.get(one.name)
        if photo is None:
            first.setdefault(one.name, one)
            labels.append(one)
            continue
        others.setdefault(photo, []).append(one.name)
        kept = first.setdefault(photo, one)
        if kept is one:
            labels.append(replace(one, name=photo))
        elif apart := difference(kept.skyline, one.skyline):
            found.problem(
                f"{one.name} is the same photo as {photo}, and their labels {apart}; that of "
                f"{kept.name} is kept."
            )
    for photo, names in others.items():
        be = "is" if len(names) == 1 else "are"
        found.note(f"{listed(names)} {be} the same photo as {photo}, and one label of it is kept")
    found.labels[:] = labels
