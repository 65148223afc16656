"""Lines of pixels, read across a photo: what colour they have, and how they differ.

Lines are looked at every so many pixels, and as far as needed: most photos have no frame, and are
told so in a hundredth of the time that their edges take. Whoever looks calls the last three: each
compiled loop that is called takes a program some milliseconds to load.
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


@numba.njit(cache=True, nogil=True)
def constant(
    lines: U8, every: int, limit: int, most_first: float, most: float
) -> tuple[I16, int, float]:
    """Colour ``(3,)`` of the first of some lines, how many have it, and the share of others there.

    They end before the first line with more than a share of pixels of other colours.

    Args:
        lines: ``(k, n, 3)``.
        every: Pixels are looked at every so many.
        limit: Grey levels by which they may differ from the colour.
        most_first: Share of pixels of the first line that may have other colours.
        most: Share of pixels of any line that may.
    """
    colour = colour_of(lines[0], every)
    stray = 0.0
    width = 0
    if away(lines[0], every, colour, limit) <= most_first:
        while width < len(lines):
            other = away(lines[width], every, colour, limit)
            if other > most:
                break
            stray += other
            width += 1
    return colour, width, stray / max(width, 1)


@numba.njit(cache=True, nogil=True)
def end(last: U8, first: U8, every: int, step: int, colour: I16, limit: int) -> tuple[float, float]:
    """Shares of pixels: in which the first line after some differs, and of others in their last."""
    return differ(last, first, every, step), away(last, every, colour, limit)


@numba.njit(cache=True, nogil=True)
def border(lines: U8, widest: int, every: int, limit: int, most: float) -> int:
    """The widest border of lines ``(k, n, 3)`` after which most get lighter, or darker; or 0."""
    for width in range(min(widest, len(lines) - 1), 0, -1):
        if abs(lighter(lines[width - 1], lines[width], every, limit)) > most:
            return width
    return 0
