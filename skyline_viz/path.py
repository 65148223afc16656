r"""Stage 6, path: the cheapest way from the first column to the last, and how sure it is.

A path has one row a column. It pays the nodal cost $\Psi$ of every pixel that it visits. Between
two columns it pays ``link_weight`` times the change of row, which is at most ``delta`` (equation 3
of the paper). Dynamic programming finds the optimum exactly, column by column:

$$
F_j(k) = \Psi(k, j) + \min_{|i - k| \le \delta} \left( F_{j-1}(i) + w_{link} \, |i - k| \right)
$$

Kept from both sides, its tables tell the cost of the cheapest path through any pixel, the
min-marginal, with $B$ as the same sum from the right:

$$
M_j(k) = F_j(k) + B_j(k) - \Psi(k, j)
$$

The tables run column by column in memory, because the inner loops go down a column.
"""

from dataclasses import dataclass

import numba
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, Int, read_only
from skyline_viz.constraints import Constraints, PathError, apply_constraints, find_conflict
from skyline_viz.kernels.cheapest import MOST, cheapest

APART = 5
"""Rows within which two paths count as the same one."""


@dataclass(frozen=True, eq=False)
class Path:
    """A cheapest path."""

    rows: Int
    """``(W,)`` its row in each column."""

    cost: float
    """Its nodal and link costs together."""


@dataclass(frozen=True)
class PathTables:
    """Forward and backward tables of one problem, each ``(H, W)`` float64, infinite = no path."""

    forward: F64
    """Cost of the cheapest path from the first column to each pixel, its own cost included."""

    backward: F64
    """Cost of the cheapest path from each pixel to the last column, its own cost included."""

    min_marginals: F64
    """Cost of the cheapest whole path through each pixel: forward + backward - its own cost."""


def shortest_path(
    cost: npt.NDArray[np.floating],
    delta: int,
    link_weight: float,
    constraints: Constraints | None = None,
) -> Path:
    """Find the cheapest path; exact.

    Where several are equally cheap, the one that ends nearest the middle row wins, then the one
    with the smallest change of row: a photo without any edge gives a level line.

    Args:
        cost: ``(H, W)`` nodal costs; ``inf`` forbids a pixel.
        delta: Largest change of row between neighbouring columns, in pixels.
        link_weight: Cost of one pixel of row change.
        constraints: What the path must and must not visit.

    Raises:
        PathError: A cost is NaN or minus infinity, or no path satisfies the constraints.

    Examples:
        Of two level lines the path takes the cheaper one, unless an anchor says otherwise.

        >>> cost = np.full((5, 4), 2.0)
        >>> cost[1], cost[3] = 1.0, 1.1
        >>> shortest_path(cost, delta=1, link_weight=0.1).rows
        array([1, 1, 1, 1], dtype=int32)
        >>> from skyline_viz.constraints import Anchor
        >>> anchored = Constraints(anchors=(Anchor(column=0, row=3),))
        >>> shortest_path(cost, 1, 0.1, anchored).rows
        array([3, 3, 3, 3], dtype=int32)
    """
    columns, reach = _problem(cost, delta, link_weight, constraints)
    everywhere = int(reach[0]) if constraints is None and len(reach) else 0
    if 1 <= everywhere <= MOST:
        rows, paid = cheapest(columns, everywhere, float(link_weight))
        if np.isfinite(paid):
            return Path(rows=rows, cost=paid)
    forward = _forward(columns, reach, float(link_weight))
    _require_path(forward, constraints)
    rows = np.empty(len(forward), np.int32)
    rows[-1] = cheapest_end(forward[-1])
    trace(forward, reach, float(link_weight), rows, len(rows) - 1, 0)
    return Path(rows=rows, cost=float(forward[-1, rows[-1]]))


def forward_costs(cost: npt.NDArray[np.floating], delta: int, link_weight: float) -> F64:
    """``(H, W)`` cost of the cheapest path from the first column to each pixel; read-only.

    Arguments and errors are those of `shortest_path`, which needs no such table.

    Examples:
        >>> forward_costs(np.array([[1.0, 1.0], [3.0, 3.0]]), delta=1, link_weight=0.5)
        array([[1. , 2. ],
               [3. , 4.5]])
    """
    columns, reach = _problem(cost, delta, link_weight, None)
    forward = _forward(columns, reach, float(link_weight))
    _require_path(forward, None)
    read_only(forward)
    return forward.T


