"""Lie et al. (2005): the path along Canny edges, with dummy nodes across gaps (equations 1 to 3).

Every edge pixel costs the same, and links cost the change of row. An edge pixel that no edge pixel
of the next column is in reach of looks for one in the columns behind, up to the tolerance of gap,
and dummy nodes on the straight line to it cost more than an edge, but less than anything else.

Edges alone do not tell a skyline from a ridge in the foreground. Lie et al. assume that it is the
topmost line from rim to rim: in the first and in the last column an edge costs the more the lower
it is, by its squared row. The published figures rest on that, and on photos without a frame.
Measured on 40 of the Web photographs, mean, standard deviation, median and photos under 4 pixels:

==========================================  ======  ======  ======  ======
Canny 50 and 220, ``delta`` = ``tog`` = 30    mean     std  median   < 4
==========================================  ======  ======  ======  ======
with frames, no cost of rows                  34.4    62.1    0.67   24/40
without frames (4 photos have one)            24.6    42.8    0.62   25/40
and with the cost of rows (the default)        8.3    16.3    0.47   29/40
published, all 80 photographs                  9.2    17.9       -       -
==========================================  ======  ======  ======  ======

Edges of the smoothed photo with thresholds from its own gradients, as the Canny detector of MATLAB
chooses them, fit the skyline better (median 0.3) and are so many that more photos go wrong. What
is left are clouds above the skyline and, where its edges have gaps, ridges right below it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Bool, check_photo
from skyline_viz.detection import Detection, solve_detection, timed
from skyline_viz.edges import find_edges
from skyline_viz.frames.finding import find_frame
from skyline_viz.frames.frame import without_frame
from skyline_viz.system.settings import Configured, Presets

RULED_OUT = 1e4
"""Cost of pixels that are no node; the paper's infinite one, but of any two lines the one that
crosses fewer of them is still the cheaper one."""


@dataclass(frozen=True)
class EdgesOnly(Configured):
    """The settings are in pixels of the photo, whatever its size."""

    PRESETS: ClassVar[Presets] = {"edges": {}}

    low_threshold: float = 50.0
    """Lower Canny threshold, on the grey photo."""

    high_threshold: float = 220.0
    """Upper Canny threshold, on the grey photo."""

    delta: int = 30
    """Largest change of row between neighbouring columns, and across a gap."""

    tog: int = 30
    """Longest gap that is filled, in columns."""

    edge_cost: float = 1.0
    """Nodal cost ``l`` of an edge pixel."""

    gap_cost: float = 100.0
    """Nodal cost of a dummy node."""

    row_cost: float = 1.0
    """What an edge in the first and in the last column costs more, times its squared row."""

    def detect(self, photo: U8) -> Detection:
        """Find the skyline of a photo ``(H, W, 3)`` uint8 RGB."""
        check_photo(photo)
        seconds: dict[str, float] = {}
        with timed(seconds, "edges"):
            inside = without_frame(photo, find_frame(photo))
            edges = find_edges(inside, "grey", self.low_threshold, self.high_threshold)
        with timed(seconds, "cost"):
            below = self.row_cost * np.arange(1, len(edges) + 1, dtype=np.float32) ** 2
            # not to begin on an edge has to cost more than to begin on the lowest one
            ruled_out = max(RULED_OUT, 4 * float(below[-1]))
            dummies = fill_gaps(np.ascontiguousarray(edges.T), self.delta, self.tog).T
            cost = np.full(edges.shape, ruled_out, np.float32)
            cost[dummies] = self.gap_cost
            cost[edges] = self.edge_cost
            cost[:, 0] += below
            cost[:, -1] += below
        return solve_detection(
            self.name,
            photo,
            edges,
            np.ones(int(edges.sum()), np.float32),
            cost,
            seconds,
            delta=self.delta,
            link_weight=1.0,
            non_edge_cost=ruled_out,
            score_weight=0.0,
        )


@numba.njit(cache=True, nogil=True)
def fill_gaps(edges: Bool, delta: int, tog: int) -> Bool:
    """Dummy nodes of edge pixels that cannot go on.

    Args:
        edges: ``(W, H)`` edge map, column by column.
        delta: Largest change of row between neighbouring columns, and to the far side of a gap.
        tog: Columns that are looked through for a far side.

    Returns:
        ``(W, H)`` bool, True on dummy nodes.
    """
    width, height = edges.shape
    above = np.zeros((width, height + 1), np.int32)  # edge pixels above each row
    for column in range(width):
        for row in range(height):
            above[column, row + 1] = above[column, row] + edges[column, row]
    dummies = np.zeros((width, height), np.bool_)
    for column in range(width - 1):
        for row in range(height):
            if not edges[column, row]:
                continue
            low, high = max(row - delta, 0), min(row + delta + 1, height)
            if above[column + 1, high] > above[column + 1, low]:
                continue
            for ahead in range(2, min(tog, width - 1 - column) + 1):
                there = column + ahead
                if above[there, high] == above[there, low]:
                    continue
                end = _nearest(edges[there], row, delta)
                for step in range(1, ahead):
                    at = row + (end - row) * step / ahead
                    dummies[column + step, int(np.floor(at + 0.5))] = True
                break
    return dummies & ~edges


@numba.njit(cache=True, nogil=True)
def _nearest(column: Bool, row: int, delta: int) -> int:
    """Row of the edge pixel of a column that is nearest to a row, the upper one among equals."""
    for away in range(delta + 1):
        if row - away >= 0 and column[row - away]:
            return row - away
        if row + away < column.size and column[row + away]:
            return row + away
    return row


def ruled_out_but(shape: tuple[int, ...], where: Bool, costs: F32) -> F32:
    """Nodal costs ``(H, W)`` of chosen pixels, given row by row; all others are ruled out."""
    cost = np.full(shape, RULED_OUT, np.float32)
    cost[where] = costs
    return cost
