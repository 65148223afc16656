"""Pictures of a filter bank: its filters side by side, and how many samples each was learned from.

Both have a cell for each bin: orientation across, coherence and strength down, as the bins are
counted. A cell's place is told by `cell_box`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from skyline_viz.arrays import U8, Int
from skyline_viz.bins import Bins
from skyline_viz.colours import coloured
from skyline_viz.filter_bank import STARVED_SAMPLES, FilterBank

CELL = 44
"""Side of a cell, in pixels."""

LEFT, TOP = 280, 62
"""Space for the labels of rows and columns, in pixels."""

_GAP = 3
_CORNER = 13  # legs of the triangle that marks a starved bin
_LETTERS = 22  # size of letters, which the viewer shows at about half of it
_BACKGROUND, _TEXT, _STARVED = (24, 24, 24), (225, 225, 225), (230, 150, 0)


@dataclass(frozen=True, eq=False)
class BankPictures:
    """The two pictures of a filter bank, and which bin each of their pixels belongs to."""

    filters: U8
    """``(h, w, 3)`` RGB: taps from blue (negative) over white (0) to red (positive)."""

    samples: U8
    """``(h, w, 3)`` RGB: training samples of each bin, printed on a logarithmic colour."""

    cells: Int
    """``(h, w)`` 1 + the bin of each pixel; 0 between cells."""


def cell_box(index: int, bins: Bins) -> tuple[int, int, int, int]:
    """Left, top, right and bottom of a bin's cell, in pixels of the pictures.

    >>> cell_box(0, Bins())
    (280, 62, 321, 103)
    """
    row, column = divmod(index, bins.orientations)
    left, top = LEFT + column * CELL, TOP + row * CELL
    return left, top, left + CELL - _GAP, top + CELL - _GAP


def draw_bank(bank: FilterBank) -> BankPictures:
    """Draw the filters and the samples of a bank. Starved bins have an orange corner."""
    cells = np.zeros(_size(bank.bins), np.int32)
    for index in range(bank.bins.count):
        left, top, right, bottom = cell_box(index, bank.bins)
        cells[top:bottom, left:right] = index + 1
    return BankPictures(_draw_filters(bank), _draw_samples(bank), cells)


def _draw_filters(bank: FilterBank) -> U8:
    sheet, pen = _sheet(bank.bins)
    side = CELL - _GAP
    for index, taps in enumerate(bank.filters):
        left, top, _, _ = cell_box(index, bank.bins)
        top_tap = float(np.abs(taps).max()) or 1.0  # each filter shows its own shape
        picture = coloured("blue_red", 0.5 + 0.5 * taps / top_tap)
        large = Image.fromarray(picture).resize((side, side), Image.Resampling.NEAREST)
        sheet.paste(large, (left, top))
        if bank.starved[index]:
            _mark_starved(pen, left, top)
    return np.array(sheet)


def _draw_samples(bank: FilterBank) -> U8:
    sheet, pen = _sheet(bank.bins)
    font = ImageFont.load_default(size=_LETTERS - 4)
    heat = np.log10(bank.samples + 1.0)
    heat = heat / max(float(heat.max()), 1.0)
    colours = coloured("viridis", heat).tolist()
    for index, count in enumerate(bank.samples.tolist()):
        left, top, right, bottom = cell_box(index, bank.bins)
        pen.rectangle((left, top, right - 1, bottom - 1), fill=tuple(colours[index]))
        if bank.starved[index]:
            _mark_starved(pen, left, top)
        ink = (0, 0, 0) if heat[index] > 0.6 else (255, 255, 255)
        centre = ((left + right) / 2, (top + bottom) / 2)
        pen.text(centre, _short(count), fill=ink, font=font, anchor="mm")
    return np.array(sheet)


def _mark_starved(pen: ImageDraw.ImageDraw, left: int, top: int) -> None:
    """An orange triangle in the upper left corner of a cell."""
    pen.polygon([(left, top), (left + _CORNER, top), (left, top + _CORNER)], fill=_STARVED)


def _sheet(bins: Bins) -> tuple[Image.Image, ImageDraw.ImageDraw]:
    height, width = _size(bins)
    sheet = Image.new("RGB", (width, height), _BACKGROUND)
    pen = ImageDraw.Draw(sheet)
    font = ImageFont.load_default(size=_LETTERS)
    note = f"orange corner: fewer than {STARVED_SAMPLES} samples"
    pen.text((8, 4), note, fill=_STARVED, font=font)
    for orientation in range(bins.orientations):
        left, top, right, _ = cell_box(orientation, bins)
        text = f"{orientation * 180 / bins.orientations:.0f}°"
        small = ImageFont.load_default(size=_LETTERS - 4)
        pen.text(((left + right) / 2, top - 16), text, fill=_TEXT, font=small, anchor="mm")
    for row in range(bins.coherences * bins.strengths):
        left, top, _, bottom = cell_box(row * bins.orientations, bins)
        coherence, strength = divmod(row, bins.strengths)
        place = ((left - 8), (top + bottom) / 2)
        pen.text(place, bins.strength_label(strength), fill=_TEXT, font=font, anchor="rm")
        if strength == 0:
            pen.line((8, top - 2, width, top - 2), fill=(90, 90, 90))
            pen.text((8, top + 8), "coherence", fill=_TEXT, font=font)
            pen.text((8, top + 36), bins.coherence_label(coherence), fill=_TEXT, font=font)
    pen.text((LEFT - 8, TOP - 16), "strength", fill=_TEXT, font=font, anchor="rm")
    return sheet, pen


def _size(bins: Bins) -> tuple[int, int]:
    rows = bins.coherences * bins.strengths
    return TOP + rows * CELL + _GAP, LEFT + bins.orientations * CELL + _GAP


def _short(count: int) -> str:
    """At most four characters.

    >>> _short(812), _short(1234), _short(45678)
    ('812', '1.2k', '46k')
    """
    if count < 1000:
        return str(count)
    return f"{count / 1000:.1f}k" if count < 9950 else f"{count / 1000:.0f}k"
