"""What the search for the cheapest path knew of each pixel when it got there, to be looked at.

The search itself keeps a bit a pixel. Here it is made anew, a block of columns at a time: a table
of forward costs in double precision would take three times as much memory as the photo.
"""

from __future__ import annotations

from dataclasses import dataclass

import numba
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, I16, Int, read_only
from skyline_viz.path import cross, trace

_BLOCK = 1_000_000  # forward costs that are kept at a time, 8 bytes each


@dataclass(frozen=True, eq=False)
class SearchTables:
    """Tables of a search from the first column to the last."""

    above: F32
    """``(H, W)`` how much dearer the cheapest way from the first column to a pixel is than that to
    the cheapest pixel of its column, both nodal costs included."""

    back: I16
    """``(H, W)`` from which row of the column before that way comes, less the pixel's own; 0 in the
    first column."""

    def __post_init__(self) -> None:
        """Freeze the arrays."""
        read_only(self.above)
        read_only(self.back)


def search_tables(cost: npt.NDArray[np.floating], delta: int, link_weight: float) -> SearchTables:
    """Tables of the search that `path.shortest_path` makes.

    Args:
        cost: ``(H, W)`` nodal costs; ``inf`` forbids a pixel.
        delta: Largest change of row between neighbouring columns, in pixels.
        link_weight: Cost of one pixel of row change.

    Examples:
        >>> tables = search_tables(np.array([[5.0, 1.0], [0.0, 1.0]]), 1, 0.5)
        >>> tables.above
        array([[5. , 0.5],
               [0. , 0. ]], dtype=float32)
        >>> tables.back[:, 1]
        array([1, 0], dtype=int16)
    """
    height, width = cost.shape
    reach = np.full(1, min(int(delta), height - 1), np.int32)
    above, back = np.empty((width, height), np.float32), np.zeros((width, height), np.int16)
    step = max(_BLOCK // height, 1)
    last = np.zeros(height)
    for first in range(0, width, step):
        columns = np.ascontiguousarray(cost[:, first : first + step].T)
        part = slice(first, first + len(columns))
        given = first == 0, reach, float(link_weight), last
        _sweep(columns, *given, above[part], back[part])
    return SearchTables(above.T, back.T)


@numba.njit(cache=True, nogil=True)
def _sweep(
    columns: F32,
    begins: bool,
    reach: Int,
    link_weight: float,
    last: F64,
    above: F32,
    back: I16,
) -> None:
    """Fill the tables of some columns.

    Args:
        columns: ``(w, H)`` their nodal costs.
        begins: Whether the first of them is the first of all.
        reach: ``(1,)`` largest change of row on each link.
        link_weight: Cost of one pixel of row change.
        last: ``(H,)`` forward costs of the column before them; brought on to their last one.
        above: ``(w, H)`` is filled.
        back: ``(w, H)`` is filled.
    """
    count, height = columns.shape
    pair, rows = np.empty((2, height)), np.empty(2, np.int32)
    for column in range(count):
        if begins and column == 0:
            for row in range(height):
                last[row] = columns[0, row]
        else:
            pair[0, :] = last
            cross(pair[0], reach[0], link_weight, pair[1])
            for row in range(height):
                pair[1, row] += columns[column, row]
            for row in range(height):
                rows[1] = row
                trace(pair, reach, link_weight, rows, 1, 0)
                back[column, row] = rows[0] - row
            last[:] = pair[1]
        least = last.min()
        for row in range(height):
            above[column, row] = last[row] - least
