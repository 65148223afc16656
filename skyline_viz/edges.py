"""Stage 1, edges: the candidate pixels of the skyline (the paper's ``E(i, j)``, equation 1)."""

import cv2
import numba
import numpy as np

from skyline_viz.arrays import U8, Bool, Int
from skyline_viz.config import EdgeSource

STRONG_PERCENTILE = 95
"""Percentile of a photo's gradients that stands for its strong ones."""

STRONG_SHARE = 0.6
"""Upper threshold, as a share of the strong gradients."""

NOISE_PERCENTILE = 20
"""Percentile of a photo's gradients that stands for its noise."""

NOISE_MULTIPLE = 4.0
"""The upper threshold stays above this multiple of the noise."""

LOWEST_FACTOR = 0.3
"""The thresholds are lowered to this share at the most."""

GRADIENT_STEP = 4
"""Gradients are sampled this many pixels apart."""


def to_grey(photo: U8) -> U8:
    """Grey photo ``(H, W)`` uint8 of an RGB photo ``(H, W, 3)``, with the weights of ITU-R 601."""
    grey: U8 = cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)
    return grey


def find_edges(photo: U8, source: EdgeSource, low: float, high: float) -> Bool:
    """Canny edges of an RGB photo.

    In colour, the gradient of each pixel is that of the channel in which it is strongest: a blue
    ridge under a blue sky of the same grey is found all the same.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        source: Whether to look at the grey or the colour photo.
        low: Lower hysteresis threshold, on the 3x3 Sobel gradient of 8-bit values (L1 norm).
        high: Upper hysteresis threshold, same unit.

    Returns:
        ``(H, W)`` bool, True on edge pixels.
    """
    seen = to_grey(photo) if source == "grey" else photo
    # where two rows have the same gradient Canny takes the upper one, which on a sharp skyline is
    # sky; upside down it takes the first row of terrain
    edges: U8 = cv2.flip(cv2.Canny(cv2.flip(seen, 0), low, high), 0)
    return edges > 0


def fitted_thresholds(photo: U8, low: float, high: float) -> tuple[float, float]:
    """Canny thresholds lowered for a soft or hazy photo, as far as its noise allows.

    Fixed thresholds miss the skyline of a photo that is a little out of focus. The strong
    gradients of the photo say how far to go down, the weak ones (usually sky) where its grain
    begins. The thresholds keep their ratio and are never raised.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        low: Lower threshold for a crisp photo.
        high: Upper threshold for a crisp photo.
    """
    weak, strong = np.percentile(_sampled_gradients(photo), (NOISE_PERCENTILE, STRONG_PERCENTILE))
    wanted = max(STRONG_SHARE * strong, NOISE_MULTIPLE * weak) / high
    factor = min(max(wanted, LOWEST_FACTOR), 1.0)
    return low * factor, high * factor


def edge_pixels(edges: Bool) -> tuple[Int, Int]:
    """Rows and columns of the edge pixels, two ``(n,)`` int32 arrays, row by row.

    >>> edge_pixels(np.array([[False, True], [True, False]]))
    (array([0, 1], dtype=int32), array([1, 0], dtype=int32))
    """
    flat = np.flatnonzero(edges).astype(np.int32)
    rows = flat // np.int32(edges.shape[1])
    return rows, flat - rows * np.int32(edges.shape[1])


@numba.njit(cache=True, nogil=True)
def _sampled_gradients(photo: U8) -> Int:
    """Gradient, as Canny measures it, of every fourth pixel of every fourth row."""
    height, width, channels = photo.shape
    step = GRADIENT_STEP
    gradients = np.zeros(((height - 3) // step + 1, (width - 3) // step + 1), np.int32)
    for row in range(1, height - 1, step):
        for column in range(1, width - 1, step):
            strongest = 0
            for channel in range(channels):
                across = 0
                down = 0
                for offset, weight in ((-1, 1), (0, 2), (1, 1)):
                    across += weight * (
                        np.int32(photo[row + offset, column + 1, channel])
                        - np.int32(photo[row + offset, column - 1, channel])
                    )
                    down += weight * (
                        np.int32(photo[row + 1, column + offset, channel])
                        - np.int32(photo[row - 1, column + offset, channel])
                    )
                strongest = max(strongest, abs(across) + abs(down))
            gradients[row // step, column // step] = strongest
    return gradients
