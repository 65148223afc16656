r"""How sure the cheapest path is: what it would cost to go elsewhere.

The min-marginal of a pixel is the cost of the cheapest whole path through it: its forward cost,
which leads there, plus its backward cost less its own. The backward sweep keeps a column at a time.
Of the forward costs a block of columns is kept; those of a large photo are swept a second time,
from the first column of each block on.

The margin of a column is the gap between its best min-marginal, in row $b$, and the best one
further away than $a$ rows. The detour of a pixel is the gap to the best of all:

$$
m_j = \min_{|k - b| > a} M_j(k) - M_j(b), \quad d_j(k) = M_j(k) - \min M
$$
"""

from __future__ import annotations

from dataclasses import dataclass

import numba
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, read_only
from skyline_viz.path import APART, column_margin, cross, sweep

KEPT = 4_000_000
"""Forward costs that are kept, 8 bytes each: all of a photo that has no more pixels."""

BLOCK = 1_000_000
"""Those that are kept at a time of a larger one."""


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """How sure a path is, column by column and pixel by pixel."""

    margins: F64
    """``(W,)`` the gap between a column's best min-marginal and the best one more than `APART`
    rows away: small is uncertain, infinite where nothing else is possible."""

    detour: F32
    """``(H, W)`` how much dearer than the best path the best one through each pixel is."""

    def __post_init__(self) -> None:
        """Freeze the arrays."""
        read_only(self.margins)
        read_only(self.detour)


def uncertainty(
    cost: npt.NDArray[np.floating], delta: int, link_weight: float, apart: int = APART
) -> Uncertainty:
    """How sure the path is that `path.shortest_path` finds with the same costs.

    Args:
        cost: ``(H, W)`` nodal costs; ``inf`` forbids a pixel.
        delta: Largest change of row between neighbouring columns, in pixels.
        link_weight: Cost of one pixel of row change.
        apart: Rows within which two paths count as the same one.

    Examples:
        >>> cost = np.full((5, 4), 2.0)
        >>> cost[1], cost[3] = 1.0, 1.1
        >>> uncertainty(cost, delta=1, link_weight=0.1, apart=1).margins.round(2)
        array([0.4, 0.4, 0.4, 0.4])
    """
    height, width = cost.shape
    columns: F32 = np.ascontiguousarray(cost.T)
    step = max((KEPT if cost.size <= KEPT else BLOCK) // height, 1)
    starts = range(0, max(width - 1, 1), step)  # of the blocks, each of which ends where one starts
    reach = np.full(step, min(int(delta), height - 1), np.int32)
    table = np.empty((min(step, width - 1) + 1, height))
    at_start = np.empty((len(starts), height))
    at_start[0] = columns[0]

    def sweep_block(number: int) -> F64:
        block = columns[starts[number] : starts[number] + step + 1]
        table[0] = at_start[number]
        sweep(block, reach, float(link_weight), table, 0, len(block) - 1)
        return table[: len(block)]

    for number in range(len(starts)):
        forward = sweep_block(number)
        if number + 1 < len(starts):
            at_start[number + 1] = forward[-1]
    best = forward[-1].min()
    margins, detour = np.empty(width), np.empty((width, height), np.float32)
    follows = np.zeros(height)  # what follows each pixel: beyond the last column nothing does
    for number in reversed(range(len(starts))):
        if number + 1 < len(starts):
            forward = sweep_block(number)[:-1]  # its last column was the first one of the next
        part = slice(starts[number], starts[number] + len(forward))
        given = columns[part], forward, best, reach[0], float(link_weight), apart
        _sweep_back(*given, follows, margins[part], detour[part])
    return Uncertainty(margins=margins, detour=detour.T)


@numba.njit(cache=True, nogil=True)
def _sweep_back(
    columns: F32,
    forward: F64,
    best: float,
    reach: int,
    link_weight: float,
    apart: int,
    follows: F64,
    margins: F64,
    detour: F32,
) -> None:
    """Fill in margins and detours of some columns, from the last one on.

    Args:
        columns: ``(w, H)`` their nodal costs.
        forward: ``(w, H)`` their forward costs.
        best: What the cheapest path costs.
        reach: Largest change of row on each link.
        link_weight: Cost of one pixel of row change.
        apart: See `uncertainty`.
        follows: ``(H,)`` backward costs of the column after them; brought on to their first one.
        margins: ``(w,)`` are filled.
        detour: ``(w, H)`` is filled.
    """
    width, height = columns.shape
    after = np.zeros(height)
    through = np.empty(height)
    for column in range(width - 1, -1, -1):
        cross(follows, reach, link_weight, after)
        for row in range(height):
            through[row] = forward[column, row] + after[row]
            detour[column, row] = max(through[row] - best, 0.0)
        margins[column] = column_margin(through, apart)
        for row in range(height):
            follows[row] = after[row] + columns[column, row]
