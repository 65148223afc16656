"""Which photos a sky model learns from, where there are more than it can see.

A step sees `BATCH` photos, so that with millions of photos most of those that were read would never
be drawn. The photos are chosen before any is read, one for each place in a batch. As photos are
drawn with replacement, 63 % of so many come to a place of their own, and up to 97 % at least into a
photo that is put together. A data set of which a part is read is drawn as often as the whole of it
would be.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from typing import TypeVar

import numpy as np

from skyline_viz.sky_training.sizes import BATCH

Photo = TypeVar("Photo")


@dataclass(frozen=True)
class Part:
    """How many photos of a data set are read."""

    read: int
    """Those that are."""

    of: int
    """All of them."""

    @property
    def weight(self) -> float:
        """How many photos each that is read stands for; 1 where all are read."""
        return self.of / self.read


WHOLE = Part(1, 1)
"""Any data set that is read as a whole."""


def most_photos(steps: int) -> int:
    """How many photos are read at the most for so many steps.

    >>> most_photos(6000)
    96000
    """
    return steps * BATCH


def parts(counts: Mapping[str, int], most: int) -> dict[str, Part]:
    """How many photos of each data set are read.

    All of them, where there are no more than the most. Otherwise data sets share these by the
    square root of their number of photos, as they share the places in batches; what a small one
    cannot use the others have.

    Args:
        counts: Photos of each data set, by its name.
        most: Photos to read at the most, but for one of each data set.

    Examples:
        >>> {name: part.read for name, part in parts({"few": 4, "many": 900}, 34).items()}
        {'few': 2, 'many': 32}
        >>> parts({"few": 4, "many": 900}, 904)["many"]
        Part(read=900, of=900)
    """
    if sum(counts.values()) <= most:
        return {name: Part(count, count) for name, count in counts.items()}
    read: dict[str, int] = {}
    left, waiting = most, sorted(counts, key=lambda name: (counts[name], name))
    while waiting:  # the smallest first: if it has too few for its share, so had those before it
        share = sqrt(counts[waiting[0]]) / (sum(sqrt(counts[name]) for name in waiting) or 1)
        smallest = waiting.pop(0)
        read[smallest] = min(counts[smallest], max(1, round(left * share)))
        left -= read[smallest]
    return {name: Part(read[name], counts[name]) for name in counts}


def chosen(
    datasets: Mapping[str, Sequence[Photo]], steps: int, seed: int = 0
) -> dict[str, Sequence[Photo]]:
    """The photos of each data set that are read, in their order.

    Args:
        datasets: All photos of each data set, by its name.
        steps: How many batches the model sees.
        seed: The same seed and photos give the same choice.
    """
    rng = np.random.default_rng(seed)
    counts = {name: len(photos) for name, photos in datasets.items()}
    found: dict[str, Sequence[Photo]] = {}
    for name, part in parts(counts, most_photos(steps)).items():
        photos = datasets[name]
        if part.read < part.of:
            places = np.sort(rng.choice(part.of, part.read, replace=False))
            photos = [photos[place] for place in places]
        found[name] = photos
    return found
