"""Canny's edge map of gradients that are known: non-maximum suppression and hysteresis.

The result is that of ``cv2.Canny`` on the photo turned upside down, bit for bit. Where two rows
have the same gradient Canny takes the upper one, which on a sharp skyline is sky; upside down it
takes the first row of terrain. Nothing is turned here: the comparisons look the other way.

Suppression asks the same few questions of every pixel, so it is written without a branch, and the
processor answers them for many pixels at once. Hysteresis follows edges from pixel to pixel, which
no processor does fast; but a word of 64 bits holds 64 pixels, and an addition carries along a run
of ones as far as it goes.
"""

import math
from typing import TypeAlias

import numba
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import I16, Bool

STEEPEST = 2040
"""The largest sum of both gradients that a 3x3 Sobel filter of 8-bit values can give."""

_TAN = np.float32(13573)  # tan(22.5 degrees) in fixed point, as OpenCV has it
_ONE = np.float32(1 << 15)  # and 1 in the same unit

Words: TypeAlias = npt.NDArray[np.uint64]
"""Pixels, 64 to a word."""

_1, _63 = np.uint64(1), np.uint64(63)  # numba makes floats of words and signed numbers
_DOUBLING = tuple(np.uint64(1 << power) for power in range(6))


def canny(across: I16, down: I16, low: float, high: float) -> Bool:
    """Edge map ``(H, W)`` of gradients.

    Args:
        across: ``(H, W)`` Sobel gradient along the rows, in [-1020, 1020].
        down: ``(H, W)`` Sobel gradient along the columns, likewise.
        low: Pixels above this L1 gradient are edges if such pixels lead to one above `high`.
        high: Pixels above it always are.

    Examples:
        A step down a column: of its two rows the lower one is the edge.

        >>> down = np.zeros((6, 4), np.int16)
        >>> down[2:4] = -400
        >>> np.flatnonzero(canny(0 * down, down, 50, 220).all(axis=1))
        array([3])
    """
    height, width = across.shape
    if height == 0 or width == 0:
        return np.zeros((height, width), np.bool_)
    floor, start = (int(min(max(math.floor(one), 0), STEEPEST)) for one in sorted((low, high)))
    strength = np.zeros((height + 2, width + 2), np.int16)  # a rim of zeros: beyond is no edge
    _strengths(across, down, strength)
    words = -(-width // 64)
    kept = np.zeros((2, height, words * 64), np.bool_)
    _suppress(across, down, strength, np.int16(floor), np.int16(start), kept)
    weak, strong = np.packbits(kept, axis=2, bitorder="little").view(np.uint64)
    _follow(strong, weak)
    edges = np.unpackbits(strong.view(np.uint8), axis=1, count=width, bitorder="little")
    return edges.view(np.bool_)


@numba.njit(cache=True, nogil=True)
def _strengths(across: I16, down: I16, strength: I16) -> None:
    """Write the L1 gradients inside the rim of an array ``(H + 2, W + 2)``.

    A pass of its own: in the loop of the Sobel filter it would be one array too many.
    """
    height, width = across.shape
    for row in range(height):
        for column in range(width):
            x = across[row, column]
            y = down[row, column]
            both = np.int16(max(x, np.int16(-x))) + np.int16(max(y, np.int16(-y)))
            strength[row + 1, column + 1] = np.int16(both)


@numba.njit(cache=True, nogil=True)
def _suppress(across: I16, down: I16, strength: I16, low: int, high: int, kept: Bool) -> None:
    """Mark the pixels above the thresholds that are the strongest across their edge.

    Three directions are told apart: the gradient is within 22.5 degrees of a row, of a column, or
    of neither. All are compared, and the one that holds is chosen with ``&`` and ``|``: a branch
    would make the loop a pixel at a time. What is squeezed into float32 are whole numbers below
    2^24, or such times a power of two: exact.

    Args:
        across: ``(H, W)``.
        down: ``(H, W)``.
        strength: ``(H + 2, W + 2)``, see `_strengths`.
        low: The lower threshold.
        high: The upper one.
        kept: ``(2, H, W)`` or wider: pixels above the lower threshold, and above the upper one.
    """
    height, width = across.shape
    for row in range(height):
        above, here, below = strength[row], strength[row + 1], strength[row + 2]
        for column in range(width):
            middle = here[column + 1]
            x = across[row, column]
            y = down[row, column]
            wide = np.float32(max(x, np.int16(-x)))
            tall = np.float32(max(y, np.int16(-y)))
            limit = wide * _TAN
            along_row = tall * _ONE < limit
            along_column = (tall - wide - wide) * _ONE > limit
            one_sign = np.int16(x ^ y) >= 0
            row_best = (middle > here[column]) & (middle >= here[column + 2])
            column_best = (middle > below[column + 1]) & (middle >= above[column + 1])
            falling_best = (middle > below[column + 2]) & (middle > above[column])
            rising_best = (middle > below[column]) & (middle > above[column + 2])
            aslant_best = (one_sign & falling_best) | (~one_sign & rising_best)
            upright = (along_column & column_best) | (~along_column & aslant_best)
            best = (along_row & row_best) | (~along_row & upright)
            kept[0, row, column] = best & (middle > low)
            kept[1, row, column] = best & (middle > high)


@numba.njit(cache=True, nogil=True)
def _follow(strong: Words, weak: Words) -> None:
    """Add to the strong pixels all weak ones that lead to them, through any of 8 neighbours.

    Rows pass on what they have to the row below and, from the last one back, to the row above; only
    those do that have gained a pixel since they last did. A few such rounds are enough: edges that
    wind up and down many times are rare.

    Args:
        strong: ``(H, W / 64)`` a bit for each pixel, the lowest one first; changed in place.
        weak: ``(H, W / 64)`` likewise, with the strong ones among them.
    """
    height = len(strong)
    due = np.ones((2, height), np.bool_)  # rows to pass on downwards, and upwards
    for row in range(height):
        _run_along(strong[row], weak[row])
    while due[0].any():
        for row in range(height - 1):
            if due[0, row] and _touch(strong[row], strong[row + 1], weak[row + 1]):
                due[:, row + 1] = True
            due[0, row] = False
        due[0, height - 1] = False
        for row in range(height - 1, 0, -1):
            if due[1, row] and _touch(strong[row], strong[row - 1], weak[row - 1]):
                due[:, row - 1] = True
            due[1, row] = False
        due[1] = False


@numba.njit(cache=True, nogil=True)
def _touch(near: Words, strong: Words, weak: Words) -> bool:
    """Make strong what is weak next to the strong pixels of a neighbouring row; tell if any was.

    Args:
        near: Strong pixels of the neighbouring row.
        strong: Those of this row, changed in place.
        weak: Its weak ones.
    """
    last = len(near) - 1
    gained = np.uint64(0)
    for word in range(last + 1):
        here = near[word]
        around = here | (here << _1) | (here >> _1)
        if word > 0:
            around |= near[word - 1] >> _63
        if word < last:
            around |= near[word + 1] << _63
        new = around & weak[word] & ~strong[word]
        gained |= new
        strong[word] |= new
    if gained == 0:
        return False
    _run_along(strong, weak)
    return True


@numba.njit(cache=True, nogil=True)
def _run_along(strong: Words, weak: Words) -> None:
    """Let the strong pixels of a row fill the runs of weak ones in which they lie.

    Towards higher bits: a run of ones to which one is added turns to zeros from there to its end,
    and the carry goes on into the next word. Towards lower bits nothing carries: there the filled
    part is doubled six times, over pixels that are all weak.
    """
    carry = np.uint64(0)
    for word in range(len(strong)):
        run = weak[word]
        start = strong[word] | (carry & run)
        filled = ((run ^ (run + start)) & run) | start
        strong[word] = filled
        carry = filled >> _63
    carry = np.uint64(0)
    for word in range(len(strong) - 1, -1, -1):
        run = weak[word]
        filled = strong[word] | ((carry << _63) & run)
        if filled != run and filled > 0:
            for step in _DOUBLING:
                filled |= run & (filled >> step)
                run &= run >> step
        strong[word] = filled
        carry = filled & _1
