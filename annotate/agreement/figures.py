"""How far passes agree, in figures: of pairs of passes, of people, of photos labelled blind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np

from annotate.agreement.pairs import Comparison, Made, Pair
from skyline_viz.arrays import Int
from skyline_viz.evaluation.intervals import Interval, resampled

WITHIN = (1, 2, 5)
"""Differences, in pixels, of which the share of columns is told."""


@dataclass(frozen=True)
class Agreement:
    """How far two labels of the same photo agree, over some photos."""

    photos: int
    """Number of different photos."""

    columns: int
    """Columns that are visible in both labels."""

    mean: float
    """Mean difference of a photo, in pixels a column, each pair of labels counting alike."""

    interval: Interval
    """Where this mean lies in 95 of 100 such sets of photos: photos are drawn anew."""

    worst: float
    """Largest difference, in pixels."""

    within: tuple[float, ...]
    """Share of columns that differ by at most `WITHIN` pixels."""

    kappa: float | None
    """How far they agree on which columns are visible, see `kappa`."""

    @classmethod
    def of(cls, pairs: Sequence[Pair]) -> Agreement | None:
        """Sum up pairs; None where no column is visible in both labels of any."""
        told = [pair for pair in pairs if len(pair.differences)]
        if not told:
            return None
        every = np.concatenate([pair.apart for pair in told])
        means, photos = [pair.mean for pair in told], [pair.first.digest for pair in told]
        return cls(
            photos=len(set(photos)),
            columns=len(every),
            mean=float(np.mean(means)),
            interval=resampled(means, photos),
            worst=float(every.max()),
            within=tuple(float((every <= most).mean()) for most in WITHIN),
            kappa=kappa(np.sum([pair.seen for pair in pairs], axis=0)),
        )


@dataclass(frozen=True)
class Person:
    """How far an annotator agrees with his own other passes, and with other people."""

    name: str
    alone: Agreement | None
    """With himself; None where no photo was labelled twice."""

    others: Agreement | None
    """With others; None where nobody else has labelled a photo of his."""


def kappa(seen: Int) -> float | None:
    r"""Cohen's $\kappa$ of what is visible: 1 where two always agree, 0 as often as by chance.

    With the share $p_o$ of columns in which they agree, and $p_e$ in which they would if each had
    hidden as many columns anywhere,

    $$
    \kappa = \frac{p_o - p_e}{1 - p_e}
    $$

    Args:
        seen: ``(2, 2)`` as `Pair.seen`.

    Returns:
        None where nobody has hidden a column, or both all of them: there is nothing to agree on.

    Examples:
        >>> kappa(np.array([[10, 0], [0, 90]]))
        1.0
        >>> kappa(np.array([[1, 9], [9, 81]]))
        0.0
    """
    total = int(seen.sum())
    agree = int(np.trace(seen)) * total
    chance = int(seen.sum(axis=0, dtype=np.int64) @ seen.sum(axis=1, dtype=np.int64))
    return None if chance == total**2 else (agree - chance) / (total**2 - chance)


def people(comparisons: Sequence[Comparison]) -> list[Person]:
    """Everybody who was compared with anybody, by name."""
    names = {name for one in comparisons for name in (one.first[0], one.second[0])}
    found = []
    for name in sorted(names):
        mine = [one for one in comparisons if name in (one.first[0], one.second[0])]
        alone, others = (
            [pair for one in mine if one.of_one == own for pair in one.pairs]
            for own in (True, False)
        )
        found.append(Person(name, Agreement.of(alone), Agreement.of(others)))
    return found


def by_making(comparisons: Sequence[Comparison]) -> dict[Made, Agreement]:
    """Pairs of labels by whether they were proposed or labelled blind; kinds that there are.

    Where labels that were proposed agree better than blind ones, they share what they were offered.
    """
    pairs = [pair for one in comparisons for pair in one.pairs]
    found = {made: Agreement.of([one for one in pairs if one.made == made]) for made in KINDS}
    return {made: one for made, one in found.items() if one is not None}


def lean(comparisons: Sequence[Comparison]) -> tuple[float, Interval] | None:
    """How far proposed lines lie below blind ones of the same photo, in pixels, and its interval.

    Returns:
        Below 0 where they lie above. None where no photo was labelled both ways.
    """
    found, photos = [], []
    for pair in (pair for one in comparisons for pair in one.pairs):
        if pair.made == "one blind" and len(pair.differences):
            found.append(float(pair.differences.mean()) * (1 if pair.first.blind else -1))
            photos.append(pair.first.digest)
    return (float(np.mean(found)), resampled(found, photos)) if found else None


KINDS: tuple[Made, ...] = get_args(Made)
"""All ways in which two labels are made."""
