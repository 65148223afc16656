"""The gradient cost ``G_r`` of Ahmad et al. (equations 4 to 7): cheap where strong and even."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, check_photo
from skyline_viz.detection import Detection, solve_detection, timed
from skyline_viz.edges import to_grey


@dataclass(frozen=True)
class GradientCost:
    """Every pixel is a candidate, and costs ``G_r``."""

    name: str = "gradient"
    """Its name."""

    w1: float = 0.5
    """Weight of the difference between neighbours against the magnitude, in [0, 1]."""

    delta: int = 1
    """Largest change of row between neighbouring columns, in pixels."""

    link_weight: float = 0.0
    """Link cost of one pixel of row change."""

    def detect(self, photo: U8) -> Detection:
        """Find the skyline of a photo ``(H, W, 3)`` uint8 RGB."""
        check_photo(photo)
        seconds: dict[str, float] = {}
        with timed(seconds, "cost"):
            cost = gradient_cost(photo, self.w1)
        return solve_detection(
            self.name,
            photo,
            np.ones(cost.shape, np.bool_),
            (1 - cost).ravel(),
            cost,
            seconds,
            delta=self.delta,
            link_weight=self.link_weight,
            non_edge_cost=1.0,
        )


def gradient_cost(photo: U8, w1: float = 0.5) -> F32:
    """``G_r = w1 d + (1 - w1) (1 - g)`` of every pixel, ``(H, W)`` in [0, 1] (equation 6).

    ``g`` is the magnitude of the 3x3 Sobel gradient of the grey photo (equation 4) and ``d`` its
    difference from that of the pixel to the right (equation 5), each over its maximum.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        w1: Weight of the difference, in [0, 1].
    """
    grey = to_grey(photo)
    across = cv2.Sobel(grey, cv2.CV_32F, 1, 0, ksize=3)
    down = cv2.Sobel(grey, cv2.CV_32F, 0, 1, ksize=3)
    magnitude = cv2.magnitude(across, down)
    difference = np.abs(np.diff(magnitude, axis=1, append=magnitude[:, -1:]))
    cost: F32 = w1 * _over_maximum(difference) + (1 - w1) * (1 - _over_maximum(magnitude))
    return cost.astype(np.float32)


def _over_maximum(values: F32) -> F32:
    top = float(values.max(initial=0.0))
    return values / np.float32(top) if top > 0 else values
