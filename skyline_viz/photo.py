"""Reading photographs safely: any common format in, ``(H, W, 3)`` uint8 RGB out.

What a file is, `picture_files.kinds` tells. How its bytes become pixels is written in
`picture_files.decoding`.
"""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from PIL import Image, UnidentifiedImageError

from skyline_viz.arrays import U8
from skyline_viz.files import replacing
from skyline_viz.picture_files.decoding import decoded, opened
from skyline_viz.picture_files.kinds import PHOTO_SUFFIXES, RefusedError, unknown
from skyline_viz.picture_files.listing import checked_file, find_photos
from skyline_viz.system import memory

__all__ = [
    "MAX_MEGAPIXELS",
    "MIN_SIDE",
    "PHOTO_SUFFIXES",
    "PhotoError",
    "find_photos",
    "photo_from",
    "photo_size",
    "read_photo",
    "read_photo_with_notes",
    "reading",
    "write_photo",
]

MAX_MEGAPIXELS = memory.MAX_MEGAPIXELS
"""Default limit on a photo's size, in million pixels, against decompression bombs."""

MIN_SIDE = 8
"""Smallest height and width of a photo file, in pixels; below it there is no room for a patch."""


class PhotoError(Exception):
    """A photograph cannot be read; the message is one sentence naming the file and the reason."""


def read_photo(path: str | os.PathLike[str], *, max_megapixels: float | None = None) -> U8:
    """Read one photograph.

    JPEG, PNG, HEIC, AVIF, WebP, TIFF, JPEG 2000, GIF, BMP and PGM/PPM, told by content and not by
    name; docs/photos.md says what becomes of each. EXIF orientation is applied; grey, palette and
    CMYK images become RGB; what is transparent is filled; deeper samples are scaled to 8 bits.

    Args:
        path: The file.
        max_megapixels: Larger photos are refused before they are decoded; None for the limit of
            this process, which is 150 unless a command has changed it.

    Returns:
        The photo, ``(H, W, 3)`` uint8 RGB.

    Raises:
        PhotoError: Missing, a folder, empty, not an image, a raw file, truncated, too large or
            too small.

    Examples:
        >>> import numpy as np
        >>> from tempfile import TemporaryDirectory
        >>> with TemporaryDirectory() as folder:
        ...     write_photo(f"{folder}/photo.png", np.zeros((8, 12, 3), np.uint8))
        ...     read_photo(f"{folder}/photo.png").shape
        (8, 12, 3)
    """
    return read_photo_with_notes(path, max_megapixels=max_megapixels)[0]


def read_photo_with_notes(
    path: str | os.PathLike[str], *, max_megapixels: float | None = None
) -> tuple[U8, tuple[str, ...]]:
    """Read one photograph, and hear what had to be decided about it; see `read_photo`.

    Returns:
        The photo, and a sentence for each thing that is not as it should be and did not hinder:
        samples of 12 bits in a file of 16, transparent pixels, a missing end. Each names the file.

    Raises:
        PhotoError: As `read_photo`.
    """
    with reading(path) as file:
        return _photo_in(file, path, max_megapixels)


def photo_from(
    file: BinaryIO, name: str, *, max_megapixels: float | None = None
) -> tuple[U8, tuple[str, ...]]:
    """Read one photograph from an open file, wherever its bytes come from; see `read_photo`.

    Args:
        file: The bytes, at their beginning; they can be read from any place.
        name: What to call it; an ending tells raw files, as that of a path does.
        max_megapixels: As `read_photo` takes it.

    Returns:
        As `read_photo_with_notes` does.

    Raises:
        PhotoError: As `read_photo`.
    """
    with _said_of(name):
        return _photo_in(file, name, max_megapixels)


def _photo_in(
    file: BinaryIO, path: str | os.PathLike[str], max_megapixels: float | None
) -> tuple[U8, tuple[str, ...]]:
    with opened(file, Path(path)) as image:
        height, width = image.shape
        if max_megapixels is None:
            max_megapixels = memory.photo_limit()
        if width * height > max_megapixels * 1e6:
            raise PhotoError(
                f"{path} has {width}x{height} pixels, over the limit of "
                f"{max_megapixels:g} megapixels."
            )
        if min(width, height) < MIN_SIDE:
            raise PhotoError(
                f"{path} is {width}x{height} pixels, smaller than {MIN_SIDE}x{MIN_SIDE}."
            )
        pixels, notes = decoded(image)
        return pixels, tuple(f"{path} {note}." for note in notes)


def photo_size(path: str | os.PathLike[str]) -> tuple[int, int]:
    """Height and width in pixels that `read_photo` would give, from the file's header alone.

    Raises:
        PhotoError: Missing, a folder, empty, not an image, or a raw file.
    """
    with reading(path) as file, opened(file, Path(path)) as image:
        return image.shape


def write_photo(path: str | os.PathLike[str], photo: U8, *, quality: int = 90) -> None:
    """Write a photo, mask or picture; the format follows the name, the file appears whole.

    Args:
        path: Where to; JPEG, PNG, BMP, TIFF or WebP by its ending.
        photo: ``(H, W, 3)`` RGB or ``(H, W)`` grey, uint8.
        quality: JPEG and WebP quality, 1 to 100.

    Raises:
        ValueError: The ending is that of no known format.
    """
    with replacing(path) as temporary:
        Image.fromarray(photo).save(temporary, quality=quality)


@contextlib.contextmanager
def reading(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Open a picture's file; whatever goes wrong in the block comes out as a `PhotoError`."""
    with _said_of(path):
        if wrong := checked_file(Path(path)):
            raise PhotoError(f"{path} {wrong}.")
        with Path(path).open("rb") as file:
            yield file


@contextlib.contextmanager
def _said_of(path: str | os.PathLike[str]) -> Iterator[None]:
    """Whatever goes wrong in the block comes out as a `PhotoError` that names a file."""
    try:
        yield
    except PhotoError:
        raise
    except RefusedError as error:
        raise PhotoError(f"{path} {error}.") from error
    except UnidentifiedImageError as error:
        raise PhotoError(f"{path} {unknown(Path(path))}.") from error
    except MemoryError as error:
        raise PhotoError(f"{path} does not fit into memory.") from error
    except Exception as error:  # decoders raise OSError, SyntaxError, ValueError, struct.error, ...
        system = isinstance(error, OSError) and error.errno is not None
        trouble = "cannot be read" if system else "is damaged or cannot be read"
        raise PhotoError(f"{path} {trouble}: {_reason(error)}.") from error


def _reason(error: Exception) -> str:
    text = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return text.splitlines()[0].rstrip(".")[:200].lower()
