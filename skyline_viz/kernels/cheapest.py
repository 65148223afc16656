"""The cheapest path through nodal costs, where every link has the same small reach.

`skyline_viz.path` has the equation, and loops for every case. This is the case of every photo, and
the same result to the bit, in a fraction of the time and memory, by two ideas.

All changes of row are asked for in one go, while a pixel's cost is in a register, and for several
pixels at once: the compiler knows how many there are from the length of a tuple, and two that share
a link are compared before it is added. That rounds as it would after it.

And the table of the cheapest costs is not kept. Of `EVERY` columns one is; the others are worked
out anew on the way back, for no more rows than the path can still reach.
"""

import math

import numba
import numpy as np

from skyline_viz.arrays import F32, F64, Int

EVERY = 16
"""Columns from one that is kept to the next."""

LANES = (4, 8)
"""Numbers of changes of row for which there is machine code: each takes seconds to compile."""

MOST = LANES[-1]
"""The largest reach of a link."""

Links = tuple[float, ...]


def cheapest(columns: F32, reach: int, link_weight: float) -> tuple[Int, float]:
    """Rows ``(W,)`` of the cheapest path, and what it costs; infinite where there is none.

    Args:
        columns: ``(W, H)`` nodal costs, column by column, none of them NaN or minus infinity.
        reach: Largest change of row on each link, from 1 to `MOST`, and below H.
        link_weight: Cost of one pixel of row change.

    Examples:
        >>> columns = np.array([[1, 2, 3], [2, 2, 1], [2, 2, 1]], np.float32)
        >>> cheapest(columns, 1, 0.5)
        (array([1, 2, 2], dtype=int32), 4.5)
        >>> cheapest(columns, 2, 0.5)
        (array([0, 2, 2], dtype=int32), 4.0)
    """
    lanes = next(one for one in LANES if one >= reach)
    costs = [link_weight * change for change in range(1, reach + 1)]
    links = tuple(costs + [math.inf] * (lanes - reach))  # a link that costs that is never taken
    width, height = columns.shape
    rows = np.empty(width, np.int32)
    kept = np.empty((-(-width // EVERY), height))
    cost = _there(columns, links, kept, rows)
    if np.isfinite(cost):
        _back(columns, links, kept, rows)
    return rows, cost


@numba.njit(cache=True, nogil=True)
def _there(columns: F32, links: Links, kept: F64, rows: Int) -> float:
    """Keep the costs of one column in `EVERY`, find the last row, and tell what the path costs."""
    width, height = columns.shape
    rim = len(links)
    before = np.full(height + 2 * rim, np.inf)
    after = np.full(height + 2 * rim, np.inf)
    before[rim : rim + height] = columns[0]
    for column in range(width):
        if column > 0:
            _step(before, columns[column], links, after)
            before, after = after, before
        if column % EVERY == 0:
            kept[column // EVERY] = before[rim : rim + height]
    last = before[rim : rim + height]
    best = 0
    for row in range(height):
        nearer = abs(2 * row - height) < abs(2 * best - height)
        if last[row] < last[best] or (last[row] == last[best] and nearer):
            best = row
    rows[-1] = best
    cost: float = last[best]
    return cost


@numba.njit(cache=True, nogil=True)
def _back(columns: F32, links: Links, kept: F64, rows: Int) -> None:
    """Fill in the rows of a path from its last one backwards.

    From a row the path comes to no column before it but through those within reach, column by
    column; what these cost depends on just as many more in the column that is kept.
    """
    width, height = columns.shape
    rim = len(links)
    widest = min(2 * rim * EVERY + 1, height)
    table = np.empty((EVERY, widest + 2 * rim))
    for block in range(len(kept) - 1, -1, -1):
        first = block * EVERY
        end = min(
            first + EVERY, width - 1
        )  # the first column after these, of which we know the row
        top = max(rows[end] - rim * EVERY, 0)
        count = min(rows[end] + rim * EVERY + 1, height) - top
        table[:] = np.inf
        table[0, rim : rim + count] = kept[block, top : top + count]
        for column in range(first + 1, end):
            costs = columns[column, top : top + count]
            at = column - first
            _step(table[at - 1, : count + 2 * rim], costs, links, table[at, : count + 2 * rim])
        for column in range(end - 1, first - 1, -1):
            line = table[column - first]
            here = rows[column + 1] - top + rim
            best = here
            lowest = line[here]
            for change in range(1, rim + 1):
                link = links[change - 1]
                if line[here - change] + link < lowest:
                    best = here - change
                    lowest = line[best] + link
                if line[here + change] + link < lowest:
                    best = here + change
                    lowest = line[best] + link
            rows[column] = best + top - rim


@numba.njit(cache=True, nogil=True)
def _step(before: F64, costs: F32, links: Links, after: F64) -> None:
    """Cost of the cheapest way to each pixel of a column, its own cost included.

    Args:
        before: ``(H + 2 reach,)`` of the column before, with a rim of infinities.
        costs: ``(H,)`` nodal costs of this one.
        links: What each change of row costs, from 1 on; infinite if it is too large.
        after: ``(H + 2 reach,)`` is filled inside its rim.
    """
    rim = len(links)
    for row in range(len(costs)):
        least = before[row + rim]
        for change in range(len(links)):
            up = before[row + rim - 1 - change]
            down = before[row + rim + 1 + change]
            least = min(least, min(up, down) + links[change])
        after[row + rim] = least + costs[row]
