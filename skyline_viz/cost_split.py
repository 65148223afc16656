"""What a line pays for, column by column: score, strength, no edge, clear sky, terrain, links."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from skyline_viz.arrays import F64, Int
from skyline_viz.cost import add_blocks, normalised
from skyline_viz.detector import Detection
from skyline_viz.terrain import BLOCK, terrain_above


@dataclass(frozen=True, eq=False)
class CostSplit:
    """Costs of a line in each column, ``(W,)`` each; the path search sums all of them."""

    score: F64
    """``v (1 - score)`` where it crosses an edge."""

    strength: F64
    """``(1 - v) (1 - strength)`` where it crosses an edge."""

    no_edge: F64
    """What a pixel without an edge costs."""

    clear_sky: F64
    """For the edge pixels above."""

    terrain: F64
    """For what looks like terrain above; negative where it looks like sky."""

    link: F64
    """For the change of row from the column before."""

    def totals(self, first: int, last: int) -> dict[str, float]:
        """Sums over the columns from `first` to `last`, stage by stage."""
        part = slice(first, last + 1)
        return {one.name: float(getattr(self, one.name)[part].sum()) for one in fields(self)}


def split_cost(detection: Detection, rows: Int) -> CostSplit:
    """Split the cost of a line.

    Args:
        detection: The detection.
        rows: ``(W,)`` row of the line in each column, inside the photo.
    """
    config = detection.config
    height, width = detection.edges.shape
    columns = np.arange(width)
    pixels = edge_index(detection)[rows, columns]
    on_edge = pixels >= 0
    strength = normalised(detection.strength, config.strength_percentile)
    score_part, strength_part = np.zeros(width), np.zeros(width)
    found = pixels[on_edge]
    score_part[on_edge] = config.v * (1 - detection.scores[found])
    strength_part[on_edge] = (1 - config.v) * (1 - strength[found])
    no_edge = np.where(on_edge, 0.0, config.non_edge_cost)
    terrain = np.zeros(width)
    if config.terrain_weight and len(detection.scores):
        blocks = np.zeros((width, height), np.float32).T
        above = terrain_above(detection.photo, detection.edges, detection.bank.terrain)
        add_blocks(blocks, above, config.terrain_weight, BLOCK)
        terrain = blocks[rows, columns].astype(np.float64)
    whole = detection.cost[rows, columns].astype(np.float64)
    link = config.link_weight * np.abs(np.diff(rows, prepend=rows[:1])).astype(np.float64)
    return CostSplit(
        score=score_part,
        strength=strength_part,
        no_edge=no_edge,
        clear_sky=whole - score_part - strength_part - no_edge - terrain,
        terrain=terrain,
        link=link,
    )


def edge_index(detection: Detection) -> Int:
    """Place of each pixel among the edge pixels, ``(H, W)``; -1 where there is no edge."""
    index = np.full(detection.edges.shape, -1, np.int32)
    index[detection.edge_rows, detection.edge_columns] = np.arange(len(detection.scores))
    return index
