"""Reading a picture that is a label, not a photograph: its values as the file says them.

A mask's meaning lies in its palette, its alpha, its depth. `read_photo` makes 8-bit RGB of all of
that; here nothing is turned into anything else.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt
from PIL import Image

from skyline_viz.arrays import U8, Bool, in_colour
from skyline_viz.photo import MIN_SIDE, PhotoError, photo_size, reading
from skyline_viz.picture_files.kinds import kind_of
from skyline_viz.picture_files.orientation import orientation_in, orientation_of, upright_image
from skyline_viz.picture_files.png_chunks import clean_png, png_chunks
from skyline_viz.picture_files.quiet_pillow import QUIET, silence_libtiff
from skyline_viz.picture_files.tiff_pages import put_first, tiff_page
from skyline_viz.system.memory import photo_limit

# Pillow asks them in this order, and from the fifth on it imports all that it knows.
_FORMATS = ("JPEG", "BMP", "GIF", "PPM", "AVIF", "JPEG2000", "WEBP")
_HEAD = 64  # bytes: enough to tell any kind
_PNG = b"\x89PNG\r\n\x1a\n"

MANY = 256
"""Beyond so many different values they are not counted one by one."""


@dataclass(frozen=True)
class LabelPicture:
    """The values of a picture."""

    values: npt.NDArray[Any]
    """Grey levels or palette indices ``(H, W)``, or colours ``(H, W, 3)`` uint8."""

    counts: dict[Any, int] | None
    """Pixels of each value, a number or a tuple; None where there are more than `MANY` values."""

    palette: U8 | None = None
    """``(n, 3)`` colour of each index; None where values are no indices."""

    opaque: Bool | None = None
    """``(H, W)`` what can be seen; None where everything can, or nothing."""

    notes: tuple[str, ...] = ()
    """What was left out of the file, each without its name and without a full stop."""

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width."""
        return self.values.shape[0], self.values.shape[1]

    @property
    def grey(self) -> npt.NDArray[Any] | None:
        """Grey levels ``(H, W)``; None where there is colour. A tint, as JPEG leaves, is none."""
        if self.palette is not None:
            used = self.palette[list(self.counts or range(len(self.palette)))]
            return np.asarray(self.palette[:, 1][self.values]) if _colourless(used) else None
        if self.values.ndim == 2:
            return self.values
        colours = self.values if self.counts is None else np.array(list(self.counts), np.uint8)
        if self.counts is not None and len(set(colours[:, 1].tolist())) < len(colours):
            return None  # a difference would be lost
        return self.values[:, :, 1] if _colourless(colours) else None

    @property
    def colours(self) -> U8:
        """The picture as a viewer shows it, ``(H, W, 3)``, for values of 8 bits."""
        if self.palette is not None:
            return np.asarray(self.palette[self.values])
        if self.values.ndim == 3:
            return self.values
        return np.repeat(self.values.astype(np.uint8)[:, :, None], 3, axis=2)


def read_label_picture(path: str | os.PathLike[str]) -> LabelPicture:
    """Read a picture's values.

    Raises:
        PhotoError: It cannot be read, or its values are no finite numbers.
    """
    with reading(path) as file, QUIET:
        opened = _opened(file, Path(path))
        image = opened.image
        width, height = image.size
        if width * height > photo_limit() * 1e6:
            raise PhotoError(
                f"{path} has {width}x{height} pixels, over the limit of "
                f"{photo_limit():g} megapixels."
            )
        if min(width, height) < MIN_SIDE:
            raise PhotoError(
                f"{path} is {width}x{height} pixels, smaller than {MIN_SIDE}x{MIN_SIDE}."
            )
        deep = ";16" in str(getattr(image, "tile", "")) and not image.mode.startswith("I")
        image.load()
        if deep:
            label = _of_16_bits(opened.file, Path(path), opened.stored)
        else:
            label = _of(upright_image(image, opened.orientation), Path(path))
        return replace(label, notes=opened.notes)


