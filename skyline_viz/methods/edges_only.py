"""Lie et al. (2005): the path along Canny edges, with dummy nodes across gaps (equations 1 to 3).

Every edge pixel costs the same, and links cost the change of row. An edge pixel that no edge pixel
of the next column is in reach of looks for one in the columns behind, up to the tolerance of gap,
and dummy nodes on the straight line to it cost more than an edge, but less than anything else.
"""

from __future__ import annotations

from dataclasses import dataclass

import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Bool, check_photo
from skyline_viz.detection import Detection, solve_detection, timed
from skyline_viz.edges import find_edges

PUBLISHED_SIZE = (240, 352)
"""Rows and columns of the photos for which the published settings are meant."""

RULED_OUT = 1e4
"""Cost of pixels that are no node; the paper's infinite one, but of any two lines the one that
crosses fewer of them is still the cheaper one."""


@dataclass(frozen=True)
class EdgesOnly:
    """The settings are published for 352x240 pixels, and scaled to the size of each photo."""

    name: str = "edges"
    """Its name."""

    low_threshold: float = 50.0
    """Lower Canny threshold, on the grey photo."""

    high_threshold: float = 220.0
    """Upper Canny threshold, on the grey photo."""

    delta: float = 30.0
    """Largest change of row a column, in rows of a photo of 240 rows."""

    tog: float = 30.0
    """Longest gap that is filled, in columns of a photo of 352 columns."""

    edge_cost: float = 1.0
    """Nodal cost ``l`` of an edge pixel."""

    gap_cost: float = 100.0
    """Nodal cost of a dummy node."""

    def detect(self, photo: U8) -> Detection:
        """Find the skyline of a photo ``(H, W, 3)`` uint8 RGB."""
        check_photo(photo)
        seconds: dict[str, float] = {}
        down, across = (
            side / published
            for side, published in zip(photo.shape[:2], PUBLISHED_SIZE, strict=True)
        )
        delta = max(round(self.delta * down), 1)
        with timed(seconds, "edges"):
            edges, _ = find_edges(photo, "grey", self.low_threshold, self.high_threshold)
        with timed(seconds, "cost"):
            tog = max(round(self.tog * across), 1)
            dummies = fill_gaps(np.ascontiguousarray(edges.T), delta, tog).T
            # a photo of twice the columns has twice the nodes on every line
            cost = np.full(edges.shape, RULED_OUT, np.float32)
            cost[dummies] = self.gap_cost / across
            cost[edges] = self.edge_cost / across
        return solve_detection(
            self.name,
            photo,
            edges,
            np.ones(int(edges.sum()), np.float32),
            cost,
            seconds,
            delta=delta,
            link_weight=1 / down,
            non_edge_cost=RULED_OUT,
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
