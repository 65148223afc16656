"""Small pictures of photos with their lines, for the page on which flags are set."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from PIL import Image

from skyline_viz.arrays import U8
from skyline_viz.files import replacing
from skyline_viz.overlay import draw_overlay
from skyline_viz.skyline import Skyline

SIZE = (640, 360)
"""Largest width and height, in pixels: sharp on screens with two pixels a point."""

_QUALITY = 80  # of the JPEG


def thumbnail(photo: U8, path: Skyline, truth: Skyline | None) -> U8:
    """A small copy of a photo with its path in magenta and its truth in turquoise.

    The photo is reduced first, so that lines are as wide on every photo.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        path: The line that was detected.
        truth: The true one.
    """
    height, width = photo.shape[:2]
    scale = min(SIZE[0] / width, SIZE[1] / height, 1.0)
    size = max(round(width * scale), 2), max(round(height * scale), 2)
    small = cv2.resize(photo, size, interpolation=cv2.INTER_AREA)
    lines = [None if line is None else _reduced(line, size[0], scale) for line in (path, truth)]
    return draw_overlay(small, *lines)


def write_thumbnail(file: Path, photo: U8, path: Skyline, truth: Skyline | None) -> None:
    """Write a photo's `thumbnail` as JPEG, with full colours: lines are two pixels wide."""
    picture = Image.fromarray(thumbnail(photo, path, truth))
    with replacing(file) as temporary:
        picture.save(temporary, quality=_QUALITY, subsampling=0)


def _reduced(line: Skyline, width: int, scale: float) -> Skyline:
    """A line at the columns of a smaller photo: the nearest ones, for it may jump."""
    columns = (np.arange(width) + 0.5) * line.width / width
    nearest = columns.astype(np.intp)
    return Skyline(line.rows[nearest] * np.float32(scale), line.visible[nearest])
