"""Other settings by what they are worth on a whole data set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skyline_viz.diagnosis.by_cause import over_all
from skyline_viz.diagnosis.record import Diagnosed


@dataclass(frozen=True)
class Worth:
    """What a setting does to all photos that it was tried on."""

    name: str
    """See `remedies.Remedy.name`."""

    change: float
    """Change of the mean A_err, in pixels; negative is better."""

    saved: int
    """Gross misses that are none then."""

    lost: int
    """Photos that are gross misses only then."""

    repaired: int
    """Segments that are right then."""

    broken: int
    """Segments that are wrong only then."""


def worths(found: Sequence[Diagnosed]) -> list[Worth]:
    """All settings that were tried, that first with which the mean A_err is smallest.

    Args:
        found: Photos, with what was tried on each.
    """
    before = {one.name: one.gross_miss for one in found}
    tried: list[Worth] = []
    for name, remedies in over_all(found).items():
        gross = [
            (before[one.name], remedy.gross_miss)
            for one in found
            for remedy in one.remedies
            if remedy.name == name
        ]
        tried.append(
            Worth(
                name=name,
                change=float(np.mean([one.change for one in remedies])),
                saved=sum(was and not still for was, still in gross),
                lost=sum(now and not was for was, now in gross),
                repaired=sum(one.repaired for one in remedies),
                broken=sum(one.broken for one in remedies),
            )
        )
    return sorted(tried, key=lambda one: (one.change, one.lost - one.saved, one.name))
