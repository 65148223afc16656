"""Two methods on the same photos: which is better, how surely, and on which photos."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from skyline_viz.evaluation.intervals import Interval, resampled
from skyline_viz.evaluation.results import PhotoResult

ALIKE = 0.5
"""Photos whose A_err differs by no more than this, in pixels, are neither won nor lost: a line is a
row of whole pixels, and its truth is no surer."""


@dataclass(frozen=True)
class Paired:
    """What one method is worth against another, on the photos that both have a line for.

    Examples:
        >>> from skyline_viz.skyline import Skyline
        >>> ours = [PhotoResult.of(one, Skyline([4]), Skyline([4]), 9) for one in "abc"]
        >>> theirs = [PhotoResult.of(one, Skyline([7]), Skyline([4]), 9) for one in "abc"]
        >>> found = paired("ours", ours, "theirs", theirs)
        >>> found.difference, found.interval, found.won, found.lost
        (-3.0, Interval(low=-3.0, high=-3.0), ('a', 'b', 'c'), ())
    """

    method: str
    """Name of the one."""

    other: str
    """Name of the other."""

    photos: int
    """Photos that both were tested on."""

    difference: float
    """Mean of A_err less that of the other, in pixels: less than 0 where the one is better."""

    interval: Interval
    """Its 95 % interval, of photos that are drawn anew, see `resampled`."""

    median: float
    """Median difference, in pixels."""

    won: tuple[str, ...]
    """Photos on which the one is better by more than `ALIKE`, most first."""

    lost: tuple[str, ...]
    """Photos on which it is worse by more than that, most first."""

    @property
    def sure(self) -> bool:
        """Whether the interval holds differences of one sign only."""
        return self.interval.low > 0 or self.interval.high < 0

    @property
    def said(self) -> str:
        """All of it in a sentence."""
        if not self.photos:
            return f"{self.method} and {self.other} have no photo in common."
        alike = self.photos - len(self.won) - len(self.lost)
        low, high = self.interval
        return (
            f"{self.method} less {self.other}: {self.difference:+.2f} px in the mean "
            f"(95 % interval: {low:+.2f} to {high:+.2f}), {self.median:+.2f} in the median; "
            f"better on {len(self.won)} of {self.photos} photos, worse on {len(self.lost)}, "
            f"alike within {ALIKE:g} px on {alike}."
        )


def paired(
    method: str,
    results: Sequence[PhotoResult],
    other: str,
    others: Sequence[PhotoResult],
    groups: Mapping[str, Hashable] | None = None,
    seed: int = 0,
) -> Paired:
    """Compare what two methods came to, photo by photo.

    Args:
        method: Name of the one.
        results: Its results.
        other: Name of the other.
        others: Its results; photos that only one of them has do not count.
        groups: The group of each photo by its name, see `grouped`: groups are drawn as a whole.
        seed: Seed of the draws.
    """
    theirs = {one.name: one.a_err for one in others}
    less = {one.name: one.a_err - theirs[one.name] for one in results if one.name in theirs}
    if not less:
        nothing = Interval(math.nan, math.nan)
        return Paired(method, other, 0, math.nan, nothing, math.nan, (), ())
    values = np.array([*less.values()])
    of = None if groups is None else [groups[name] for name in less]
    ordered = sorted(less, key=lambda name: (-abs(less[name]), name))
    return Paired(
        method=method,
        other=other,
        photos=len(less),
        difference=float(values.mean()),
        interval=resampled(values, of, seed),
        median=float(np.median(values)),
        won=tuple(name for name in ordered if less[name] < -ALIKE),
        lost=tuple(name for name in ordered if less[name] > ALIKE),
    )


def all_paired(
    results: Mapping[str, Sequence[PhotoResult]], groups: Mapping[str, Hashable] | None = None
) -> list[Paired]:
    """The first of several methods compared with each other one.

    Args:
        results: The results by the name of the method.
        groups: See `paired`.
    """
    names = [*results]
    return [paired(names[0], results[names[0]], one, results[one], groups) for one in names[1:]]