def path_tables(
    cost: npt.NDArray[np.floating],
    delta: int,
    link_weight: float,
    constraints: Constraints | None = None,
) -> PathTables:
    """Tables of the problem that `shortest_path` solves; same arguments, same errors.

    Examples:
        >>> cost = np.array([[1.0, 1.0], [3.0, 3.0]])
        >>> path_tables(cost, delta=1, link_weight=0.0).min_marginals
        array([[2., 2.],
               [4., 4.]])
    """
    columns, reach = _problem(cost, delta, link_weight, constraints)
    forward = _forward(columns, reach, float(link_weight))
    _require_path(forward, constraints)
    backward = np.empty_like(forward)
    backward[-1] = columns[-1]
    sweep(columns, reach, float(link_weight), backward, len(columns) - 1, 0)
    through = np.empty_like(forward)
    for column in range(len(columns)):
        min_marginals(forward[column], backward[column], columns[column], through[column])
    return PathTables(forward=forward.T, backward=backward.T, min_marginals=through.T)


def margins(min_marginals: F64, apart: int = APART) -> F64:
    """Margin of each column, ``(W,)``: how much dearer the best distinct alternative is.

    The gap between a column's best min-marginal and the best one more than `apart` rows away.
    Small = uncertain; infinite where nothing else is possible.

    Examples:
        >>> cost = np.full((5, 4), 2.0)
        >>> cost[1], cost[3] = 1.0, 1.1
        >>> tables = path_tables(cost, delta=1, link_weight=0.1)
        >>> margins(tables.min_marginals, apart=1).round(2)
        array([0.4, 0.4, 0.4, 0.4])
    """
    through = np.ascontiguousarray(min_marginals.T)
    return np.array([column_margin(column, apart) for column in through])


def _problem(
    cost: npt.NDArray[np.floating],
    delta: int,
    link_weight: float,
    constraints: Constraints | None,
) -> tuple[npt.NDArray[np.floating], Int]:
    """Checked nodal costs ``(W, H)`` and the largest change of row on each link ``(W - 1,)``."""
    if cost.ndim != 2 or cost.size == 0:
        raise PathError(f"nodal costs have the shape (H, W), not {cost.shape}")
    if not (delta >= 0 and delta % 1 == 0):
        raise PathError(f"delta is a whole number of rows, 0 or more, not {delta}")
    if not 0 <= link_weight < np.inf:
        raise PathError(f"link_weight is finite and not negative, not {link_weight}")
    if cost.dtype not in (np.float32, np.float64):
        cost = cost.astype(np.float64)
    lowest = cost.min()  # NaN where there is one
    if np.isnan(lowest) or lowest == -np.inf:
        raise PathError("a nodal cost is NaN or minus infinity")
    height, width = cost.shape
    reach = np.full(width - 1, min(int(delta), height - 1), np.int32)
    columns = np.ascontiguousarray(cost.T)
    if constraints is None:
        return columns, reach
    return apply_constraints(columns, reach, constraints)


def _require_path(forward: F64, constraints: Constraints | None) -> None:
    if np.isfinite(forward[-1]).any():
        return
    dead = int(np.flatnonzero(~np.isfinite(forward).any(axis=1))[0])
    raise PathError(find_conflict(dead, constraints or Constraints()))


def _forward(columns: F32, reach: Int, link_weight: float) -> F64:
    """Cheapest cost from column 0 to every pixel, ``(W, H)``; a window of reach pixels a link."""
    table = np.empty(columns.shape, np.float64)  # by numpy, which asks for huge pages
    table[0] = columns[0]
    sweep(columns, reach, link_weight, table, 0, len(columns) - 1)
    return table


