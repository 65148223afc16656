"""Other settings by what they are worth on a whole data set.

Most photos are right, and no setting can mend anything there; it can only break something. So
photos that are wrong by blips at most wait until all settings have been tried on the others. Then
those are tried on them that are worth it, to learn what they break.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skyline_viz.diagnosis.by_cause import by_cause, over_all
from skyline_viz.diagnosis.diagnosing import Diagnosis
from skyline_viz.diagnosis.record import Diagnosed

BLIP = 8
"""Columns of the longest segment that is a blip."""

_SLIGHT = 0.25  # of the tolerance: no setting can take more from a photo whose A_err is smaller
_LEAST = 0.01  # pixels: a smaller change is none in the tables


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


def waits(a_err: float, diagnosis: Diagnosis) -> bool:
    """Whether no setting can be worth anything on a photo: it is right but for blips.

    Args:
        a_err: Its A_err, in pixels.
        diagnosis: Its diagnosis.
    """
    short = all(segment.length <= BLIP for segment in diagnosis.segments)
    return short and a_err <= _SLIGHT * diagnosis.tolerance


def worth_trying(wrong: Sequence[Diagnosed]) -> frozenset[str]:
    """Names of the settings that mended something worth it, and are tried on all other photos.

    They make the mean A_err smaller, are the best remedy of a cause, or mend a gross miss.

    Args:
        wrong: Photos that do not wait; all settings were tried on each.
    """
    helpful = {one.name for one in worths(wrong) if one.change <= -_LEAST or one.saved}
    return frozenset(helpful | {one.remedy.name for one in by_cause(wrong) if one.remedy})
