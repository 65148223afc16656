"""EXIF orientation: which way up a photo was stored, and how it is turned upright.

An orientation that stands in XMP alone does not count; browsers and viewers do not heed it either.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import ExifTags, Image

_UPRIGHT = {
    2: Image.Transpose.FLIP_LEFT_RIGHT,
    3: Image.Transpose.ROTATE_180,
    4: Image.Transpose.FLIP_TOP_BOTTOM,
    5: Image.Transpose.TRANSPOSE,
    6: Image.Transpose.ROTATE_270,
    7: Image.Transpose.TRANSVERSE,
    8: Image.Transpose.ROTATE_90,
}
_TURNED: dict[int, Callable[[npt.NDArray[Any]], npt.NDArray[Any]]] = {
    2: lambda a: a[:, ::-1],
    3: lambda a: a[::-1, ::-1],
    4: lambda a: a[::-1],
    5: lambda a: a.swapaxes(0, 1),
    6: lambda a: np.rot90(a, -1),
    7: lambda a: np.rot90(a, -1)[::-1],
    8: lambda a: np.rot90(a, 1),
}


def orientation_of(image: Image.Image) -> int:
    """Orientation, 1 to 8, of a picture that Pillow has opened; 1 where none can be read."""
    for xmp in ("xmp", "XML:com.adobe.xmp"):  # Pillow would look there, too
        image.info.pop(xmp, None)
    try:
        return _known(image.getexif())
    except Exception:  # a photo is worth more than its damaged EXIF block
        return 1


def orientation_in(block: bytes | None) -> int:
    """Orientation, 1 to 8, in an EXIF block; 1 where there is none, or none that can be read."""
    exif = Image.Exif()
    try:
        exif.load(block or b"")
        return _known(exif)
    except Exception:
        return 1


def upright_image(image: Image.Image, orientation: int) -> Image.Image:
    """A stored picture, turned upright."""
    turn = _UPRIGHT.get(orientation)
    return image if turn is None else image.transpose(turn)


def upright(pixels: npt.NDArray[Any], orientation: int) -> npt.NDArray[Any]:
    """Pixels ``(H, W, ...)`` of a stored picture, turned upright."""
    turn = _TURNED.get(orientation)
    return pixels if turn is None else np.ascontiguousarray(turn(pixels))


def _known(exif: Image.Exif) -> int:
    value = exif.get(ExifTags.Base.Orientation)
    return value if isinstance(value, int) and value in _UPRIGHT else 1
