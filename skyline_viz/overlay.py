"""Pictures of skylines: lines on photos, and contact sheets of many photos."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

from skyline_viz.arrays import U8, Bool, check_photo
from skyline_viz.skyline import Skyline, SkylineError

Colour = tuple[int, int, int]

PATH: Colour = (0xFF, 0x2D, 0x95)
"""Magenta: the detected skyline."""

TRUTH: Colour = (0x00, 0xD1, 0xB2)
"""Turquoise: the truth."""

ALTERNATIVE: Colour = (0xFF, 0xD4, 0x00)
"""Yellow: another line to compare with."""

HALO: Colour = (20, 20, 20)
"""What surrounds a line, so that it reads on snow as well as on rock."""

GREY: Colour = (64, 64, 64)
"""Background of contact sheets."""

TILE_WIDTH, TILE_HEIGHT = 480, 360
"""Largest size of a photo on a contact sheet, in pixels."""

_TEXT: Colour = (236, 236, 236)
_GAP = 12
_LABEL_HEIGHT = 22
_SUBPIXEL = 4
"""Binary digits behind the point of the coordinates that lines are drawn with."""


@dataclass(frozen=True, eq=False)
class Tile:
    """A picture on a contact sheet, and what is written below it."""

    label: str
    """One line; what does not fit is cut."""

    picture: U8
    """``(h, w, 3)`` uint8 RGB, at most `TILE_HEIGHT` by `TILE_WIDTH`."""


def draw_overlay(photo: U8, skyline: Skyline | None = None, truth: Skyline | None = None) -> U8:
    """Copy of a photo with its skyline in magenta and the truth in turquoise.

    A line runs where the sky ends, between the last sky pixel and the first terrain pixel. Where
    it is not visible it is not drawn. Where both lines agree, the truth shows at the skyline's
    sides.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        skyline: The detected line.
        truth: The true line.

    Raises:
        SkylineError: A line has another width than the photo.
    """
    check_photo(photo)
    height, width = photo.shape[:2]
    picture = np.ascontiguousarray(photo).copy()
    thick = line_width(height, width)
    rim = max(1, round(thick / 2))
    lines = []
    for line, colour, across in ((truth, TRUTH, thick + 2 * rim), (skyline, PATH, thick)):
        if line is None:
            continue
        if line.width != width:
            raise SkylineError(f"the photo is {width} columns wide, the skyline {line.width}")
        lines.append(([_fixed_point(stroke) for stroke in _strokes(line)], colour, across))
    for strokes, _, across in lines:  # all halos lie below all lines
        _draw(picture, strokes, HALO, across + 2 * rim)
    for strokes, colour, across in lines:
        _draw(picture, strokes, colour, across)
    return picture


def line_width(height: int, width: int) -> int:
    """Width in pixels of a line that looks the same on photos of all sizes.

    >>> line_width(519, 1388), line_width(3024, 4032)
    (2, 7)
    """
    return max(2, round(math.sqrt(height * width) / 500))


def shrunk(
    photo: U8, *lines: Skyline | None, width: int, height: int | None = None
) -> tuple[U8, list[Skyline | None]]:
    """Reduce a photo, and its lines with it, to fit a size; smaller ones are left as they are.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        lines: Lines of the photo.
        width: Largest width, in pixels.
        height: Largest height, in pixels; any unless given.
    """
    rows, columns = photo.shape[:2]
    factor = min(1.0, width / columns, height / rows if height else 1.0)
    if factor == 1.0:
        return photo, list(lines)
    size = max(2, round(columns * factor)), max(2, round(rows * factor))
    smaller: U8 = cv2.resize(photo, size, interpolation=cv2.INTER_AREA)
    return smaller, [line and _resized(line, size[0], size[1] / rows) for line in lines]


def make_tile(
    label: str, photo: U8, skyline: Skyline | None = None, truth: Skyline | None = None
) -> Tile:
    """Small overlay for a contact sheet; lines are drawn last, so that they stay legible."""
    small, (line, true_line) = shrunk(photo, skyline, truth, width=TILE_WIDTH, height=TILE_HEIGHT)
    return Tile(label, draw_overlay(small, line, true_line))


def contact_sheet(tiles: Sequence[Tile], columns: int = 4) -> U8:
    """Tiles with their labels, row by row on neutral grey, ``(H, W, 3)`` uint8 RGB.

    Raises:
        ValueError: There is no tile, or no column.
    """
    if not tiles or columns < 1:
        raise ValueError("a contact sheet needs at least one tile and one column")
    columns = min(columns, len(tiles))
    lines = [tiles[start : start + columns] for start in range(0, len(tiles), columns)]
    cell = max(tile.picture.shape[1] for tile in tiles)
    heights = [max(tile.picture.shape[0] for tile in line) for line in lines]
    size = (
        _GAP + columns * (cell + _GAP),
        _GAP + sum(heights) + len(lines) * (_LABEL_HEIGHT + _GAP),
    )
    sheet = Image.new("RGB", size, GREY)
    pen = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(size=15)
    top = _GAP
    for line, height in zip(lines, heights, strict=True):
        for index, tile in enumerate(line):
            left = _GAP + index * (cell + _GAP)
            picture = Image.fromarray(tile.picture)
            sheet.paste(picture, (left, top))
            label = _cut(tile.label, cell, font)
            pen.text((left, top + picture.height + 4), label, fill=_TEXT, font=font)
        top += height + _LABEL_HEIGHT + _GAP
    return np.array(sheet)


def _draw(picture: U8, strokes: list[npt.NDArray[np.int32]], colour: Colour, across: int) -> None:
    cv2.polylines(picture, strokes, False, colour, across, cv2.LINE_AA, _SUBPIXEL)


def _strokes(line: Skyline) -> Iterator[npt.NDArray[np.float64]]:
    """Points ``(m, 2)`` of (x, y) of each run of visible columns, pixel centres being whole."""
    visible = np.concatenate([[False], line.visible, [False]])
    starts, stops = np.flatnonzero(visible[1:] != visible[:-1]).reshape(-1, 2).T
    for start, stop in zip(starts, stops, strict=True):
        x = np.arange(start, stop, dtype=np.float64)
        y = line.rows[start:stop].astype(np.float64) - 0.5  # the upper side of the terrain pixel
        ends = [x[0] - 0.5, *x, x[-1] + 0.5], [y[0], *y, y[-1]]
        yield np.column_stack(ends)


def _fixed_point(points: npt.NDArray[np.float64]) -> npt.NDArray[np.int32]:
    fixed: npt.NDArray[np.int32] = np.rint(points * 2**_SUBPIXEL).astype(np.int32)
    return fixed


def _resized(line: Skyline, width: int, vertical: float) -> Skyline:
    """Resample a line to another number of columns, and scale its rows."""
    centres = (np.arange(width) + 0.5) * (line.width / width) - 0.5
    rows = np.interp(centres, np.arange(line.width), line.rows) * vertical
    visible: Bool = line.visible[np.rint(centres).astype(np.intp)]
    return Skyline(rows.astype(np.float32), visible)


def _cut(label: str, width: int, font: ImageFont.FreeTypeFont | ImageFont.ImageFont) -> str:
    text = label
    while text and font.getlength(text) > width:
        text = text[:-2] + "…" if len(text) > 2 else ""
    return text
