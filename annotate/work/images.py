"""Pictures of a photo for the page, as PNG or JPEG: whole, reduced, in tiles, its line straight."""

from __future__ import annotations

import cv2
import numpy as np

from annotate.work.pictures import Picture
from skyline_viz.arrays import U8
from skyline_viz.overlay import draw_overlay
from skyline_viz.picture_files.reduced import reduced_jpeg
from skyline_viz.skyline import Skyline

TILE = 512
"""Side of a tile, in pixels."""

VIEW = 2048
"""Longest side of the view of a whole photo, in pixels."""

EXACT = 2_000_000
"""Photos of at most so many pixels are shown as they are."""

SMALL = 160, 240
"""Most rows and columns of a thumbnail."""

BAND = 40
"""Rows above and below the line in the straightened strip."""


def view_size(height: int, width: int) -> tuple[int, int]:
    """Height and width of the view of a whole photo.

    >>> view_size(519, 1388), view_size(3024, 4032)
    ((519, 1388), (1536, 2048))
    """
    if height * width <= EXACT:
        return height, width
    scale = min(VIEW / max(height, width), 1.0)
    return max(round(height * scale), 1), max(round(width * scale), 1)


def view(photo: U8) -> Picture:
    """The whole photo: exact where it is small enough."""
    size = view_size(*photo.shape[:2])
    return png(photo) if size == photo.shape[:2] else jpeg(_reduced(photo, size), 90)


def thumbnail(photo: U8) -> Picture:
    """A JPEG of at most `SMALL` pixels."""
    return jpeg(_reduced(photo, _small_size(*photo.shape[:2])), 80)


def thumbnail_of_file(data: bytes, height: int, width: int) -> Picture | None:
    """The thumbnail of a photo in a JPEG file, decoded at a fraction of its size.

    Args:
        data: The file.
        height: Rows of the photo.
        width: Its columns.

    Returns:
        The thumbnail; None where the photo has to be read in the ordinary way.
    """
    size = _small_size(height, width)
    found = reduced_jpeg(data, 2 * size[0], 2 * size[1])  # twice as fine, to be averaged
    return None if found is None else jpeg(_reduced(found, size), 80)


def _small_size(height: int, width: int) -> tuple[int, int]:
    scale = min(SMALL[1] / width, SMALL[0] / height, 1.0)
    return max(round(height * scale), 1), max(round(width * scale), 1)


def has_tile(photo: U8, across: int, down: int) -> bool:
    """Whether there is such a tile."""
    height, width = photo.shape[:2]
    return bool(down * TILE < height and across * TILE < width)


def tile(photo: U8, across: int, down: int) -> Picture:
    """Exact pixels of a tile that there is, as PNG."""
    return png(photo[down * TILE : (down + 1) * TILE, across * TILE : (across + 1) * TILE])


def overview(photo: U8, skyline: Skyline) -> Picture:
    """A JPEG of at most `SMALL` pixels with the line on it."""
    height, width = _small_size(*photo.shape[:2])
    scale = height / len(photo)
    columns = np.minimum(((np.arange(width) + 0.5) * skyline.width / width), skyline.width - 1)
    at = columns.astype(np.intp)
    line = Skyline(rows=skyline.rows[at] * scale, visible=skyline.visible[at])
    return jpeg(draw_overlay(_reduced(photo, (height, width)), line), 85, exact_colours=True)


def strip(photo: U8, skyline: Skyline, width: int) -> Picture:
    """The band around a line, straightened, as PNG: the line lies on top of row `BAND`.

    What would lie outside the photo is transparent.
    """
    height = len(photo)
    rows = np.floor(skyline.rows + 0.5).astype(np.intp)
    around = np.arange(-BAND, BAND + 1)[:, None] + rows[None, :]
    band = photo[around.clip(0, height - 1), np.arange(skyline.width)[None, :]]
    inside = (around >= 0) & (around < height)
    if not inside.all():
        band = np.dstack([band, np.where(inside, 255, 0).astype(np.uint8)])
    return png(_reduced(band, (2 * BAND + 1, width)))


def _reduced(photo: U8, size: tuple[int, int]) -> U8:
    if photo.shape[:2] == size:
        return photo
    reduced: U8 = cv2.resize(photo, size[::-1], interpolation=cv2.INTER_AREA)
    return reduced


def png(pixels: U8) -> Picture:
    """A picture ``(H, W, 3)`` RGB or ``(H, W, 4)`` RGBA without loss."""
    turn = cv2.COLOR_RGBA2BGRA if pixels.shape[2] == 4 else cv2.COLOR_RGB2BGR
    _, data = cv2.imencode(".png", cv2.cvtColor(pixels, turn), _FAST)
    return Picture(data.tobytes(), "image/png")


def jpeg(pixels: U8, quality: int, *, exact_colours: bool = False) -> Picture:
    """A picture ``(H, W, 3)`` RGB as JPEG; with exact colours these are as fine as its greys."""
    how = [cv2.IMWRITE_JPEG_QUALITY, quality]
    if exact_colours:
        how += [cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444]
    _, data = cv2.imencode(".jpg", cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR), how)
    return Picture(data.tobytes(), "image/jpeg")


_FAST = [cv2.IMWRITE_PNG_COMPRESSION, 1]
