"""Where a line is least sure: the stretches of columns to look at first."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import Bool, runs

SHARE = 0.05
"""Share of the columns that is least sure."""

GAP = 0.01
"""Stretches nearer than this share of the width are one."""


def least_sure(
    margins: npt.NDArray[np.floating], visible: Bool, most: int = 3
) -> list[tuple[int, int]]:
    """The stretches with the smallest margins, the least sure first.

    They hold the `SHARE` of the visible columns that has the smallest margins. A column in which no
    other line is possible is in none.

    Args:
        margins: ``(W,)`` how sure each column is, see `Detection.margins`.
        visible: ``(W,)`` columns that count.
        most: Stretches at most.

    Returns:
        First and last column of each stretch.

    Examples:
        >>> margins = np.full(100, 5.0)
        >>> margins[[7, 8, 40]] = 0.2, 0.3, 0.1
        >>> least_sure(margins, np.ones(100, np.bool_), most=2)
        [(40, 40), (7, 8)]
    """
    counted = np.flatnonzero(visible & np.isfinite(margins))
    number = int(np.ceil(SHARE * len(counted)))
    order = counted[np.argsort(margins[counted], kind="stable")][:number]
    if number and number == len(counted):
        order = order[:1]  # of so few columns the least sure one
    chosen = np.zeros(len(margins), np.bool_)
    chosen[order] = True
    joined = runs(chosen, gap=round(GAP * len(margins)))
    return sorted(joined, key=lambda one: float(margins[one[0] : one[1] + 1].min()))[:most]
