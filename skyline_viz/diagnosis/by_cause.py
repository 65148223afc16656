"""A diagnosed data set, cause by cause: what each costs, and what would mend it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from skyline_viz.diagnosis.causes import Cause, Place
from skyline_viz.diagnosis.diagnosing import Segment
from skyline_viz.diagnosis.record import Diagnosed
from skyline_viz.diagnosis.remedies import Remedy


@dataclass(frozen=True)
class Mended:
    """What another setting does to the photos of a cause, and to the whole data set."""

    name: str
    """See `Remedy.name`."""

    photos: int
    """Photos of the cause that it leaves no gross miss, of those that are one."""

    of: int
    """How many these are."""

    misses: int
    """Photos of all causes that are gross misses only with it."""

    change: float
    """Change of the mean A_err of the photos of the cause, in pixels."""

    broken: int
    """Segments that it breaks, in all photos."""

    change_of_all: float
    """Change of the mean A_err of all photos, in pixels."""


@dataclass(frozen=True)
class CauseSum:
    """All segments of one cause, term and place."""

    title: str
    """See `Segment.title`."""

    cause: Cause
    """The cause."""

    term: str
    """The term of the cost by which the truth loses; empty where none is named."""

    place: Place | None
    """What the photos show where it begins to."""

    photos: int
    """Photos with such a segment."""

    names: tuple[str, ...]
    """Their names, that which has most of the error first."""

    segments: int
    """How many there are."""

    columns: int
    """Their columns."""

    error: float
    """Error in their visible columns, in pixels, summed."""

    a_err: float
    """What they add to the mean A_err of the data set, in pixels."""

    remedy: Mended | None
    """The setting with the smallest mean A_err of the photos in which such a segment is the main
    one; None where none is smaller than before, or none was tried."""


def by_cause(found: Sequence[Diagnosed]) -> list[CauseSum]:
    """The causes of a data set, that which costs most first."""
    groups: dict[str, list[tuple[Diagnosed, Segment]]] = {}
    for one in found:
        for segment in one.diagnosis.segments:
            groups.setdefault(segment.title, []).append((one, segment))
    return sorted((_sum(of, found) for of in groups.values()), key=lambda one: -one.a_err)


def over_all(found: Sequence[Diagnosed]) -> Mapping[str, list[Remedy]]:
    """What each single setting that was tried on all photos does to each of them, by its name."""
    tried: dict[str, list[Remedy]] = {}
    for one in found:
        for remedy in one.remedies:
            if not remedy.pair:
                tried.setdefault(remedy.name, []).append(remedy)
    return {name: done for name, done in tried.items() if len(done) == len(found)}


def _sum(members: Sequence[tuple[Diagnosed, Segment]], found: Sequence[Diagnosed]) -> CauseSum:
    _, first = members[0]
    photos = {one.name: one for one, _ in members}
    errors = dict.fromkeys(photos, 0.0)
    for one, segment in members:
        errors[one.name] += segment.total_error
    return CauseSum(
        title=first.title,
        cause=first.cause,
        term=first.terms[0] if first.terms else "",
        place=first.place,
        photos=len(photos),
        names=tuple(sorted(photos, key=lambda name: -errors[name])),
        segments=len(members),
        columns=sum(segment.length for _, segment in members),
        error=sum(segment.total_error for _, segment in members),
        a_err=sum(segment.total_error / one.visible for one, segment in members) / len(found),
        remedy=_best([one for one in photos.values() if _main(one) == first.title], found),
    )


def _main(one: Diagnosed) -> str:
    main = one.diagnosis.main
    return main.title if main else ""


def _best(photos: Sequence[Diagnosed], found: Sequence[Diagnosed]) -> Mended | None:
    everywhere = over_all(found)
    of_these = over_all(photos)
    changes = {name: _mean(of_these[name]) for name in everywhere if name in of_these}
    name = min(changes, key=lambda one: changes[one], default="")
    if not name or changes[name] >= 0:
        return None
    gross = [one for one in photos if one.gross_miss]
    others = zip(found, everywhere[name], strict=True)
    return Mended(
        name=name,
        photos=sum(not remedy.gross_miss for remedy in over_all(gross).get(name, ())),
        of=len(gross),
        misses=sum(remedy.gross_miss and not one.gross_miss for one, remedy in others),
        change=changes[name],
        broken=sum(remedy.broken for remedy in everywhere[name]),
        change_of_all=_mean(everywhere[name]),
    )


def _mean(remedies: Sequence[Remedy]) -> float:
    return float(np.mean([one.change for one in remedies]))
