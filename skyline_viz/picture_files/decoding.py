"""From the bytes of a photo to upright ``(H, W, 3)`` pixels: what differs from format to format."""

import contextlib
import io
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

import numpy as np
from PIL import Image

from skyline_viz.arrays import U8
from skyline_viz.picture_files.jpeg_ends import SMALL_LOSS, completed, missing_rows
from skyline_viz.picture_files.kinds import kind_of
from skyline_viz.picture_files.orientation import (
    orientation_in,
    orientation_of,
    upright,
    upright_image,
)
from skyline_viz.picture_files.pixel_depth import (
    Deep,
    differs_from_screens,
    for_screens,
    to_eight_bits,
    white_of,
)
from skyline_viz.picture_files.png_chunks import clean_png, png_chunks
from skyline_viz.picture_files.quiet_pillow import QUIET, silence_libtiff
from skyline_viz.picture_files.tiff_pages import deep_samples, put_first, tiff_page
from skyline_viz.picture_files.transparency import without_transparency

# Pillow asks them in this order, and from the sixth on it imports all that it knows.
_FORMATS = ("JPEG", "PNG", "BMP", "GIF", "PPM", "AVIF", "JPEG2000", "TIFF", "WEBP")
_FILMS = ("AVIF", "GIF", "WEBP")
_HEAD = 64  # bytes: enough to tell any kind
_DIM = 64  # high bytes below it may be those of 14-bit samples, whose low bytes matter
_STRIP = 1 << 20  # bytes of a picture that are copied at once; Pillow keeps four a pixel
_PPM = re.compile(rb"P([56])\s+(?:#.*\n\s*)*\d+\s+(?:#.*\n\s*)*\d+\s+(?:#.*\n\s*)*(\d+)\s")


