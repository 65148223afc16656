"""Reading photographs safely: any common format in, ``(H, W, 3)`` uint8 RGB out."""

import contextlib
import os
import stat
import threading
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from PIL import ExifTags, Image, UnidentifiedImageError

from skyline_viz import memory
from skyline_viz.arrays import U8
from skyline_viz.files import replacing

PHOTO_SUFFIXES = frozenset(
    {".bmp", ".jpeg", ".jpg", ".pgm", ".png", ".ppm", ".tif", ".tiff", ".webp"}
)
"""File name endings (lower case) that are taken for photographs when a folder is searched."""

MAX_MEGAPIXELS = memory.MAX_MEGAPIXELS
"""Default limit on a photo's size, in million pixels, against decompression bombs."""

MIN_SIDE = 8
"""Smallest height and width of a photo file, in pixels; below it there is no room for a patch."""

_FORMATS = ("BMP", "JPEG", "PNG", "PPM", "TIFF", "WEBP")

_UPRIGHT = {
    2: Image.Transpose.FLIP_LEFT_RIGHT,
    3: Image.Transpose.ROTATE_180,
    4: Image.Transpose.FLIP_TOP_BOTTOM,
    5: Image.Transpose.TRANSPOSE,
    6: Image.Transpose.ROTATE_270,
    7: Image.Transpose.TRANSVERSE,
    8: Image.Transpose.ROTATE_90,
}
"""What turns a photo of each EXIF orientation upright."""


class PhotoError(Exception):
    """A photograph cannot be read; the message is one sentence naming the file and the reason."""


def read_photo(path: str | os.PathLike[str], *, max_megapixels: float | None = None) -> U8:
    """Read one photograph.

    JPEG, PNG, BMP, PGM/PPM, TIFF and WebP, told by content and not by name. EXIF orientation is
    applied; grey, palette and CMYK images become RGB, alpha is dropped, 16-bit values keep their
    high byte.

    Args:
        path: The file.
        max_megapixels: Larger photos are refused before they are decoded; None for the limit of
            this process, which is 150 unless a command has changed it.

    Returns:
        The photo, ``(H, W, 3)`` uint8 RGB.

    Raises:
        PhotoError: Missing, a folder, empty, not an image, truncated, too large or too small.
    """
    with _opened(path) as image:
        width, height = image.size
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
        image.load()
        turn = _UPRIGHT.get(_orientation(image))
        return _to_rgb(image if turn is None else image.transpose(turn))


def photo_size(path: str | os.PathLike[str]) -> tuple[int, int]:
    """Height and width in pixels that `read_photo` would give, from the file's header alone.

    Raises:
        PhotoError: Missing, a folder, empty, or not an image.
    """
    with _opened(path) as image:
        width, height = image.size
        # Asked for EXIF that its header does not have, a PNG is decoded to look behind the pixels.
        in_header = image.format != "PNG" or not image.info.keys().isdisjoint({"exif", "xmp"})
        sideways = in_header and _orientation(image) >= 5
        return (width, height) if sideways else (height, width)


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


def find_photos(folder: str | os.PathLike[str]) -> list[Path]:
    """List the photographs directly inside `folder`, by name.

    Goes by file name endings; hidden files are left out.

    Raises:
        OSError: `folder` is missing, is a file, or may not be listed.
    """
    return sorted(
        file
        for file in Path(folder).iterdir()
        if file.suffix.lower() in PHOTO_SUFFIXES
        and not file.name.startswith(".")
        and file.is_file()
    )


@contextlib.contextmanager
def _opened(path: str | os.PathLike[str]) -> Iterator[Image.Image]:
    """Open an image file lazily; whatever goes wrong in the block comes out as a `PhotoError`."""
    try:
        status = Path(path).stat()
        if stat.S_ISDIR(status.st_mode):
            raise PhotoError(f"{path} is a folder, not a photo.")
        if not stat.S_ISREG(status.st_mode):  # opening a pipe would wait for its other end
            raise PhotoError(f"{path} is a pipe or a device, not a photo.")
        if status.st_size == 0:
            raise PhotoError(f"{path} is empty (0 bytes).")
        with _PILLOW, Image.open(path, formats=_FORMATS) as image:
            yield image
    except PhotoError:
        raise
    except UnidentifiedImageError as error:
        raise PhotoError(f"{path} is not an image in a format that can be read.") from error
    except MemoryError as error:
        raise PhotoError(f"{path} does not fit into memory.") from error
    except Exception as error:  # decoders raise OSError, SyntaxError, ValueError, struct.error, ...
        system = isinstance(error, OSError) and error.errno is not None
        trouble = "cannot be read" if system else "is damaged or cannot be read"
        raise PhotoError(f"{path} {trouble}: {_reason(error)}.") from error


class _Pillow:
    """Pillow without its global pixel limit and its warnings, while at least one photo is read.

    Both are state of the whole process, so the first reader to come puts them aside and the last
    to go puts them back.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._readers = 0
        self._undo = contextlib.ExitStack()

    def __enter__(self) -> None:
        with self._lock:
            if self._readers == 0:
                self._undo.callback(setattr, Image, "MAX_IMAGE_PIXELS", Image.MAX_IMAGE_PIXELS)
                self._undo.enter_context(warnings.catch_warnings())
                Image.MAX_IMAGE_PIXELS = None
                warnings.filterwarnings("ignore", module=r"PIL\.")
            self._readers += 1

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._readers -= 1
            if self._readers == 0:
                self._undo.close()


_PILLOW = _Pillow()


def _orientation(image: Image.Image) -> int:
    """EXIF orientation, 1 to 8; 1 where there is none, or none that can be read."""
    if image.format == "TIFF":  # Pillow itself turns these
        return 1
    try:
        value = image.getexif().get(ExifTags.Base.Orientation)
    except Exception:  # a photo is worth more than its damaged EXIF block
        return 1
    return value if isinstance(value, int) and value in _UPRIGHT else 1


def _to_rgb(image: Image.Image) -> U8:
    if image.mode == "F":
        raise ValueError("floating-point pixels have no defined white")
    if image.mode == "I" and image.format != "PPM":
        raise ValueError("32-bit pixels have no defined white")
    if image.mode.startswith("I"):  # 16-bit grey, which convert("RGB") would clip at 255
        grey = (np.asarray(image).astype(np.int64) >> 8).clip(0, 255).astype(np.uint8)
        return np.repeat(grey[:, :, None], 3, axis=2)
    return np.array(image.convert("RGB"), dtype=np.uint8)


def _reason(error: Exception) -> str:
    text = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return text.splitlines()[0].rstrip(".")[:200].lower()