@numba.njit(cache=True, nogil=True)
def sweep(columns: F32, reach: Int, link_weight: float, table: F64, first: int, last: int) -> None:
    """Fill a table from column `first`, which holds its costs already, to column `last`.

    Args:
        columns: ``(W, H)`` nodal costs, column by column.
        reach: ``(W - 1,)`` largest change of row on each link.
        link_weight: Cost of one pixel of row change.
        table: ``(W, H)`` cost of the cheapest path from column `first` to each pixel.
        first: Where to begin.
        last: The last column to fill, left or right of `first`.
    """
    height = columns.shape[1]
    step = 1 if last >= first else -1
    for column in range(first + step, last + step, step):
        after = table[column]
        cross(table[column - step], reach[min(column, column - step)], link_weight, after)
        for row in range(height):
            after[row] += columns[column, row]


@numba.njit(cache=True, nogil=True, inline="always")
def cross(before: F64, reach: int, link_weight: float, after: F64) -> None:
    """Cost of the cheapest way to each pixel of a column, from the pixels of the one beside it.

    All that knows the links searches with this loop: forwards, backwards, and for min-marginals.
    It is put into the loops that call it: sweeps take three quarters of the time so.

    Args:
        before: ``(H,)`` cost of the cheapest way to each pixel of the neighbouring column.
        reach: Largest change of row on the link between the two.
        link_weight: Cost of one pixel of row change.
        after: ``(H,)`` is filled; what the pixels themselves cost is not in it.
    """
    height = len(before)
    after[:] = before
    for change in range(1, reach + 1):
        link = link_weight * change
        for row in range(height - change):
            down = before[row + change] + link
            after[row] = min(after[row], down)
        for row in range(change, height):
            up = before[row - change] + link
            after[row] = min(after[row], up)


@numba.njit(cache=True, nogil=True)
def min_marginals(forward: F64, backward: F64, costs: F32, through: F64) -> None:
    """Min-marginals of a column: forward and backward cost less what is in both of them.

    Args:
        forward: ``(H,)`` of each pixel, its own cost included.
        backward: ``(H,)`` likewise.
        costs: ``(H,)`` the pixels' own; infinite where they are forbidden.
        through: ``(H,)`` is filled; infinite where nothing leads through.
    """
    for row in range(len(costs)):
        possible = np.isfinite(costs[row])
        through[row] = forward[row] + backward[row] - costs[row] if possible else np.inf


@numba.njit(cache=True, nogil=True)
def column_margin(through: F64, apart: int) -> float:
    """Margin of a column: the gap between its best min-marginal and the best one further away.

    Args:
        through: ``(H,)`` min-marginals, up to a constant.
        apart: Rows within which two paths count as the same one.
    """
    best = through.argmin()
    second = np.inf
    for row in range(best - apart):
        second = min(second, through[row])
    for row in range(best + apart + 1, len(through)):
        second = min(second, through[row])
    margin: float = max(second - through[best], 0.0)
    return margin


@numba.njit(cache=True, nogil=True)
def cheapest_end(costs: F64) -> int:
    """Row with the lowest of the costs ``(H,)``; among equals the one nearest the middle."""
    height = len(costs)
    best = 0
    for row in range(height):
        nearer = abs(2 * row - height) < abs(2 * best - height)
        if costs[row] < costs[best] or (costs[row] == costs[best] and nearer):
            best = row
    return best


@numba.njit(cache=True, nogil=True)
def trace(table: F64, reach: Int, link_weight: float, rows: Int, first: int, last: int) -> None:
    """Walk the cheapest path back through a table, from ``rows[first]`` to column `last`.

    Args:
        table: ``(W, H)`` as `sweep` filled it, from the other side.
        reach: ``(W - 1,)`` largest change of row on each link.
        link_weight: Cost of one pixel of row change.
        rows: ``(W,)`` row of each column; that of `first` is given, the others are filled.
        first: Where the walk begins.
        last: Where it ends.
    """
    height = table.shape[1]
    step = 1 if last >= first else -1
    for column in range(first + step, last + step, step):
        row = rows[column - step]
        best = row
        lowest = table[column, row]
        for change in range(1, reach[min(column, column - step)] + 1):
            link = link_weight * change
            if row - change >= 0 and table[column, row - change] + link < lowest:
                best = row - change
                lowest = table[column, best] + link
            if row + change < height and table[column, row + change] + link < lowest:
                best = row + change
                lowest = table[column, best] + link
        rows[column] = best
