"""Two detectors over a data set: which photos got better and which worse, and what turned them.

The second detector is measured by the first. A photo is *better* or *worse* where A_err changes by
more than `parting.LEVEL`, and *level* else.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from rich.table import Table

from skyline_viz.diagnosis.parting import LEVEL
from skyline_viz.evaluation.intervals import Interval, resampled
from skyline_viz.evaluation.metrics import scaled
from skyline_viz.evaluation.terminal import drawn
from skyline_viz.gallery.entry import Entry
from skyline_viz.system.names import cell, printable

Outcome: TypeAlias = Literal["better", "worse", "level"]
"""What became of a photo."""

_WIDTH = 120  # columns of a table
_LISTED = 5  # photos that got better, and worse, at the most


@dataclass(frozen=True)
class Group:
    """Photos whose path was turned by one term."""

    turned_by: str
    """The term; nothing where the lines are not apart, or nobody can tell."""

    better: int
    """Photos that got better."""

    worse: int
    """Photos that got worse."""

    level: int
    """Photos that did neither."""

    change: float
    """By how much A_err of these photos grew in all, in pixels: their share of what changed."""


@dataclass(frozen=True)
class BetterWorse:
    """What a second detector changes on the photos with a truth."""

    first: str
    """Name of the first detector."""

    second: str
    """Name of the second."""

    better: int
    """Photos that got better."""

    worse: int
    """Photos that got worse."""

    level: int
    """Photos that did neither."""

    change: float
    """Mean change of A_err in pixels; below 0 the second detector is better."""

    interval: Interval
    """Its 95 % interval: other photos of the kind would give another one."""

    groups: tuple[Group, ...]
    """The photos by what turned them, those first on which most changed, for better or worse."""

    @property
    def said(self) -> str:
        """All of it in a sentence."""
        low, high = self.interval
        return (
            f"{printable(self.second)} against {printable(self.first)}: won {self.better}, lost "
            f"{self.worse}, level {self.level}; A_err {self.change:+.2f} px in the mean "
            f"(95 % interval: {low:+.2f} to {high:+.2f})"
        )


def outcome(entry: Entry) -> Outcome | None:
    """What became of a photo; None without a truth or a second detector."""
    if entry.change is None:
        return None
    if abs(entry.change) <= scaled(LEVEL, entry.height):
        return "level"
    return "worse" if entry.change > 0 else "better"


def better_worse(entries: Sequence[Entry]) -> BetterWorse | None:
    """Sum up what a second detector changes; None where there is none, or no photo has a truth.

    Args:
        entries: The photos of a gallery.
    """
    known = [one for one in entries if one.change is not None]
    if not known:
        return None
    groups = [_group(term, known) for term in dict.fromkeys(one.turned_by for one in known)]
    groups.sort(key=lambda one: (not one.turned_by, -(one.better + one.worse), one.change))
    changes = _changes(known)
    return BetterWorse(
        known[0].method,
        known[0].compared,
        *_counts(known),
        float(np.mean(changes)),
        resampled(changes),
        tuple(groups),
    )


def tables(entries: Sequence[Entry]) -> str:
    """What changed as text: the sentence, a table by what turned the path, and one of photos.

    Args:
        entries: The photos of a gallery; nothing is said where `better_worse` is None.
    """
    found = better_worse(entries)
    if found is None:
        return ""
    lines = [found.said]
    rows = [
        (
            one.turned_by or "-",
            f"{one.better}",
            f"{one.worse}",
            f"{one.level}",
            f"{one.change:+.2f}",
        )
        for one in found.groups
    ]
    lines.append(_drawn(("turned by", "better", "worse", "level", "A_err in all (px)"), rows))
    known = sorted(
        (one for one in entries if outcome(one) in ("better", "worse")),
        key=lambda one: one.change or 0.0,
    )
    few = len(known) <= 2 * _LISTED
    listed = known if few else [*known[:_LISTED], *known[-_LISTED:]]
    if listed:
        head = ("photo", found.first, found.second, "change (px)", "part at", "turned by")
        lines.append(_drawn(head, [_row(one) for one in listed]))
    if not few:
        lines.append(f"{len(known) - len(listed)} more between these.")
    return "\n".join(lines)


def _row(one: Entry) -> tuple[str, ...]:
    return (
        one.name,
        f"{one.verdict.a_err:.2f}",
        f"{one.other_a_err:.2f}",
        f"{one.change:+.2f}",
        one.parts_at,
        one.turned_by,
    )


def _group(term: str, known: Sequence[Entry]) -> Group:
    mine = [one for one in known if one.turned_by == term]
    return Group(term, *_counts(mine), sum(_changes(mine)))


def _counts(entries: Sequence[Entry]) -> tuple[int, int, int]:
    """How many got better, worse, and neither."""
    all_of_them = [outcome(one) for one in entries]
    return all_of_them.count("better"), all_of_them.count("worse"), all_of_them.count("level")


def _changes(entries: Sequence[Entry]) -> list[float]:
    return [one.change for one in entries if one.change is not None]


def _drawn(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    table = Table(box=None, pad_edge=False, header_style="bold")
    for place, heading in enumerate(head):
        right = 0 < place < len(head) and heading not in ("part at", "turned by")
        table.add_column(cell(heading), justify="right" if right else "left", overflow="fold")
    for row in rows:
        table.add_row(*map(cell, row))
    return drawn(table, _WIDTH)
