"""A click on any pixel in a notebook: which one it was, and what is known of it.

The viewer tells the running Python where something was selected; the answer is what the tab *Pixel*
says, of the clicked pixel beside the path's in its column.
"""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from PIL import Image

from skyline_viz.arrays import U8, Int
from skyline_viz.colours import coloured
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.explanation import Explanation, Filtered, explain_pixels
from skyline_viz.viewer import entities
from skyline_viz.viewer.pixel_words import about_pixels

CLICKED = "clicked"
"""What the clicked pixel is called."""

_ELSEWHERE = (entities.PIXEL, "bank")  # what is no part of the photo
_SIDE = 168  # pixels of a patch, a filter and a product
_GAP = 12


@dataclass(frozen=True, eq=False)
class Answer:
    """What is known of a clicked pixel."""

    text: str
    """In Markdown."""

    picture: bytes | None
    """PNG: patch, filter and product of the path's pixel, and below them of the clicked one; None
    of methods without filters."""


def clicked_pixel(items: Sequence[Any], shape: tuple[int, ...]) -> tuple[int, int] | None:
    """Row and column of a pixel that was selected in the viewer.

    Args:
        items: What was selected, as the viewer's event tells it.
        shape: Height and width of the photo.

    Returns:
        None where it is no pixel of the photo.
    """
    for item in items:
        path = getattr(item, "entity_path", "").strip("/")
        position = getattr(item, "position", None)
        if position and path.split("/")[0] not in _ELSEWHERE:
            column, row = (math.floor(one) for one in position[:2])
            if 0 <= row < shape[0] and 0 <= column < shape[1]:
                return row, column
    return None


def answer(detection: Detection, row: int, column: int) -> Answer:
    """What is known of a pixel, beside the path's pixel in its column.

    Args:
        detection: The detection.
        row: Row of the pixel.
        column: Its column.
    """
    rows, there = [int(detection.skyline.rows[column]), row], np.array([column], np.int32)
    told = explain_pixels(detection, rows, [column, column])
    names = ("path", CLICKED)
    walks: list[tuple[str, Int, Sequence[Explanation]]] = [
        (name, there, [one]) for name, one in zip(names, told, strict=True)
    ]
    (text,) = about_pixels(detection, walks, there, opening=None)
    filtered = [one.filtered for one in told if one.filtered]
    return Answer(text, _png(filtered) if len(filtered) == len(told) else None)


def _png(filtered: Sequence[Filtered]) -> bytes:
    """Patch, filter and product of each pixel, a row each."""
    most_tap = max(float(np.abs(one.taps).max()) for one in filtered) or 1.0
    most = max(float(np.abs(one.product).max()) for one in filtered) or 1.0
    rows = []
    for one in filtered:
        squares = [
            coloured("gray", one.patch / 255),
            coloured("blue_red", 0.5 + 0.5 * one.taps / most_tap),
            coloured("blue_red", 0.5 + 0.5 * one.product / most),
        ]
        rows.append(np.concatenate([_framed(square) for square in squares], axis=1))
    data = io.BytesIO()
    Image.fromarray(np.concatenate(rows)).save(data, "PNG")
    return data.getvalue()


def _framed(square: U8) -> U8:
    """A small picture, enlarged, with a gap at its right and its lower side."""
    times = max(_SIDE // len(square), 1)
    large = square.repeat(times, axis=0).repeat(times, axis=1)
    framed: U8 = np.pad(large, ((0, _GAP), (0, _GAP), (0, 0)), constant_values=255)
    return framed
