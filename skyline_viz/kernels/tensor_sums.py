"""Window sums of gradient products at chosen pixels: what a structure tensor is made of.

A row of products is needed by the six rows around it, so the last six stay at hand. Every loop runs
along a row and touches few arrays, each number in float32 and in the same order of sums: from the
first chosen pixel of a row to its last one all are summed down and then sideways, because many
pixels at once cost less than one of them alone.
"""

import numba
import numpy as np

from skyline_viz.arrays import F32, I16, U8, Int

TAPS = 6
"""Taps of the window along an axis."""

_1, _2, _3, _4, _5 = (np.uintp(one) for one in range(1, TAPS))


@numba.njit(cache=True, nogil=True)
def window_sums(planes: U8, columns: Int, first: Int, window: F32, sums: F32) -> None:
    """Sum gx gx, gx gy and gy gy over channels and the window around each chosen pixel.

    Args:
        planes: ``(3, H + 6, W + 6)`` channels with a border.
        columns: ``(n,)`` columns of the chosen pixels, row by row.
        first: ``(H + 1,)`` place of each row's first pixel in `columns`.
        window: ``(6,)`` weights along an axis.
        sums: ``(3, n)`` is filled.
    """
    height = planes.shape[1] - TAPS
    width = planes.shape[2] - 1
    recent = np.empty((TAPS, 3 * width), np.float32)
    held = np.full(TAPS, -1)  # the row of which the products are
    falling, rising = np.empty((3, width), np.int16), np.empty((3, width), np.int16)
    across = np.empty(width, np.float32)
    total = np.empty(width - TAPS + 1, np.float32)
    for target in range(height):
        begin, end = first[target], first[target + 1]
        if begin == end:
            continue
        for row in range(target, target + TAPS):
            if held[row % TAPS] != row:
                _products(planes, row, falling, rising, recent[row % TAPS])
                held[row % TAPS] = row
        left, right = _first_and_end(columns[begin:end])
        for product in range(3):
            some = slice(product * width + left, product * width + right + TAPS - 1)
            _downwards(
                recent[target % TAPS, some],
                recent[(target + 1) % TAPS, some],
                recent[(target + 2) % TAPS, some],
                recent[(target + 3) % TAPS, some],
                recent[(target + 4) % TAPS, some],
                recent[(target + 5) % TAPS, some],
                window,
                across[left : right + TAPS - 1],
            )
            _sideways(across[left : right + TAPS - 1], window, total[left:right])
            own = sums[product]
            for pixel in range(np.uintp(begin), np.uintp(end)):
                own[pixel] = total[columns[pixel]]


@numba.njit(cache=True, nogil=True)
def _first_and_end(columns: Int) -> tuple[int, int]:
    """The first of some columns, and the one after the last."""
    left = right = columns[0]
    for place in range(len(columns)):
        left = min(left, columns[place])
        right = max(right, columns[place])
    return left, right + 1


@numba.njit(cache=True, nogil=True)
def _products(planes: U8, row: int, falling: I16, rising: I16, products: F32) -> None:
    """Write gx gx, gx gy and gy gy below a row, one after the other.

    Of the diagonal differences the gradients are half the sum and half the difference. All products
    are multiples of a quarter below 2^18, and exact.

    Args:
        planes: See `window_sums`.
        row: The upper one of the two rows.
        falling: ``(3, w)`` room for the differences.
        rising: ``(3, w)`` likewise.
        products: ``(3 w,)`` is filled.
    """
    width = falling.shape[1]
    for channel in range(3):
        above, below = planes[channel, row], planes[channel, row + 1]
        _subtract(below[1:], above[:-1], falling[channel])
        _subtract(above[1:], below[:-1], rising[channel])
    a, b, c = falling[0], falling[1], falling[2]
    d, e, f = rising[0], rising[1], rising[2]
    quarter = np.float32(0.25)
    xx, xy, yy = products[:width], products[width : 2 * width], products[2 * width :]
    _squares(a, b, c, d, e, f, np.int16(1), quarter, xx)
    _squares(a, b, c, d, e, f, np.int16(-1), quarter, yy)
    _squares_less_squares(a, b, c, d, e, f, quarter, xy)


@numba.njit(cache=True, nogil=True)
def _subtract(one: U8, other: U8, difference: I16) -> None:
    for column in range(len(difference)):
        difference[column] = np.int16(np.int16(one[column]) - np.int16(other[column]))


@numba.njit(cache=True, nogil=True)
def _squares(
    a: I16, b: I16, c: I16, d: I16, e: I16, f: I16, sign: int, share: float, total: F32
) -> None:
    """Write a share of (a + sign d)^2 + (b + sign e)^2 + (c + sign f)^2."""
    for column in range(len(total)):
        one = np.float32(np.int16(a[column] + np.int16(sign * d[column])))
        two = np.float32(np.int16(b[column] + np.int16(sign * e[column])))
        three = np.float32(np.int16(c[column] + np.int16(sign * f[column])))
        total[column] = (one * one + two * two + three * three) * share


@numba.njit(cache=True, nogil=True)
def _squares_less_squares(
    a: I16, b: I16, c: I16, d: I16, e: I16, f: I16, share: float, total: F32
) -> None:
    """Write a share of a^2 + b^2 + c^2 - d^2 - e^2 - f^2."""
    for column in range(len(total)):
        one, two, three = np.float32(a[column]), np.float32(b[column]), np.float32(c[column])
        four, five, six = np.float32(d[column]), np.float32(e[column]), np.float32(f[column])
        plus = one * one + two * two + three * three
        total[column] = (plus - four * four - five * five - six * six) * share


@numba.njit(cache=True, nogil=True)
def _downwards(a: F32, b: F32, c: F32, d: F32, e: F32, f: F32, window: F32, across: F32) -> None:
    """Sum six rows, from the first one on."""
    w0, w1, w2, w3, w4, w5 = window[0], window[1], window[2], window[3], window[4], window[5]
    for column in range(len(across)):
        total = w0 * a[column] + w1 * b[column]
        total = total + w2 * c[column] + w3 * d[column]
        across[column] = total + w4 * e[column] + w5 * f[column]


@numba.njit(cache=True, nogil=True)
def _sideways(across: F32, window: F32, total: F32) -> None:
    """Sum six neighbours, from the first one on."""
    w0, w1, w2, w3, w4, w5 = window[0], window[1], window[2], window[3], window[4], window[5]
    for column in range(np.uintp(len(total))):
        three = w0 * across[column] + w1 * across[column + _1] + w2 * across[column + _2]
        five = three + w3 * across[column + _3] + w4 * across[column + _4]
        total[column] = five + w5 * across[column + _5]
