"""Lines of pixels, read across a photo: what colour they have, and how they differ.

Lines are looked at every so many pixels, and as far as needed: most photos have no frame, and are
told so in a hundredth of the time that their edges take.
"""

import numba
import numpy as np

from skyline_viz.arrays import I16, U8


@numba.njit(cache=True, nogil=True)
def colour_of(line: U8, every: int) -> I16:
    """Mean colour ``(3,)`` of every so many pixels of a line ``(n, 3)``."""
    mean = np.empty(3, np.int16)
    for channel in range(3):
        total = 0
        count = 0
        for place in range(0, len(line), every):
            total += line[place, channel]
            count += 1
        mean[channel] = total // count
    return mean


@numba.njit(cache=True, nogil=True)
def away(line: U8, every: int, colour: I16, limit: int) -> float:
    """Share of every so many pixels of a line ``(n, 3)`` that differ from a colour."""
    many = 0
    count = 0
    for place in range(0, len(line), every):
        change = 0
        for channel in range(3):
            change = max(change, abs(np.int32(line[place, channel]) - colour[channel]))
        many += change > limit
        count += 1
    return many / count


@numba.njit(cache=True, nogil=True)
def constant(lines: U8, every: int, colour: I16, limit: int, most: float) -> tuple[int, float]:
    """How many lines ``(k, n, 3)`` have one colour, and the share of other colours in them.

    They end before the first line with more than a share of pixels of other colours.
    """
    stray = 0.0
    for width in range(len(lines)):
        other = away(lines[width], every, colour, limit)
        if other > most:
            return width, stray / max(width, 1)
        stray += other
    return len(lines), stray / len(lines)


@numba.njit(cache=True, nogil=True)
def differ(line: U8, other: U8, every: int, limit: int) -> float:
    """Share of every so many pixels in which two lines ``(n, 3)`` differ."""
    many = 0
    count = 0
    for place in range(0, len(line), every):
        change = 0
        for channel in range(3):
            change = max(change, abs(np.int32(line[place, channel]) - other[place, channel]))
        many += change > limit
        count += 1
    return many / count


@numba.njit(cache=True, nogil=True)
def lighter(line: U8, other: U8, every: int, limit: int) -> float:
    """Share of pixels that are lighter in the other line ``(n, 3)``, less those that are darker."""
    balance = 0
    count = 0
    for place in range(0, len(line), every):
        up = 0
        down = 0
        for channel in range(3):
            change = np.int32(other[place, channel]) - line[place, channel]
            up = max(up, change)
            down = min(down, change)
        balance += (up > limit) - (down < -limit)
        count += 1
    return balance / count
