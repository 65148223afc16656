"""How sure a figure is that was measured on some photos: 95 % intervals.

Another forty photographs of the same kind would give other figures. An interval says how far off
these could be. It says nothing about photographs of another kind.
"""

from collections.abc import Hashable, Sequence
from math import sqrt
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

TAILS = (2.5, 97.5)
"""Percentiles of what was drawn that are the ends of an interval."""

_DEVIATIONS = 1.959964  # of a normal distribution, which hold 95 % of it
_DRAWS = 4000


class Interval(NamedTuple):
    """A range that holds the true value in 95 of 100 such measurements."""

    low: float
    """Its lower end."""

    high: float
    """Its upper end."""


def wilson(hits: int, total: int) -> Interval:
    r"""Interval of a share, by Wilson's score: it also holds for few photos, for none and for all.

    With $z$ standard deviations and the share $p$ of $n$ photos its ends are

    $$
    \frac{1}{1 + z^2 / n} \left( p + \frac{z^2}{2 n}
    \pm z \sqrt{\frac{p (1 - p)}{n} + \frac{z^2}{4 n^2}} \right)
    $$

    Args:
        hits: Photos that count.
        total: All photos, each independent of the others.

    Raises:
        ValueError: There are no photos, or fewer than hits.

    Examples:
        Of forty photos all are right: the share may still be no more than 91 %.

        >>> [round(end, 2) for end in wilson(40, 40)]
        [0.91, 1.0]
    """
    if not 0 <= hits <= total or total == 0:
        raise ValueError(f"{hits} of {total} photos is no share")
    share, spread = hits / total, _DEVIATIONS**2 / total
    middle = share + spread / 2
    reach = sqrt(spread * share * (1 - share) + spread**2 / 4)
    low, high = (middle - reach) / (1 + spread), (middle + reach) / (1 + spread)
    return Interval(low if hits else 0.0, high if hits < total else 1.0)  # exact at the ends


def resampled(
    values: npt.ArrayLike, groups: Sequence[Hashable] | None = None, seed: int = 0
) -> Interval:
    """Interval of the mean of some values, by the bootstrap: groups are drawn anew, with repeats.

    For two detectors on the same photos, give the differences of their errors. The interval is
    then that of what the one is better than the other.

    Args:
        values: ``(n,)`` one value a photo.
        groups: ``n`` of them, equal for photos that resemble each other, such as the frames of a
            clip, which are drawn together; each photo is a group of its own unless given.
        seed: Seed of the draws.

    Raises:
        ValueError: There are no values, or another number of groups.

    Examples:
        A hundred frames of two clips tell no more than two photos do.

        >>> values = [0.0] * 50 + [1.0] * 50
        >>> [round(end, 1) for end in resampled(values)]
        [0.4, 0.6]
        >>> [round(end, 1) for end in resampled(values, ["a"] * 50 + ["b"] * 50)]
        [0.0, 1.0]
    """
    drawn = means_resampled(values, groups, seed)
    low, high = np.percentile(drawn, TAILS)
    return Interval(float(low), float(high))


def means_resampled(
    values: npt.ArrayLike, groups: Sequence[Hashable] | None = None, seed: int = 0
) -> npt.NDArray[np.float64]:
    """Means of `resampled` draws, ``(draws,)``: to be added to those of another data set.

    Args:
        values: As `resampled` takes them.
        groups: Likewise.
        seed: Likewise.

    Raises:
        ValueError: There are no values, or another number of groups.
    """
    numbers = np.asarray(values, np.float64)
    named = range(len(numbers)) if groups is None else groups
    if numbers.ndim != 1 or len(numbers) == 0 or len(named) != len(numbers):
        raise ValueError(f"{len(named)} groups do not fit to values of the shape {numbers.shape}")
    places = {name: place for place, name in enumerate(dict.fromkeys(named))}
    place = np.array([places[name] for name in named])
    sums, counts = np.bincount(place, numbers), np.bincount(place)
    drawn = np.random.default_rng(seed).integers(0, len(counts), (_DRAWS, len(counts)))
    means: npt.NDArray[np.float64] = sums[drawn].sum(axis=1) / counts[drawn].sum(axis=1)
    return means
