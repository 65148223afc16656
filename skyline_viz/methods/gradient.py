"""The gradient cost ``G_r`` of Ahmad et al. (equations 4 to 7): strong, even gradients are cheap.

The papers name neither the operator, the weight ``w1``, nor ``delta``. Every pixel is a candidate:
the smallest published error, 0.15, is below that of all their methods that keep to Canny edges.
Measured on 40 of the Web photographs, mean, median and photos under 4 pixels:

==========================================  ======  ======  ======
operator, ``w1``                              mean  median   < 4
==========================================  ======  ======  ======
Sobel, 0.5                                    61.1    0.38   26/40
after a Gaussian of ``sqrt(2)``, 0.5          42.4    0.27   30/40
after a Gaussian of ``sqrt(2)``, 0.9          19.3    0.63   28/40
after a Gaussian of 3, 0.9 (the default)      12.3    0.68   36/40
published, all 80 photographs                 11.9       -       -
==========================================  ======  ======  ======

With an even weight the magnitude rules, and the path takes the strongest edges of the foreground,
the more so with a larger ``delta``. What the difference adds is that texture is dear, and for
that the gradient has to be that of a smoothed photo: without, its noise is dear, too. Of the
weights from 0.5 to 0.95, 0.9 is the best on either half of the photographs. The mean remains one
of whole lines: three photos with an edge in the foreground that is stronger, or more even.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, check_photo
from skyline_viz.detection import Detection, solve_detection, timed
from skyline_viz.edges import to_grey
from skyline_viz.frames.finding import find_frame
from skyline_viz.frames.frame import without_frame
from skyline_viz.system.settings import Configured, Presets, within

W1 = 0.9
"""Weight of the difference between neighbours against the magnitude."""

SIGMA = 3.0
"""Width of the smoothing before the gradient, in pixels."""


@dataclass(frozen=True)
class GradientCost(Configured):
    """Every pixel is a candidate, and costs ``G_r``."""

    PRESETS: ClassVar[Presets] = {"gradient": {}}

    w1: float = within(W1, 0, 1)
    """Weight of the difference between neighbours against the magnitude, in [0, 1]."""

    sigma: float = within(SIGMA, 0, 1000)
    """Width of the smoothing before the gradient, in pixels; 0 for none."""

    delta: int = 1
    """Largest change of row between neighbouring columns, in pixels."""

    link_weight: float = 0.0
    """Link cost of one pixel of row change."""

    def detect(self, photo: U8) -> Detection:
        """Find the skyline of a photo ``(H, W, 3)`` uint8 RGB."""
        check_photo(photo)
        seconds: dict[str, float] = {}
        with timed(seconds, "cost"):
            cost = gradient_cost(without_frame(photo, find_frame(photo)), self.w1, self.sigma)
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


def gradient_cost(photo: U8, w1: float = W1, sigma: float = SIGMA) -> F32:
    """``G_r = w1 d + (1 - w1) (1 - g)`` of every pixel, ``(H, W)`` in [0, 1] (equation 6).

    ``g`` is the magnitude of the 3x3 Sobel gradient of the smoothed grey photo (equation 4) and
    ``d`` its difference from that of the pixel to the right (equation 5), each over its maximum.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        w1: Weight of the difference, in [0, 1].
        sigma: Width of the smoothing, in pixels; 0 for none.
    """
    grey = to_grey(photo).astype(np.float32)
    if sigma > 0:
        grey = cv2.GaussianBlur(grey, (0, 0), sigma)
    across = cv2.Sobel(grey, cv2.CV_32F, 1, 0, ksize=3)
    down = cv2.Sobel(grey, cv2.CV_32F, 0, 1, ksize=3)
    magnitude = cv2.magnitude(across, down)
    difference = np.abs(np.diff(magnitude, axis=1, append=magnitude[:, -1:]))
    cost: F32 = w1 * _over_maximum(difference) + (1 - w1) * (1 - _over_maximum(magnitude))
    return cost.astype(np.float32)


def _over_maximum(values: F32) -> F32:
    top = float(values.max(initial=0.0))
    return values / np.float32(top) if top > 0 else values
