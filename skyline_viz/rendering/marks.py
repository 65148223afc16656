"""What frames a rendered photo or is written on it: window frames, bars, a date."""

from typing import Literal, TypeAlias

import numpy as np

from skyline_viz.arrays import F32, Bool
from skyline_viz.rendering.filters import soften
from skyline_viz.rendering.picture import Picture

Border: TypeAlias = Literal["", "letterbox", "pillarbox", "passepartout", "window"]
"""Bars above and below, at the sides, all around; or the frame of a window."""

_DIGITS = ["abcdef", "bc", "abged", "abgcd", "fgbc", "afgcd", "afgedc", "abc", "abcdefg", "abcdfg"]
"""Strokes of the digits 0 to 9."""

_PLACES = {
    "a": (0, 0, 1, 5),
    "b": (0, 4, 5, 5),
    "c": (4, 4, 9, 5),
    "d": (8, 0, 9, 5),
    "e": (4, 0, 9, 1),
    "f": (0, 0, 5, 1),
    "g": (4, 0, 5, 5),
}
"""First row, first column, end row and end column of each stroke of a digit, 9 by 5."""

_DATE = "14 08 2019"


def bars(border: Border, margin: float, shape: tuple[int, int]) -> Bool:
    """``(H, W)`` the pixels of the bars of a border, `margin` of the height wide."""
    mask = np.zeros(shape, bool)
    size = max(2, round(margin * shape[0]))
    if border in ("letterbox", "passepartout"):
        mask[:size] = mask[-size:] = True
    if border in ("pillarbox", "passepartout"):
        mask[:, :size] = mask[:, -size:] = True
    return mask


def stamp(height: int, width: int) -> Bool:
    """``(H, W)`` the pixels of a date in the lower right corner."""
    letters = np.zeros((9, 7 * len(_DATE)), bool)
    for k, digit in enumerate(_DATE):
        for stroke in _DIGITS[int(digit)] if digit != " " else "":
            top, left, bottom, right = _PLACES[stroke]
            letters[top:bottom, 7 * k + left : 7 * k + right] = True
    scale = max(1, round(min(height, width) / 300))
    letters = letters.repeat(scale, axis=0).repeat(scale, axis=1)
    mask = np.zeros((height, width), bool)
    rows, columns = min(len(letters), height - 4), min(letters.shape[1], width - 4)
    mask[height - 4 - rows : height - 4, width - 4 - columns : width - 4] = letters[:rows, :columns]
    return mask


def sash(picture: Picture, margin: float) -> F32:
    """Share of each pixel that a window frame with bars across hides; near things are blurred."""
    window, frame = picture.everywhere(), picture.frame
    width = margin * frame.down
    across, down = frame.across, frame.down
    panes = 1 + round(margin * 40) % 3
    pane = across / panes
    clear: F32 = np.zeros((frame.height, frame.width), np.float32)
    for k in range(panes):
        clear = np.maximum(
            clear, window.box(k * pane + width / 2, width, (k + 1) * pane - width / 2, down - width)
        )
    share: F32 = 1 - clear
    for _ in range(max(1, round(2 * frame.unit))):
        share = soften(share, 0.25)
    return share
