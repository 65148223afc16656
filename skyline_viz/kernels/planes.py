"""The channels of a photo one by one, with a border around them."""

import cv2
import numpy as np

from skyline_viz.arrays import U8


def padded_planes(photo: U8, reach: int) -> U8:
    """Channels ``(C, H + 2 reach, W + 2 reach)`` of a photo, whose rim is repeated around it.

    Loops over one channel run over neighbouring bytes, and need no case for the rim.

    Args:
        photo: ``(H, W, 3)`` RGB, or ``(H, W)`` grey; uint8.
        reach: Width of the border, in pixels.

    Examples:
        >>> padded_planes(np.array([[1, 2]], np.uint8), 1).tolist()
        [[[1, 1, 2, 2], [1, 1, 2, 2], [1, 1, 2, 2]]]
    """
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
