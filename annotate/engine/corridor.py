"""The cheapest line through a corridor, between tables that hold what lies on either side of it.

A preview of a guide follows the hand, so no more is searched than the corridor: all else that a
line may do is in the tables already.
"""

from __future__ import annotations

import numba
import numpy as np

from skyline_viz.arrays import F32, F64, Int


@numba.njit(cache=True, nogil=True)
def follow(
    columns: F32,
    tops: Int,
    bottoms: Int,
    first: int,
    before: F64,
    after: F64,
    reach: int,
    link_weight: float,
    rows: Int,
) -> float:
    """Fill in the rows of the cheapest line through a corridor, and return what it costs.

    Args:
        columns: ``(W, H)`` nodal costs, column by column.
        tops: ``(n,)`` first row that is allowed in each column of the corridor.
        bottoms: ``(n,)`` last one.
        first: First column of the corridor.
        before: ``(H,)`` cost of the cheapest line to each pixel of the column before it; empty
            where there is none.
        after: ``(H,)`` the same of the column after it, from the right.
        reach: Largest change of row on each link.
        link_weight: Cost of one pixel of row change.
        rows: ``(W,)`` is filled in the corridor's columns, where a line leads through it; the cost
            is infinite where none does.
    """
    count = len(tops)
    widest = 0
    for place in range(count):
        widest = max(widest, bottoms[place] - tops[place] + 1)
    table = np.full((count, widest), np.inf)
    for place in range(count):
        for row in range(tops[place], bottoms[place] + 1):
            if place > 0:
                least = _cheapest_before(
                    table[place - 1], tops[place - 1], row, reach, link_weight
                )[0]
            elif len(before):
                least = _cheapest_before(before, 0, row, reach, link_weight)[0]
            else:
                least = 0.0
            table[place, row - tops[place]] = least + columns[first + place, row]
    best, lowest = -1, np.inf
    for row in range(tops[-1], bottoms[-1] + 1):
        cost = table[-1, row - tops[-1]]
        if len(after):
            cost += _cheapest_before(after, 0, row, reach, link_weight)[0]
        if cost < lowest:
            best, lowest = row, cost
    if best < 0:
        return np.inf
    rows[first + count - 1] = best
    for place in range(count - 2, -1, -1):
        row = rows[first + place + 1]
        rows[first + place] = _cheapest_before(table[place], tops[place], row, reach, link_weight)[
            1
        ]
    return lowest


@numba.njit(cache=True, nogil=True, inline="always")
def _cheapest_before(
    costs: F64, top: int, row: int, reach: int, link_weight: float
) -> tuple[float, int]:
    """Cost of the cheapest way to a row from the column beside it, and from which row."""
    at = row - top
    least, best = np.inf, row
    if 0 <= at < len(costs):
        least = costs[at]
    for change in range(1, reach + 1):
        link = link_weight * change
        if 0 <= at - change < len(costs) and costs[at - change] + link < least:
            least, best = costs[at - change] + link, row - change
        if 0 <= at + change < len(costs) and costs[at + change] + link < least:
            least, best = costs[at + change] + link, row + change
    return least, best
