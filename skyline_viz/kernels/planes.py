"""The channels of a photo one by one, with a border around them."""

import cv2
import numpy as np

from skyline_viz.arrays import U8

REACH = 3
"""Width of the border, in pixels: what the window of the structure tensor needs."""


def padded_planes(photo: U8) -> U8:
    """Channels ``(C, H + 6, W + 6)`` of a photo, whose rim is repeated around it.

    Loops over one channel run over neighbouring bytes, and need no case for the rim. Edges and
    structure tensor read the same planes: making them takes as long as half of Sobel's filter.

    Args:
        photo: ``(H, W, 3)`` RGB, or ``(H, W)`` grey; uint8.

    Examples:
        >>> padded_planes(np.array([[1, 2]], np.uint8))[0, 0].tolist()
        [1, 1, 1, 1, 2, 2, 2, 2]
    """
    reach = REACH
    height, width = photo.shape[:2]
    count = 1 if photo.ndim == 2 else photo.shape[2]
    planes = np.empty((count, height + 2 * reach, width + 2 * reach), np.uint8)
    rows, columns = slice(reach, reach + height), slice(reach, reach + width)
    if photo.ndim == 2:
        planes[0, rows, columns] = photo
    else:
        cv2.split(photo, [plane[rows, columns] for plane in planes])
    planes[:, rows, :reach] = planes[:, rows, reach : reach + 1]
    planes[:, rows, reach + width :] = planes[:, rows, reach + width - 1 : reach + width]
    planes[:, :reach] = planes[:, reach : reach + 1]
    planes[:, reach + height :] = planes[:, reach + height - 1 : reach + height]
    return planes
