"""3x3 Sobel gradients of the channel in which they are strongest.

The filter is separable: sums and differences down the columns first, kept for one row and one
channel, and then along the row. So each loop touches few arrays, and all of its numbers fit into 16
bits: the processor works on 16 or 32 pixels at once.
"""

import numba
import numpy as np

from skyline_viz.arrays import I16, U8


def sobel(planes: U8) -> tuple[I16, I16]:
    """Gradients along the rows and along the columns, each ``(H, W)`` int16, in [-1020, 1020].

    Of equally strong channels the first one wins.

    Args:
        planes: ``(C, H + 2, W + 2)``: channels with a border of a pixel.

    Examples:
        >>> planes = np.zeros((1, 3, 4), np.uint8)
        >>> planes[0, 2] = 10
        >>> across, down = sobel(planes)
        >>> across.tolist(), down.tolist()
        ([[0, 0]], [[40, 40]])
    """
    height, width = planes.shape[1] - 2, planes.shape[2] - 2
    across, down = (np.empty((height, width), np.int16) for _ in range(2))
    _sobel(planes, across, down)
    return across, down


@numba.njit(cache=True, nogil=True)
def _sobel(planes: U8, across: I16, down: I16) -> None:
    """Fill the gradients, channel after channel while their row is in the cache."""
    height, width = across.shape
    smooth, change = (np.empty(width + 2, np.int16), np.empty(width + 2, np.int16))
    x, y = (np.empty(width, np.int16), np.empty(width, np.int16))
    for row in range(height):
        _downwards(planes[0, row], planes[0, row + 1], planes[0, row + 2], smooth, change)
        _sideways(smooth, change, across[row], down[row])
        for other in range(1, len(planes)):
            above, here, below = planes[other, row], planes[other, row + 1], planes[other, row + 2]
            _downwards(above, here, below, smooth, change)
            _sideways(smooth, change, x, y)
            _take_stronger(x, y, across[row], down[row])


@numba.njit(cache=True, nogil=True)
def _downwards(above: U8, here: U8, below: U8, smooth: I16, change: I16) -> None:
    """Write ``above + 2 here + below`` and ``below - above``."""
    for column in range(len(above)):
        upper, lower = np.int16(above[column]), np.int16(below[column])
        twice = np.int16(np.int16(here[column]) + np.int16(here[column]))
        smooth[column] = np.int16(np.int16(upper + lower) + twice)
        change[column] = np.int16(lower - upper)


@numba.njit(cache=True, nogil=True)
def _sideways(smooth: I16, change: I16, x: I16, y: I16) -> None:
    """Write the gradients of a row of one channel."""
    for column in range(len(x)):
        x[column] = np.int16(smooth[column + 2] - smooth[column])
        twice = np.int16(change[column + 1] + change[column + 1])
        y[column] = np.int16(np.int16(change[column] + change[column + 2]) + twice)


@numba.njit(cache=True, nogil=True)
def _take_stronger(x: I16, y: I16, across: I16, down: I16) -> None:
    """Take the gradients of a further channel where these are stronger than those so far."""
    for column in range(len(x)):
        old_x, old_y, new_x, new_y = across[column], down[column], x[column], y[column]
        old = np.int16(max(old_x, np.int16(-old_x))) + np.int16(max(old_y, np.int16(-old_y)))
        new = np.int16(max(new_x, np.int16(-new_x))) + np.int16(max(new_y, np.int16(-new_y)))
        stronger = np.int16(new) > np.int16(old)
        across[column] = new_x if stronger else old_x
        down[column] = new_y if stronger else old_y
