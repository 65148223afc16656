"""A picture of the photos on which passes differ most, at the places where they do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from annotate.agreement.figures import WITHIN
from annotate.agreement.pairs import Comparison, Pair, Pass, most_apart
from annotate.store.labels import Label, named
from skyline_viz.arrays import U8
from skyline_viz.overlay import ALTERNATIVE, PATH, TRUTH, Colour, draw_lines
from skyline_viz.photo import PhotoError, read_photo
from skyline_viz.system.names import shortened

COLOURS: tuple[Colour, ...] = (
    PATH,
    TRUTH,
    ALTERNATIVE,
    (0x5C, 0xC8, 0xFF),
    (0xFF, 0x9F, 0x1C),
    (0xFF, 0xFF, 0xFF),
)
"""Colours of passes, in their order; apart for those who see fewer colours, too."""

MOST = 6
"""Photos in a picture."""

_ZOOM = 720, 260  # columns and rows of the place where lines differ
_SIDE = 240  # columns beside it: what photo it is, and where on it
_LETTERS = 15  # pixels
_LARGEST = 8  # screen pixels a pixel of the photo
_BACK, _WORDS, _DIM = (24, 24, 24), (235, 235, 235), (170, 170, 170)
_EDGE = 8  # pixels around words


@dataclass(frozen=True)
class _Box:
    """A part of a photo."""

    left: int
    top: int
    width: int
    height: int


def picture(comparisons: Sequence[Comparison], passes: Sequence[Pass], photos: Path) -> U8 | None:
    """The photos that differ most, each at the span with most pixels between two lines.

    Args:
        comparisons: Passes that were compared.
        passes: All of them: the first is drawn in the first of `COLOURS`, and so on.
        photos: Folder of the photos.

    Returns:
        ``(h, w, 3)`` RGB; None where no photo can be read.
    """
    panels = []
    colours = {one: COLOURS[place % len(COLOURS)] for place, one in enumerate(passes)}
    labels = _labels(comparisons)
    for pair, which in most_apart(comparisons):
        try:
            photo = read_photo(photos / pair.first.name)
        except PhotoError:
            continue
        of_photo = list(labels[pair.first.digest].values())
        panels.append(_panel(photo, pair, which.name, of_photo, colours))
        if len(panels) == MOST:
            break
    return np.concatenate([_legend(colours), *panels]) if panels else None


def _labels(comparisons: Sequence[Comparison]) -> Mapping[str, Mapping[Pass, Label]]:
    """All labels that were compared, by the digest of their photo and by pass."""
    found: dict[str, dict[Pass, Label]] = {}
    for pair in (pair for one in comparisons for pair in one.pairs):
        of_photo = found.setdefault(pair.first.digest, {})
        for label in (pair.first, pair.second):
            of_photo[label.annotator, label.number] = label
    return found


def _panel(
    photo: U8, pair: Pair, whose: str, labels: list[Label], colours: Mapping[Pass, Colour]
) -> U8:
    """A photo: what it is and where on it the lines differ, beside that place with all lines."""
    first, last = pair.span(WITHIN[0]) or (0, pair.first.width - 1)
    box = _around(photo, labels, first, last)
    zoom = _cut(photo, box)
    scale = zoom.shape[1] / box.width
    lines = [
        (label.skyline, colours[label.annotator, label.number])
        for label in labels
        if label.skyline is not None
    ]
    draw_lines(zoom, lines, 2, scale, (box.left, box.top))
    side = Image.new("RGB", (_SIDE, _ZOOM[1]), _BACK)
    pen = ImageDraw.Draw(side)
    lowest = _thumbnail(side, pen, photo, box)
    told = (
        shortened(pair.first.name, 28),
        shortened(whose, 30),
        f"columns {first} to {last}",
        f"mean {pair.mean:.2f}, worst {pair.worst:.0f} px",
    )
    for place, words in enumerate(told):
        at = (_EDGE, lowest + _EDGE + place * (_LETTERS + 5))
        pen.text(at, words, fill=_DIM if place else _WORDS, font=_font())
    gap = np.full((_EDGE, _SIDE + _ZOOM[0], 3), _BACK, np.uint8)
    return np.concatenate([np.concatenate([np.asarray(side), zoom], axis=1), gap])


def _around(photo: U8, labels: list[Label], first: int, last: int) -> _Box:
    """The part of a photo that shows all lines in some columns, in the shape of the zoom."""
    height, width = photo.shape[:2]
    rows = [label.skyline.rows[first : last + 1] for label in labels if label.skyline is not None]
    top, bottom = float(np.min(rows)), float(np.max(rows))
    across = max((last - first + 1) * 1.3, (bottom - top) * 1.6 * _ZOOM[0] / _ZOOM[1])
    across = min(max(across, _ZOOM[0] / _LARGEST), width, height * _ZOOM[0] / _ZOOM[1])
    columns = max(round(across), 1)
    down = max(min(round(across * _ZOOM[1] / _ZOOM[0]), height), 1)
    left = min(max(round((first + last - columns) / 2), 0), width - columns)
    above = min(max(round((top + bottom - down) / 2), 0), height - down)
    return _Box(left, above, columns, down)


def _cut(photo: U8, box: _Box) -> U8:
    """A part of a photo, as large as the zoom; single pixels stay so where they are large."""
    part = photo[box.top : box.top + box.height, box.left : box.left + box.width]
    how = cv2.INTER_AREA if box.width > _ZOOM[0] else cv2.INTER_NEAREST
    return np.ascontiguousarray(cv2.resize(part, _ZOOM, interpolation=how), np.uint8)


def _thumbnail(side: Image.Image, pen: ImageDraw.ImageDraw, photo: U8, box: _Box) -> int:
    """Draw the whole photo with a frame around the place; return the row below it."""
    height, width = photo.shape[:2]
    room = _SIDE - 2 * _EDGE, _ZOOM[1] - 5 * (_LETTERS + 5) - _EDGE
    scale = min(room[0] / width, room[1] / height)
    size = max(round(width * scale), 1), max(round(height * scale), 1)
    side.paste(Image.fromarray(cv2.resize(photo, size, interpolation=cv2.INTER_AREA)), (_EDGE, 0))
    left, top = _EDGE + box.left * scale, box.top * scale
    frame = [left, top, left + max(box.width * scale, 3), top + max(box.height * scale, 3)]
    pen.rectangle(frame, outline=_BACK, width=4)
    pen.rectangle(frame, outline=_WORDS, width=2)
    return int(size[1])


def _legend(colours: Mapping[Pass, Colour]) -> U8:
    """Which colour is whose, on as many rows as that takes."""
    width, line = _SIDE + _ZOOM[0], _LETTERS + 2 * _EDGE
    places: list[tuple[float, int, str, Colour]] = []
    x, y = float(_EDGE), 0
    for (who, number), colour in colours.items():
        words = shortened(named(who, number), 40)
        wide = 44 + _font().getlength(words)
        if x > _EDGE and x + wide > width:
            x, y = float(_EDGE), y + line
        places.append((x, y, words, colour))
        x += wide + 2 * _EDGE
    sheet = Image.new("RGB", (width, y + line), _BACK)
    pen = ImageDraw.Draw(sheet)
    for left, top, words, colour in places:
        pen.rectangle((left, top + line // 2 - 3, left + 32, top + line // 2 + 3), fill=colour)
        pen.text((left + 40, top + line / 2), words, fill=_WORDS, font=_font(), anchor="lm")
    return np.asarray(sheet, np.uint8)


def _font() -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size=_LETTERS)