@dataclass(frozen=True)
class _Opened:
    """A file whose picture is not decoded yet."""

    file: BinaryIO
    image: Image.Image
    stored: int
    """How its pixels are stored, an EXIF orientation."""

    orientation: int
    """The same as far as Pillow does not see to it."""

    notes: tuple[str, ...] = ()


def numbered(grey: npt.NDArray[Any], values: npt.NDArray[Any]) -> U8:
    """The place of each pixel's grey level in the sorted list of all, at most 256.

    >>> numbered(np.array([[9, 0, 9]], np.uint8), np.array([0, 9]))
    array([[1, 0, 1]], dtype=uint8)
    """
    if grey.dtype != np.uint8:
        return np.searchsorted(values, grey).astype(np.uint8)
    import cv2  # noqa: PLC0415  # not needed for help

    places = np.zeros(256, np.uint8)
    places[values] = np.arange(len(values))
    return np.asarray(cv2.LUT(grey, places))


def label_size(path: str | os.PathLike[str]) -> tuple[int, int]:
    """Height and width of a picture that is a label, also of one with numbers that no photo has.

    Raises:
        PhotoError: It cannot be read.
    """
    try:
        return photo_size(path)
    except PhotoError:
        return read_label_picture(path).shape


def _opened(file: BinaryIO, path: Path) -> _Opened:
    if file.read(len(_PNG)) == _PNG:
        chunks = png_chunks(file)
        image = Image.open(clean_png(file, chunks), formats=("PNG",))
        orientation = orientation_in(chunks.exif)
        return _Opened(file, image, orientation, orientation)
    file.seek(0)
    if kind_of(file.read(_HEAD), path) == "tiff":
        return _opened_tiff(file, path)
    file.seek(0)
    image = Image.open(file, formats=_FORMATS)
    orientation = orientation_of(image)
    return _Opened(file, image, orientation, orientation)


def _opened_tiff(file: BinaryIO, path: Path) -> _Opened:
    """The page that is no thumbnail, as of a photo; of two masks in a file none is guessed."""
    silence_libtiff()
    page = tiff_page(file, of_numbers=True)
    if page.alike > 1:
        raise PhotoError(
            f"{path} has {page.alike} pages of the same size, and which of them is the mask "
            f"is not said; save that page as a file of its own."
        )
    notes = (f"of its {page.pages} pages the largest was read",) if page.pages > 1 else ()
    first = put_first(file, page)
    image = Image.open(first, formats=("TIFF",))  # which is turned as its own page says
    return _Opened(first, image, page.orientation, page.inherited, notes)


def _of(image: Image.Image, path: Path) -> LabelPicture:
    """The values of an image that Pillow holds without loss."""
    opaque = _opaque(image)
    if image.mode in ("P", "PA"):
        return _of_indices(image, opaque)
    if image.mode in ("L", "LA", "La", "1"):
        plane = image.getchannel(0) if image.mode != "1" else image.convert("L")
        levels = np.asarray(plane)
        counts = {level: count for level, count in enumerate(plane.histogram()) if count}
        return LabelPicture(levels, counts, opaque=opaque)
    if image.mode == "F" or image.mode.startswith("I"):
        numbers = np.asarray(image)
        if not np.isfinite(numbers).all():
            raise PhotoError(f"{path} holds values that are not finite.")
        return LabelPicture(numbers, _counted(numbers), opaque=opaque)
    colour = image if image.mode == "RGB" else image.convert("RGB")
    found = colour.getcolors(MANY)
    counts_of = None if found is None else {value: count for count, value in found}
    return LabelPicture(np.asarray(colour), counts_of, opaque=opaque)


