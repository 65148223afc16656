"""Reading photographs safely: any common format in, ``(H, W, 3)`` uint8 RGB out."""

import os
import threading
from pathlib import Path

import numpy as np
from PIL import Image, ImageOps, UnidentifiedImageError

from skyline_viz.arrays import U8
from skyline_viz.files import replacing

PHOTO_SUFFIXES = frozenset(
    {".bmp", ".jpeg", ".jpg", ".pgm", ".png", ".ppm", ".tif", ".tiff", ".webp"}
)
"""File name endings (lower case) that are taken for photographs when a folder is searched."""

MAX_MEGAPIXELS = 150.0
"""Default limit on a photo's size, in million pixels, against decompression bombs."""

MIN_SIDE = 8
"""Smallest height and width of a photo file, in pixels; below it there is no room for a patch."""

_FORMATS = ("BMP", "JPEG", "MPO", "PNG", "PPM", "TIFF", "WEBP")
_pillow_limit = threading.Lock()


class PhotoError(Exception):
    """A photograph cannot be read; the message is one sentence naming the file and the reason."""


def read_photo(path: str | os.PathLike[str], *, max_megapixels: float = MAX_MEGAPIXELS) -> U8:
    """Read one photograph.

    JPEG, PNG, BMP, PGM/PPM, TIFF and WebP, told by content and not by name. EXIF orientation is
    applied; grey, palette and CMYK images become RGB, alpha is dropped, 16-bit values keep their
    high byte.

    Args:
        path: The file.
        max_megapixels: Larger photos are refused before they are decoded.

    Returns:
        The photo, ``(H, W, 3)`` uint8 RGB.

    Raises:
        PhotoError: Missing, a folder, empty, not an image, truncated, too large or too small.
    """
    file = Path(path)
    if file.is_dir():
        raise PhotoError(f"{file} is a folder, not a photo.")
    try:
        size = file.stat().st_size
    except OSError as error:
        raise PhotoError(f"{file} cannot be read: {_reason(error)}.") from error
    if size == 0:
        raise PhotoError(f"{file} is empty (0 bytes).")
    try:
        with _open(file) as image:
            width, height = image.size
            if width * height > max_megapixels * 1e6:
                raise PhotoError(
                    f"{file} has {width}x{height} pixels, over the limit of "
                    f"{max_megapixels:g} megapixels."
                )
            if min(width, height) < MIN_SIDE:
                raise PhotoError(
                    f"{file} is {width}x{height} pixels, smaller than {MIN_SIDE}x{MIN_SIDE}."
                )
            return _to_rgb(image)
    except PhotoError:
        raise
    except UnidentifiedImageError as error:
        raise PhotoError(f"{file} is not an image in a format that can be read.") from error
    except MemoryError as error:
        raise PhotoError(f"{file} does not fit into memory.") from error
    except Exception as error:  # decoders raise OSError, SyntaxError, ValueError, struct.error, ...
        raise PhotoError(f"{file} is damaged or cannot be read: {_reason(error)}.") from error


def write_photo(path: str | os.PathLike[str], photo: U8, *, quality: int = 90) -> None:
    """Write a photo, mask or picture; the format follows the name, the file appears whole.

    Args:
        path: Where to; JPEG, PNG, BMP, TIFF or WebP by its ending.
        photo: ``(H, W, 3)`` RGB or ``(H, W)`` grey, uint8.
        quality: JPEG and WebP quality, 1 to 100.
    """
    with replacing(path) as temporary:
        Image.fromarray(photo).save(temporary, quality=quality)


def find_photos(folder: str | os.PathLike[str]) -> list[Path]:
    """List the photographs directly inside `folder`, by name.

    Goes by file name endings; hidden files are left out.
    """
    return sorted(
        file
        for file in Path(folder).iterdir()
        if file.suffix.lower() in PHOTO_SUFFIXES
        and not file.name.startswith(".")
        and file.is_file()
    )


def _open(file: Path) -> Image.Image:
    """Open lazily, with this module's own pixel limit in place of Pillow's global one."""
    with _pillow_limit:
        limit, Image.MAX_IMAGE_PIXELS = Image.MAX_IMAGE_PIXELS, None
        try:
            return Image.open(file, formats=_FORMATS)
        finally:
            Image.MAX_IMAGE_PIXELS = limit


def _to_rgb(image: Image.Image) -> U8:
    if image.mode == "F":
        raise ValueError("floating-point pixels have no defined white")
    upright = ImageOps.exif_transpose(image)
    if upright.mode.startswith("I"):  # 16-bit grey, which convert("RGB") would clip at 255
        grey = (np.asarray(upright).astype(np.int64) >> 8).clip(0, 255).astype(np.uint8)
        return np.repeat(grey[:, :, None], 3, axis=2)
    return np.array(upright.convert("RGB"), dtype=np.uint8)


def _reason(error: Exception) -> str:
    text = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return text.splitlines()[0].rstrip(".")[:200].lower()
