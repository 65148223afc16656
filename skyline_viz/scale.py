"""Photos larger than the filters were made for: reduced for the search, then refined.

A filter of 7x7 taps sees a ridge in a photo of about a megapixel; in one of 12 it sees texture.
So a large photo is searched at the working size, and its skyline is then found again in full
resolution, within a band around the line that the search gave.
"""

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8
from skyline_viz.skyline import Skyline

BAND_ROWS = 3.0
"""Half height of the band, in rows of the reduced photo."""


def reduction(height: int, width: int, working_megapixels: float) -> float:
    """Factor by which a photo is larger than the working size, per side; 1 when it is not.

    >>> reduction(3000, 4000, 0.75)
    4.0
    """
    return float(max(1.0, (height * width / (working_megapixels * 1e6)) ** 0.5))


def reduced(photo: U8, factor: float) -> U8:
    """Photo reduced by a factor a side, each pixel the mean of those that it covers."""
    height, width = photo.shape[:2]
    size = (max(2, round(width / factor)), max(2, round(height / factor)))
    smaller: U8 = cv2.resize(photo, size, interpolation=cv2.INTER_AREA)
    return smaller


def rescaled(skyline: Skyline, from_height: int, height: int, width: int) -> Skyline:
    """Skyline of a photo, carried over to the same photo at another size.

    A row is the upper edge of the first terrain pixel, so rows scale from the top of the photo;
    columns scale about pixel centres.

    Args:
        skyline: The line in a photo that is `from_height` rows high.
        from_height: Rows of the photo that the line belongs to.
        height: Rows of the other photo.
        width: Columns of the other photo.
    """
    centres = (np.arange(width) + 0.5) * (skyline.width / width) - 0.5
    rows = np.interp(centres, np.arange(skyline.width), skyline.rows) * (height / from_height)
    nearest = np.clip(np.rint(centres).astype(np.intp), 0, skyline.width - 1)
    return Skyline(rows=rows.astype(np.float32), visible=skyline.visible[nearest])


def band_distance(around: F32, height: int, half_height: float) -> F32:
    """Distance of every pixel from a line, in half heights of the band: ``(H, W)``, 1 at its rim."""
    rows = np.arange(height, dtype=np.float32)
    return (np.abs(rows[None, :] - around[:, None]) / np.float32(half_height)).T
