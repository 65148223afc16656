"""What a line pays for, column by column: score, strength, no edge, clear sky, terrain, links."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F64, Int
from skyline_viz.cost import add_blocks
from skyline_viz.detection import Detection
from skyline_viz.detector import FilterDetection
from skyline_viz.terrain import BLOCK, terrain_above


@dataclass(frozen=True, eq=False)
class CostSplit:
    """Costs of a line in each column, stage by stage; the path search sums all of them."""

    stages: Mapping[str, F64]
    """``(W,)`` each. *score*: the part of the nodal cost that a higher score would save; *no edge*:
    what pixels without an edge cost; *link*: for the change of row from the column before. Of our
    detector, *strength*: what weak gradients cost; *clear sky*: for the edge pixels above;
    *terrain*: for what looks like terrain above, negative where it looks like sky. Of other
    methods, *edge*: what edge pixels cost besides their score."""

    def totals(self, first: int, last: int) -> dict[str, float]:
        """Sums over the columns from `first` to `last`, stage by stage."""
        part = slice(first, last + 1)
        return {stage: float(costs[part].sum()) for stage, costs in self.stages.items()}


def split_cost(detection: Detection, rows: Int) -> CostSplit:
    """Split the cost of a line.

    Args:
        detection: The detection.
        rows: ``(W,)`` row of the line in each column, inside the photo.
    """
    width = detection.edges.shape[1]
    columns = np.arange(width)
    pixels = edge_index(detection)[rows, columns]
    on_edge = pixels >= 0
    whole = detection.cost[rows, columns].astype(np.float64)
    score = np.zeros(width)
    score[on_edge] = detection.score_weight * (1 - detection.scores[pixels[on_edge]])
    link = detection.link_weight * np.abs(np.diff(rows, prepend=rows[:1])).astype(np.float64)
    no_edge = np.where(on_edge, 0.0, detection.no_edge_costs(rows, columns))
    if not isinstance(detection, FilterDetection):
        edge = whole - score - no_edge
        return CostSplit({"score": score, "edge": edge, "no edge": no_edge, "link": link})
    strength = np.zeros(width)
    strength[on_edge] = detection.edge_rest[pixels[on_edge]]
    terrain = _terrain(detection, rows, columns)
    return CostSplit(
        {
            "score": score,
            "strength": strength,
            "no edge": no_edge,
            "clear sky": whole - score - strength - no_edge - terrain,
            "terrain": terrain,
            "link": link,
        }
    )


def _terrain(detection: FilterDetection, rows: Int, columns: npt.NDArray[np.integer]) -> F64:
    weight = detection.config.terrain_weight
    if not weight or not len(detection.scores):
        return np.zeros(len(columns))
    height, width = detection.edges.shape
    blocks = np.zeros((width, height), np.float32).T
    above = terrain_above(detection.photo, detection.edges, detection.bank.terrain)
    add_blocks(blocks, above, weight, BLOCK)
    terrain: F64 = blocks[rows, columns].astype(np.float64)
    return terrain


def edge_index(detection: Detection) -> Int:
    """Place of each pixel among the edge pixels, ``(H, W)``; -1 where there is no edge."""
    index = np.full(detection.edges.shape, -1, np.int32)
    index[detection.edge_rows, detection.edge_columns] = np.arange(len(detection.scores))
    return index
