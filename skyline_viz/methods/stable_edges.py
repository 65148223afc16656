"""MSEE: the Canny edges that stay over a range of thresholds (Ahmad et al. 2013)."""

from __future__ import annotations

import cv2
import numpy as np

from skyline_viz.arrays import U8, Bool
from skyline_viz.edges import to_grey

LOWER, UPPER = 50, 220
"""Range of the upper Canny threshold; the lower one is half of it."""

LEVELS = 8
"""Thresholds that are tried."""

STABLE = 4
"""At how many neighbouring ones of them an edge pixel has to be found."""


def stable_edges(photo: U8) -> Bool:
    """Edge pixels ``(H, W)`` of a photo ``(H, W, 3)`` uint8 RGB that stay over a range."""
    grey = to_grey(photo)
    found = np.zeros(grey.shape, np.uint8)
    for high in np.linspace(LOWER, UPPER, LEVELS):
        found += cv2.Canny(grey, high / 2, high) > 0
    stable: Bool = found >= STABLE
    return stable
