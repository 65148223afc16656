"""Canny's edge map: gradients, non-maximum suppression and hysteresis.

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

from skyline_viz.arrays import I16, U8, Bool
from skyline_viz.kernels.planes import REACH
from skyline_viz.kernels.sobel import gradients

STEEPEST = 2040
"""The largest sum of both gradients that a 3x3 Sobel filter of 8-bit values can give."""

_TAN, _16 = np.uint32(2 * 13573), np.uint32(16)  # tan(22.5 degrees) in fixed point, as OpenCV's
_A, _B = np.uintp(1), np.uintp(2)  # a place on, and two: unsigned, for none is counted from the end

Words: TypeAlias = npt.NDArray[np.uint64]
"""Pixels, 64 to a word."""

_1, _63 = np.uint64(1), np.uint64(63)  # numba makes floats of words and signed numbers
_GATHER, _56 = np.uint64(0x0102040810204080), np.uint64(56)
_DOUBLING = tuple(np.uint64(1 << power) for power in range(6))


def canny(planes: U8, low: float, high: float) -> Bool:
    """Edge map ``(H, W)`` of a photo.

    Args:
        planes: ``(C, H + 6, W + 6)`` channels of the photo, see `planes.padded_planes`. The
            gradient of a pixel is that of the channel in which it is strongest.
        low: Pixels above this L1 gradient are edges if such pixels lead to one above `high`.
        high: Pixels above it always are.

    Examples:
        A step down a column: of its two rows the lower one is the edge.

        >>> from skyline_viz.kernels.planes import padded_planes
        >>> photo = np.full((6, 4), 200, np.uint8)
        >>> photo[3:] = 60
        >>> np.flatnonzero(canny(padded_planes(photo), 50, 220).all(axis=1))
        array([3])
    """
    height, width = planes.shape[1] - 2 * REACH, planes.shape[2] - 2 * REACH
    if height == 0 or width == 0:
        return np.zeros((height, width), np.bool_)
    floor, start = (int(min(max(math.floor(one), 0), STEEPEST)) for one in sorted((low, high)))
    kept = np.empty((2, height, -(-width // 64)), np.uint64)
    _mark(planes, np.int16(floor), np.int16(start), kept)
    edges = np.unpackbits(kept[1].view(np.uint8), axis=1, count=width, bitorder="little")
    return edges.view(np.bool_)


@numba.njit(cache=True, nogil=True)
def _mark(planes: U8, low: int, high: int, kept: Words) -> None:
    """Find edges, see `_keep` and `_follow`: one loop to load is faster than two."""
    _keep(planes, low, high, kept)
    _follow(kept[1], kept[0])


@numba.njit(cache=True, nogil=True)
def _keep(planes: U8, low: int, high: int, kept: Words) -> None:
    """Mark the pixels above the thresholds that are the strongest across their edge.

    A row is compared with those above and below it, so the gradients of three rows are at hand, and
    those of the whole photo never: a large photo's would not fit into the cache.

    Args:
        planes: See `canny`.
        low: The lower threshold.
        high: The upper one.
        kept: ``(2, H, W / 64)`` is filled: pixels above the lower threshold, and above the upper
            one, a bit for each.
    """
    height, width = planes.shape[1] - 2 * REACH, planes.shape[2] - 2 * REACH
    columns = np.empty((2, width + 2), np.int16)
    x, y = np.empty((2, width), np.int16), np.empty((2, width), np.int16)
    strength = np.zeros((3, width + 2), np.int16)  # a rim of zeros: beyond is no edge
    flags = np.zeros((2, 64 * kept.shape[2]), np.uint8)
    for below in range(height + 1):
        if below < height:
            gradients(planes, below, columns, x[below % 2], y[below % 2], strength[below % 3])
        else:
            strength[below % 3] = 0
        row = below - 1
        if row < 0:
            continue
        _suppress(
            x[row % 2],
            y[row % 2],
            strength[(row - 1) % 3],
            strength[row % 3],
            strength[below % 3],
            low,
            high,
            flags[0],
            flags[1],
        )
        _pack(flags[0].view(np.uint64), kept[0, row])
        _pack(flags[1].view(np.uint64), kept[1, row])


@numba.njit(cache=True, nogil=True)
def _suppress(
    across: I16,
    down: I16,
    above: I16,
    here: I16,
    below: I16,
    low: int,
    high: int,
    weak: U8,
    strong: U8,
) -> None:
    """Flag the pixels of a row that are the strongest across their edge.

    Three directions are told apart: the gradient is within 22.5 degrees of a row, of a column, or
    of neither. All are compared, and the one that holds is chosen with ``&`` and ``|``: a branch
    would make the loop a pixel at a time.

    With whole numbers, ``tall < tan(22.5) wide`` is ``tall <= limit``, what is left of the product
    without its fraction: that is 0 for a `wide` of 0 alone, and there, where `tall` is 0 as well,
    no pixel is above a threshold. So all fit into 16 bits.

    Args:
        across: ``(W,)`` gradients along the row.
        down: ``(W,)`` gradients down the columns.
        above: ``(W + 2,)`` L1 gradients of the row above, in a rim of a pixel.
        here: ``(W + 2,)`` likewise of this row.
        below: ``(W + 2,)`` likewise of the row below.
        low: The lower threshold.
        high: The upper one.
        weak: ``(W,)`` or more are filled: 1 above the lower threshold.
        strong: ``(W,)`` or more are filled: 1 above the upper one.
    """
    for column in range(np.uintp(len(across))):
        middle = here[column + _A]
        x = across[column]
        y = down[column]
        wide = np.int16(max(x, np.int16(-x)))
        tall = np.int16(max(y, np.int16(-y)))
        limit = np.int16((np.uint32(np.uint16(wide)) * _TAN) >> _16)
        along_row = tall <= limit
        along_column = np.int16(np.int16(tall - wide) - wide) > limit
        one_sign = np.int16(x ^ y) >= 0
        row_best = (middle > here[column]) & (middle >= here[column + _B])
        column_best = (middle > below[column + _A]) & (middle >= above[column + _A])
        falling_best = (middle > below[column + _B]) & (middle > above[column])
        rising_best = (middle > below[column]) & (middle > above[column + _B])
        aslant_best = (one_sign & falling_best) | (~one_sign & rising_best)
        upright = (along_column & column_best) | (~along_column & aslant_best)
        best = (along_row & row_best) | (~along_row & upright)
        weak[column] = best & (middle > low)
        strong[column] = best & (middle > high)


@numba.njit(cache=True, nogil=True)
def _pack(flags: Words, words: Words) -> None:
    """Make a bit of each flag.

    Eight flags lie in the bytes of a number. Times `_GATHER` each of them is moved to its place in
    the highest byte, and nothing is carried there.
    """
    for word in range(np.uintp(len(words))):
        bits = np.uint64(0)
        for eighth in range(8):
            eight = flags[np.uintp(8) * word + np.uintp(eighth)]
            bits |= ((eight * _GATHER) >> _56) << np.uint64(8 * eighth)
        words[word] = bits


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