def _of_indices(image: Image.Image, opaque: Bool | None) -> LabelPicture:
    plane = image.getchannel(0) if image.mode == "PA" else image
    indices = np.asarray(plane)
    told = np.array(image.getpalette("RGB") or [], np.uint8).reshape(-1, 3)
    palette = np.zeros((256, 3), np.uint8)  # an index beyond the palette is black
    palette[: len(told)] = told[:256]
    numbers = np.bincount(indices.ravel(), minlength=256)
    counts = {index: int(numbers[index]) for index in np.flatnonzero(numbers).tolist()}
    return LabelPicture(indices, counts, palette, opaque)


def _of_16_bits(file: BinaryIO, path: Path, orientation: int) -> LabelPicture:
    """Colours, or grey with alpha, of 16 bits: Pillow would keep their high bytes alone."""
    import cv2  # noqa: PLC0415  # not needed for help

    if orientation != 1:
        raise PhotoError(f"{path} has 16 bits a colour and is stored turned; save it upright.")
    level = cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    try:
        file.seek(0)
        deep = cv2.imdecode(np.frombuffer(file.read(), np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        deep = None
    finally:
        cv2.utils.logging.setLogLevel(level)
    if deep is None or deep.ndim != 3 or deep.shape[2] not in (3, 4):
        raise PhotoError(f"{path} has 16 bits a colour in a form that cannot be read.")
    colours, alpha = deep[:, :, 2::-1], deep[:, :, 3] if deep.shape[2] == 4 else None
    if colours.max() > 255:
        high = (colours >> 8).astype(np.uint8)
        if (colours != colours[0, 0]).any() and not (high != high[0, 0]).any():
            raise PhotoError(f"{path} has 16 bits a colour, and values too close to tell apart.")
        colours = high
    shown = Image.fromarray(np.ascontiguousarray(colours.astype(np.uint8)))
    found = shown.getcolors(MANY)
    counts = None if found is None else {value: count for count, value in found}
    return LabelPicture(np.asarray(shown), counts, opaque=_told_by(alpha))


def _opaque(image: Image.Image) -> Bool | None:
    """What can be seen, by an alpha channel, or by a colour or index that is transparent."""
    if image.mode in ("LA", "La", "PA", "RGBA", "RGBa"):
        return _told_by(np.asarray(image.getchannel(image.getbands()[-1])))
    clear = image.info.get("transparency")
    if image.mode == "P" and isinstance(clear, int | bytes):
        alpha = np.full(256, 255, np.uint8)
        if isinstance(clear, int):
            alpha[clear % 256] = 0
        else:
            alpha[: len(clear)] = np.frombuffer(clear[:256], np.uint8)
        return _told_by(alpha[np.asarray(image)])
    if isinstance(clear, int) and (image.mode in ("1", "L") or image.mode.startswith("I")):
        return _told_by((np.asarray(image).astype(np.int64) != clear).astype(np.uint8))
    if image.mode == "RGB" and isinstance(clear, tuple):
        return _told_by((~in_colour(np.asarray(image), clear)).astype(np.uint8))
    return None


def _told_by(alpha: npt.NDArray[Any] | None) -> Bool | None:
    """What an alpha plane shows; None where it is the same everywhere and so tells nothing."""
    if alpha is None or alpha.min() == alpha.max():
        return None
    half = (float(alpha.min()) + float(alpha.max())) / 2
    return np.asarray(alpha > half)


def _counted(numbers: npt.NDArray[Any]) -> dict[Any, int] | None:
    if numbers.dtype.kind == "u" and numbers.dtype.itemsize <= 2:
        sums = np.bincount(numbers.ravel())
        values, counts = np.flatnonzero(sums), sums[np.flatnonzero(sums)]
    else:
        values, counts = np.unique(numbers, return_counts=True)
    if len(values) > MANY:
        return None
    return dict(zip(values.tolist(), counts.tolist(), strict=True))


def _colourless(colours: U8) -> bool:
    red, green, blue = (colours[..., one] for one in range(3))
    high, low = (peak(peak(red, green), blue) for peak in (np.maximum, np.minimum))
    return bool((high - low).max(initial=0) < 32)
