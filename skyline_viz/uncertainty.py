r"""How sure the cheapest path is: what it would cost to go elsewhere.

The min-marginal of a pixel is the cost of the cheapest whole path through it: its forward cost,
which leads there, plus its backward cost less its own. The backward sweep keeps
a column at a time, so that no second table is ever held.

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
from skyline_viz.path import APART, column_margin, cross


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
    cost: npt.NDArray[np.floating],
    forward: F64,
    delta: int,
    link_weight: float,
    apart: int = APART,
) -> Uncertainty:
    """How sure the path is that `path.shortest_path` found with the same costs.

    Args:
        cost: ``(H, W)`` nodal costs; ``inf`` forbids a pixel.
        forward: ``(H, W)`` forward costs, `path.forward_costs`.
        delta: Largest change of row between neighbouring columns, in pixels.
        link_weight: Cost of one pixel of row change.
        apart: Rows within which two paths count as the same one.

    Examples:
        >>> from skyline_viz.path import forward_costs
        >>> cost = np.full((5, 4), 2.0)
        >>> cost[1], cost[3] = 1.0, 1.1
        >>> forward = forward_costs(cost, delta=1, link_weight=0.1)
        >>> uncertainty(cost, forward, 1, 0.1, apart=1).margins.round(2)
        array([0.4, 0.4, 0.4, 0.4])
    """
    height, width = cost.shape
    margins = np.empty(width)
    detour = np.empty((width, height), np.float32)
    columns = np.ascontiguousarray(cost.T)
    reach = min(int(delta), height - 1)
    _sweep_back(
        columns, np.ascontiguousarray(forward.T), reach, float(link_weight), apart, margins, detour
    )
    return Uncertainty(margins=margins, detour=detour.T)


@numba.njit(cache=True, nogil=True)
def _sweep_back(
    columns: F32,
    forward: F64,
    reach: int,
    link_weight: float,
    apart: int,
    margins: F64,
    detour: F32,
) -> None:
    width, height = columns.shape
    best_cost = forward[-1].min()
    before = np.zeros(height)  # what follows each pixel, of the column to the right
    after = np.zeros(height)
    through = np.empty(height)
    for column in range(width - 1, -1, -1):
        cross(before, reach, link_weight, after)  # beyond the last column nothing costs anything
        for row in range(height):
            through[row] = forward[column, row] + after[row]
            detour[column, row] = max(through[row] - best_cost, 0.0)
        margins[column] = column_margin(through, apart)
        for row in range(height):
            before[row] = after[row] + columns[column, row]
