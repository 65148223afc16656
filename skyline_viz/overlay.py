"""Pictures of skylines: lines on photos."""

import math
from collections.abc import Iterator, Sequence

import cv2
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8, check_photo, runs
from skyline_viz.colours import ALTERNATIVE, ANCHOR, HALO, PATH, TRUTH, Colour
from skyline_viz.skyline import Skyline, SkylineError

__all__ = [
    "ALTERNATIVE",
    "ANCHOR",
    "HALO",
    "PATH",
    "TRUTH",
    "Colour",
    "css",
    "draw_lines",
    "draw_overlay",
    "line_width",
]

_SUBPIXEL = 4
"""Binary digits behind the point of the coordinates that lines are drawn with."""


def draw_overlay(
    photo: U8,
    skyline: Skyline | None = None,
    truth: Skyline | None = None,
    *,
    thick: int | None = None,
) -> U8:
    """Copy of a photo with its skyline in magenta and the truth in turquoise.

    A line runs where the sky ends, between the last sky pixel and the first terrain pixel. Where
    it is not visible it is not drawn. Where both lines agree, the truth shows at the skyline's
    sides.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        skyline: The detected line.
        truth: The true line.
        thick: Width of the skyline in pixels, 1 or more; `line_width` unless given. A line of one
            pixel has no halo, so that nearly all of the ridge below it is seen.

    Raises:
        SkylineError: A line has another width than the photo.
    """
    check_photo(photo)
    height, width = photo.shape[:2]
    picture = np.ascontiguousarray(photo).copy()
    bare = thick == 1
    thick = line_width(height, width) if thick is None else thick
    rim = max(1, round(thick / 2))
    lines = []
    for line, colour in ((truth, TRUTH), (skyline, PATH)):
        if line is None:
            continue
        if line.width != width:
            raise SkylineError(f"the photo is {width} columns wide, the skyline {line.width}")
        lines.append((line, colour))
    wide = {TRUTH: thick + 2 * rim, PATH: thick}
    _draw_all(picture, lines, [wide[colour] for _, colour in lines], rim, halo=not bare)
    return picture


def draw_lines(
    picture: U8,
    lines: Sequence[tuple[Skyline, Colour]],
    thick: int,
    scale: float = 1.0,
    corner: tuple[int, int] = (0, 0),
) -> None:
    """Draw lines, each in its colour, on a part of their photo. Where they agree all can be seen.

    Args:
        picture: ``(h, w, 3)`` uint8 RGB, which is drawn on.
        lines: Lines of the whole photo, the one that is drawn last being the first.
        thick: Width of that, in pixels of the picture; the others are wider.
        scale: Pixels of the picture a pixel of the photo.
        corner: Column and row of the photo in the picture's upper left corner.
    """
    rim = max(1, round(thick / 2))
    lowest = list(reversed(lines))
    widths = [thick + 2 * rim * place for place in reversed(range(len(lines)))]
    _draw_all(picture, lowest, widths, rim, scale, corner)


def line_width(height: int, width: int) -> int:
    """Width in pixels of a line that looks the same on photos of all sizes.

    >>> line_width(519, 1388), line_width(3024, 4032)
    (2, 7)
    """
    return max(2, round(math.sqrt(height * width) / 500))


def css(colour: Colour) -> str:
    """A colour as style sheets write it.

    >>> css(PATH)
    '#ff2d95'
    """
    return f"#{bytes(colour).hex()}"


def _draw_all(
    picture: U8,
    lines: Sequence[tuple[Skyline, Colour]],
    widths: Sequence[int],
    rim: int,
    scale: float = 1.0,
    corner: tuple[int, int] = (0, 0),
    *,
    halo: bool = True,
) -> None:
    """Draw lines, the lowest first, in these widths; all halos lie below all lines."""
    shift = 0.5 - np.array(corner)  # pixel centres are whole, and corners half a pixel off
    strokes = [
        [_fixed_point((stroke + shift) * scale - 0.5) for stroke in _strokes(line)]
        for line, _ in lines
    ]
    for places, across in zip(strokes, widths, strict=True) if halo else ():
        _draw(picture, places, HALO, across + 2 * rim)
    for places, (_, colour), across in zip(strokes, lines, widths, strict=True):
        _draw(picture, places, colour, across)


def _draw(picture: U8, strokes: list[npt.NDArray[np.int32]], colour: Colour, across: int) -> None:
    cv2.polylines(picture, strokes, False, colour, across, cv2.LINE_AA, _SUBPIXEL)


def _strokes(line: Skyline) -> Iterator[npt.NDArray[np.float64]]:
    """Points ``(m, 2)`` of (x, y) of each run of visible columns, pixel centres being whole."""
    for first, last in runs(line.visible):
        x = np.arange(first, last + 1, dtype=np.float64)
        y = (
            line.rows[first : last + 1].astype(np.float64) - 0.5
        )  # the upper side of the terrain pixel
        ends = [x[0] - 0.5, *x, x[-1] + 0.5], [y[0], *y, y[-1]]
        yield np.column_stack(ends)


def _fixed_point(points: npt.NDArray[np.float64]) -> npt.NDArray[np.int32]:
    fixed: npt.NDArray[np.int32] = np.rint(points * 2**_SUBPIXEL).astype(np.int32)
    return fixed
