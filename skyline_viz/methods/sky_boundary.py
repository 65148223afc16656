"""From a map of sky probabilities to a skyline: the boundary that best splits every column.

A line at a row puts all pixels above into the sky and the others into the terrain. By the
probabilities, a number of pixels of the column is then expected to be on the wrong side; the row
with the fewest splits its column best, and scores 1. Rows with `SCALE` more wrong pixels score 1/e,
and so on, and a pixel costs ``1 - score``. A hole in the terrain or a cloud with a hard edge thus
costs a column no more than a single node, and the path passes over it.
"""

from __future__ import annotations

import numpy as np

from skyline_viz.arrays import F32, U8
from skyline_viz.detection import Detection, solve_detection

MAP = "sky probability"
"""Name of the map in `Detection.maps`."""

SCALE = 10.0
"""Wrong pixels of a column, more than its best row has, that lower a score to 1/e; at 519 rows."""

LINK_WEIGHT = 0.005
"""Link cost of one pixel of row change, at 519 rows."""

STEEPEST = 1 / 12
"""Largest change of row between neighbouring columns, as a share of the rows."""

ROWS = 519
"""Rows of the photos for which the lengths are meant; others have them in proportion."""


def detect_boundary(method: str, photo: U8, sky: F32, seconds: dict[str, float]) -> Detection:
    """Find the skyline in a map of sky probabilities.

    Args:
        method: Name of the method.
        photo: ``(H, W, 3)`` uint8 RGB.
        sky: ``(H, W)`` probability that a pixel is sky.
        seconds: Seconds of the stages so far.
    """
    height = len(sky)
    scores = boundary_scores(sky)
    return solve_detection(
        method,
        photo,
        np.ones(sky.shape, np.bool_),
        scores.ravel(),
        1 - scores,
        seconds,
        delta=max(round(STEEPEST * height), 1),
        link_weight=LINK_WEIGHT * ROWS / height,
        non_edge_cost=1.0,
        maps={MAP: sky},
    )


def boundary_scores(sky: F32, scale: float = SCALE) -> F32:
    """How well a line at each pixel would split its column, ``(H, W)`` in [0, 1]; 1 is its best.

    Args:
        sky: ``(H, W)`` probability that a pixel is sky.
        scale: Wrong pixels that lower a score to 1/e, at `ROWS` rows.

    >>> int(boundary_scores(np.array([[0.9], [0.8], [0.1]], np.float32)).argmax())
    2
    """
    # pixels above that are terrain, and pixels from here on that are sky, up to a constant
    wrong = np.cumsum(1 - 2 * sky.astype(np.float64), axis=0)
    wrong = np.vstack([np.zeros_like(wrong[:1]), wrong[:-1]])
    more = wrong - wrong.min(axis=0)
    scores: F32 = np.exp(-more / (scale * len(sky) / ROWS)).astype(np.float32)
    return scores