@dataclass
class Opened:
    """A photo file whose header has been read."""

    file: BinaryIO
    """The file."""

    size: tuple[int, int]
    """Width and height as they are stored."""

    open: Callable[[], Image.Image]
    """Its picture, not decoded yet; to be closed by the caller."""

    orientation: int = 1
    """EXIF orientation, 1 to 8, as far as Pillow does not see to it."""

    notes: list[str] = field(default_factory=list)
    """What is wrong with the file, to go on after its name."""

    deep: Callable[[], Deep] | None = None
    """Upright RGB samples of 16 bits, of which Pillow keeps the high bytes only."""

    bits: int = 0
    """How many bits of a deep sample count, where the file says so."""

    white: int | None = None
    """Which deep sample is white, where the file says so."""

    inverted: bool = False
    """Whether 0 is white in deep samples."""

    gamma: float | None = None
    """The exponent of its encoding, where it is not that of screens."""

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width when it is upright."""
        width, height = self.size
        return (width, height) if self.orientation >= 5 else (height, width)


@contextlib.contextmanager
def opened(file: BinaryIO, path: Path) -> Iterator[Opened]:
    """Read the header of a photo.

    Args:
        file: The file, open at its beginning.
        path: Its name.

    Raises:
        RefusedError: It is a picture of a kind that is not read.
        Exception: It is none at all, or damaged.
    """
    head = file.read(_HEAD)
    file.seek(0)
    opener = {"png": _png, "tiff": _tiff, "heif": _heif}.get(kind_of(head, path), _by_pillow)
    with QUIET:
        yield opener(file)


def decoded(photo: Opened) -> tuple[U8, list[str]]:
    """Decode a photo: upright pixels ``(H, W, 3)``, and what to know about them.

    Raises:
        Exception: It is damaged.
    """
    notes = list(photo.notes)
    with photo.open() as image:
        whole = _loaded(photo, image, notes)
        return _pixels(photo, upright_image(whole, photo.orientation), notes), notes


def _loaded(photo: Opened, image: Image.Image, notes: list[str]) -> Image.Image:
    """The decoded picture, mended where only its end is missing."""
    try:
        image.load()
    except OSError as error:
        if image.format not in ("JPEG", "MPO") or "truncated" not in str(error):
            raise
        image, note = _completed(photo.file)
        notes.append(note)
    if image.mode == "F":
        raise ValueError("floating-point pixels have no defined white")
    if image.mode == "I" and image.format != "PPM":
        raise ValueError("32-bit pixels have no defined white")
    return image


def _pixels(photo: Opened, image: Image.Image, notes: list[str]) -> U8:
    """Pixels of an upright picture; see `decoded`."""
    if image.mode.startswith("I"):  # 16-bit grey, which convert("RGB") would clip at 255
        samples = np.asarray(image).clip(0, 65535).astype(np.uint16)
        return _to_eight_bits(photo, samples, notes)[:, :, None].repeat(3, axis=2)
    alpha = None
    if image.has_transparency_data:
        both = np.asarray(image.convert("RGBA"))
        pixels, alpha = np.ascontiguousarray(both[:, :, :3]), both[:, :, 3]
    else:
        pixels = _rgb(image)
    if photo.deep and (photo.gamma or pixels.max() < _DIM):
        pixels = _to_eight_bits(photo, photo.deep(), notes)
    elif photo.gamma:
        pixels = for_screens(photo.gamma)[pixels]
    if alpha is not None:
        pixels, transparent = without_transparency(pixels, alpha)
        notes += [transparent] if transparent else []
    return pixels


def _rgb(image: Image.Image) -> U8:
    """Pixels of a decoded picture, whatever its colours are.

    Pillow converts and hands out whole pictures through three further copies. It is done here a
    strip at a time, whose copies stay in the processor's cache.
    """
    width, height = image.size
    pixels = np.empty((height, width, 3), np.uint8)
    step = max(_STRIP // (4 * width), 1)
    for top in range(0, height, step):
        strip = image.crop((0, top, width, min(top + step, height)))
        if strip.mode != "RGB":
            strip = strip.convert("RGB")
        pixels[top : top + step] = np.asarray(strip)
    return pixels


def _by_pillow(file: BinaryIO) -> Opened:
    image = Image.open(file, formats=_FORMATS)
    photo = Opened(file, image.size, lambda: image, orientation_of(image))
    if image.format in _FILMS and getattr(image, "is_animated", False):
        photo.notes.append("is an animation, of which the first picture is read")
    if image.format == "PPM":
        _look_at_ppm(photo)
    if image.format == "JPEG2000" and image.mode.startswith("RGB"):
        _look_at_jpeg2000(photo)
    return photo


def _heif(file: BinaryIO) -> Opened:
    from pillow_heif import HeifImageFile  # noqa: PLC0415  # other photos do not need it

    image: Image.Image = HeifImageFile(file)  # type: ignore[no-untyped-call]
    # it is turned as the container says, and its EXIF says so
    return Opened(file, image.size, lambda: image, orientation_of(image))


def _png(file: BinaryIO) -> Opened:
    chunks = png_chunks(file)

    def clean() -> io.BytesIO:
        return clean_png(file, chunks)

    photo = Opened(file, chunks.size, lambda: Image.open(clean(), formats=("PNG",)))
    photo.orientation = orientation_in(chunks.exif)
    photo.notes += chunks.notes
    if differs_from_screens(chunks.gamma):
        photo.gamma = chunks.gamma
    if chunks.depth == 16:
        photo.bits = chunks.significant_bits or 0
        if chunks.colour != 0:
            photo.deep = lambda: upright(_by_opencv(clean()), photo.orientation)
    return photo


def _tiff(file: BinaryIO) -> Opened:
    silence_libtiff()
    page = tiff_page(file)
    image = Image.open(
        put_first(file, page), formats=("TIFF",)
    )  # which is turned as its own page says
    photo = Opened(file, image.size, lambda: image, page.inherited, list(page.notes))
    photo.white, photo.inverted = page.white, page.inverted
    if page.deep and not image.mode.startswith("I"):
        photo.deep = lambda: upright(deep_samples(put_first(file, page)), page.orientation)
    return photo


def _look_at_ppm(photo: Opened) -> None:
    """Find out which value is white in a PGM or PPM of more than eight bits."""
    photo.file.seek(0)
    found = _PPM.match(photo.file.read(1024))
    photo.file.seek(0)
    if found and found[2] != b"65535":
        photo.white = 65535  # to which Pillow scales what is white
    elif found and found[1] == b"6":
        photo.deep = lambda: _by_opencv(photo.file)


def _look_at_jpeg2000(photo: Opened) -> None:
    """Find out whether colours of a JPEG 2000 have more than eight bits."""
    photo.file.seek(0)
    head = photo.file.read(1 << 16)
    photo.file.seek(0)
    begin = head.find(b"\xff\x4f\xff\x51")  # the codestream, and how it is laid out
    depth = (head[begin + 42] & 127) + 1 if 0 <= begin < len(head) - 42 else 8
    if depth > 8:
        photo.white = (1 << depth) - 1 if depth < 16 else None
        photo.deep = lambda: _by_opencv(photo.file)


def _by_opencv(file: BinaryIO) -> Deep:
    """RGB samples of 16 bits of a file that Pillow could decode, too."""
    import cv2  # noqa: PLC0415

    file.seek(0)
    samples = cv2.imdecode(np.frombuffer(file.read(), np.uint8), cv2.IMREAD_UNCHANGED)
    if samples is None or samples.dtype != np.uint16 or samples.ndim != 3:
        raise OSError("its 16-bit colours cannot be decoded")
    colours: Deep = samples[:, :, 2::-1]
    return colours


def _to_eight_bits(photo: Opened, samples: Deep, notes: list[str]) -> U8:
    white, note = white_of(samples, photo.white, photo.bits)
    notes += [note] if note else []
    return to_eight_bits(samples, white, inverted=photo.inverted, gamma=photo.gamma)


def _completed(file: BinaryIO) -> tuple[Image.Image, str]:
    """A JPEG whose end is missing, with its last whole row in place of the missing ones."""
    file.seek(0)
    data = file.read()
    missing = missing_rows(data)
    with Image.open(io.BytesIO(completed(data)), formats=("JPEG",)) as image:
        image.load()
    height = image.height
    if missing > SMALL_LOSS * height:
        lost = "" if missing == height else f", and {missing / height:.0%} of its rows are missing"
        raise OSError(f"image file is truncated{lost}")
    if not missing:
        return image, "ends without its end marker, but all of its pixels are there"
    last = image.crop((0, height - missing - 1, image.width, height - missing))
    image.paste(last.resize((image.width, missing)), (0, height - missing))
    return image, f"is cut off: its last {missing} rows are missing, and repeat the one before"
