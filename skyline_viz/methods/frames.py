"""Picture frames: a line drawn around a photo is a stronger edge than any skyline in it."""

from __future__ import annotations

from skyline_viz.arrays import U8
from skyline_viz.edges import FRAME_SHARE, find_edges

FRAME_ROWS = 4
"""Rows at the top and at the bottom in which a frame's edge is looked for."""


def without_frame(photo: U8, low: float = 50.0, high: float = 220.0) -> U8:
    """The photo with the rows of its frame painted like the first row inside.

    A row near the top or the bottom that is an edge over more than half of its length is one of a
    frame, as in `edges.candidate_edges`. Painting it over, instead of leaving out its edges,
    removes its gradients as well.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        low: Lower Canny threshold.
        high: Upper Canny threshold.

    Returns:
        ``(H, W, 3)`` uint8; the photo itself where it has no frame.
    """
    height = len(photo)
    rows = min(FRAME_ROWS, height // 4)
    edges, _ = find_edges(photo, "grey", low, high)
    full = edges.mean(axis=1) > FRAME_SHARE
    top = max((row + 2 for row in range(rows) if full[row]), default=0)
    bottom = max((row + 2 for row in range(rows) if full[height - 1 - row]), default=0)
    if top + bottom in {0, height}:
        return photo
    painted = photo.copy()
    painted[:top] = photo[top]
    painted[height - bottom :] = photo[height - 1 - bottom]
    return painted
