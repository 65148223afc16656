"""3x3 Sobel gradients of the channel in which they are strongest, a row at a time.

The filter is separable: sums and differences down the columns first, kept for one row and one
channel, and then along the row. So each loop touches few arrays, and all of its numbers fit into 16
bits: the processor works on 16 or 32 pixels at once.
"""

import numba
import numpy as np

from skyline_viz.arrays import I16, U8
from skyline_viz.kernels.planes import REACH

_FIRST = REACH - 1  # of the planes' rows and columns: the filter needs a pixel around
_1, _2 = np.uintp(1), np.uintp(2)


def sampled_strengths(planes: U8, step: int) -> I16:
    """L1 norm of the gradients at every `step`-th row and column, ``(n,)``.

    Columns are counted from the first one on, rows from the last one upwards.

    Args:
        planes: ``(C, H + 6, W + 6)``, see `planes.padded_planes`.
        step: From one to the next, in pixels.
    """
    height, width = planes.shape[1] - 2 * REACH, planes.shape[2] - 2 * REACH
    strengths = np.empty((-(-height // step), -(-width // step)), np.int16)
    _sample(planes, step, strengths)
    return strengths.ravel()


@numba.njit(cache=True, nogil=True)
def _sample(planes: U8, step: int, strengths: I16) -> None:
    """Fill the strengths ``(H / step, W / step)``, both rounded up."""
    height, width = planes.shape[1] - 2 * REACH, planes.shape[2] - 2 * REACH
    columns = np.empty((2, width + 2), np.int16)
    x, y = np.empty(width, np.int16), np.empty(width, np.int16)
    strength = np.empty(width + 2, np.int16)
    for at in range(len(strengths)):
        gradients(planes, height - 1 - at * step, columns, x, y, strength)
        strengths[at] = strength[1 : width + 1 : step]


@numba.njit(cache=True, nogil=True)
def gradients(planes: U8, row: int, columns: I16, x: I16, y: I16, strength: I16) -> None:
    """Write the gradients of a row, channel after channel while they are in the cache.

    Of equally strong channels the first one wins.

    Args:
        planes: ``(C, H + 6, W + 6)``, see `planes.padded_planes`.
        row: Which row of the photo.
        columns: ``(2, W + 2)`` room for sums and differences.
        x: ``(W,)`` is filled with the gradients along the row, in [-1020, 1020].
        y: ``(W,)`` is filled with those down the columns, likewise.
        strength: ``(W + 2,)`` is filled with their L1 norm, all but its first and last entry.
    """
    first, end = _FIRST, _FIRST + len(strength)
    smooth, change = columns[0], columns[1]
    for channel in range(len(planes)):
        above = planes[channel, row + _FIRST, first:end]
        here = planes[channel, row + _FIRST + 1, first:end]
        below = planes[channel, row + _FIRST + 2, first:end]
        _smooth(above, here, below, smooth)
        _change(above, below, change)
        if channel == 0:
            _sideways(smooth, change, x, y, strength)
        else:
            _sideways_if_stronger(smooth, change, x, y, strength)


@numba.njit(cache=True, nogil=True)
def _smooth(above: U8, here: U8, below: U8, smooth: I16) -> None:
    """Write ``above + 2 here + below``.

    A loop of its own: in one with `_change` the compiler gives up, and takes three times as long.
    """
    for column in range(np.uintp(len(smooth))):
        twice = np.int16(np.int16(here[column]) + np.int16(here[column]))
        both = np.int16(np.int16(above[column]) + np.int16(below[column]))
        smooth[column] = np.int16(both + twice)


@numba.njit(cache=True, nogil=True)
def _change(above: U8, below: U8, change: I16) -> None:
    """Write ``below - above``."""
    for column in range(np.uintp(len(change))):
        change[column] = np.int16(np.int16(below[column]) - np.int16(above[column]))


@numba.njit(cache=True, nogil=True)
def _sideways(smooth: I16, change: I16, x: I16, y: I16, strength: I16) -> None:
    """Write the gradients of a row of one channel."""
    for column in range(np.uintp(len(x))):
        new_x = np.int16(smooth[column + _2] - smooth[column])
        twice = np.int16(change[column + _1] + change[column + _1])
        new_y = np.int16(np.int16(change[column] + change[column + _2]) + twice)
        x[column], y[column] = new_x, new_y
        both = np.int16(max(new_x, np.int16(-new_x))) + np.int16(max(new_y, np.int16(-new_y)))
        strength[column + _1] = np.int16(both)


@numba.njit(cache=True, nogil=True)
def _sideways_if_stronger(smooth: I16, change: I16, x: I16, y: I16, strength: I16) -> None:
    """Take the gradients of a further channel where these are stronger than those so far."""
    for column in range(np.uintp(len(x))):
        new_x = np.int16(smooth[column + _2] - smooth[column])
        twice = np.int16(change[column + _1] + change[column + _1])
        new_y = np.int16(np.int16(change[column] + change[column + _2]) + twice)
        both = np.int16(max(new_x, np.int16(-new_x))) + np.int16(max(new_y, np.int16(-new_y)))
        new, old = np.int16(both), strength[column + _1]
        x[column] = new_x if new > old else x[column]
        y[column] = new_y if new > old else y[column]
        strength[column + _1] = max(new, old)
