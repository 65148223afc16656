"""Percentiles as `np.percentile` has them, to the bit, without sorting what need not be sorted."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from skyline_viz.arrays import F32, I16, Int

_SAMPLED = 64  # one value in so many says where the larger ones begin


def upper_percentile(values: F32, percentile: float) -> np.float32:
    """A percentile near the upper end of values ``(n,)``, of which most are left out of the search.

    A sample tells below which value no more is to be looked for. Where it was wrong all are asked.

    >>> upper_percentile(np.arange(11, dtype=np.float32), 95)
    np.float32(9.5)
    """
    place = (len(values) - 1) * (percentile / 100)
    sample = values[::_SAMPLED]
    bound = np.partition(sample, at := int((len(sample) - 1) * 0.95 * percentile / 100))[at]
    tail = values[values >= bound]
    left_out = len(values) - len(tail)
    first = int(place)
    if first < left_out:
        return np.float32(np.percentile(values, percentile))
    last = min(first + 1, len(values) - 1)
    both = first - left_out, last - left_out
    lower, upper = np.partition(tail, both)[list(both)]
    return np.float32(_between(lower, upper, place - first))


def percentiles_of_counts(numbers: Int | I16, percentiles: Sequence[float]) -> list[float]:
    """Percentiles of small whole numbers ``(n,)`` from 0 on: how often each occurs is enough.

    >>> percentiles_of_counts(np.array([3, 0, 0, 1]), (0, 50, 100))
    [0.0, 0.5, 3.0]
    """
    up_to = np.cumsum(np.bincount(numbers))
    places = [(len(numbers) - 1) * (one / 100) for one in percentiles]
    firsts = [int(place) for place in places]
    lasts = [min(first + 1, len(numbers) - 1) for first in firsts]
    lower, upper = (np.searchsorted(up_to, one, side="right") for one in (firsts, lasts))
    return [
        float(_between(before, after, place - first))
        for before, after, place, first in zip(lower, upper, places, firsts, strict=True)
    ]


def _between(lower: Any, upper: Any, share: float) -> Any:  # noqa: ANN401 - numbers of any type
    """A number between two, from the nearer one: numpy rounds so."""
    step = upper - lower
    return upper - step * (1 - share) if share >= 0.5 else lower + step * share
