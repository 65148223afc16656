"""Which page of a TIFF is the photo, and its samples where they have more than eight bits.

Cameras and scanners put thumbnails before the photo, or the photo into a folder below the first
page. tifffile finds the pages; whichever is the photo is put first, where every decoder finds it.
"""

import io
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from skyline_viz.picture_files.kinds import RAW, RefusedError

_MOST_PAGES = 1000
_REDUCED, _MASK = 1, 4  # bits of NewSubfileType
_CFA, _LINEAR_RAW = 32803, 34892  # how raw files say what their samples are
_RAW_COMPRESSIONS = {32767, 32769, 32770, 34713, 65000, 65535}  # of Sony, Nikon, Samsung, Pentax
_DNG_VERSION, _ORIENTATION, _SUBFILE, _WHITE = 50706, 274, 255, 281
_GREY, _RGB = (0, 1), 2
_DECODED = {1, 2, 3, 4, 5, 6, 7, 8, 32773, 32946, 34925, 50000}
"""Compressions that can be undone; libtiff itself would say so on the screen."""


@dataclass(frozen=True)
class TiffPage:
    """The page that is the photo."""

    size: tuple[int, int]
    """Width and height in pixels, as they are stored."""

    offset: int
    """Where in the file it begins."""

    big: bool
    """Whether the file is a BigTIFF."""

    order: str
    """Byte order of the file: ``<`` or ``>``."""

    first: bool
    """Whether it is the first page of the file."""

    orientation: int
    """Its orientation."""

    inherited: int
    """The same where it stands on the first page only, where decoders do not find it; else 1."""

    deep: bool
    """Whether its samples are grey or RGB of more than eight bits."""

    inverted: bool
    """Whether 0 is white."""

    white: int | None
    """The white that the file names."""

    pages: int
    """How many pages are no thumbnails."""

    alike: int
    """How many of these are of its size, itself among them."""

    notes: tuple[str, ...]
    """What to know about it, to go on after the name of the file."""


def tiff_page(file: BinaryIO, *, of_numbers: bool = False) -> TiffPage:
    """Find the photo of a TIFF: its largest page that is no thumbnail; the first of equal ones.

    Args:
        file: The TIFF.
        of_numbers: Whether its values may be any numbers, as a mask's, for which no white is
            needed.

    Raises:
        RefusedError: It is a raw file, or has numbers for which no white is defined.
        Exception: It is damaged.
    """
    import tifffile  # noqa: PLC0415  # most photos are no TIFF

    file.seek(0)
    with tifffile.TiffFile(file) as tiff:
        main: list[Any] = [page for _, page in zip(range(_MOST_PAGES), tiff.pages, strict=False)]
        pages = [page for one in main for page in _with_below(one)]
        if any(_is_raw(page) for page in pages):
            raise RefusedError(f"is {RAW}")
        full = [page for page in pages if not _is_reduced(page)] or pages
        if not full:
            raise ValueError("it has no page")
        page = max(full, key=lambda page: page.imagewidth * page.imagelength)
        _check_compression(page)
        if not of_numbers:
            _check_white(page)
        notes = []
        several = [one for one in full if _area(one) == _area(page)]
        if len(several) > 1:
            notes.append(f"has {len(several)} pages, of which the first is read")
        elif len(full) > 1:
            notes.append(f"has {len(full)} pages, of which the largest is read")
        tag = page.tags.get(_ORIENTATION) or main[0].tags.get(_ORIENTATION)
        orientation = tag.value if tag and isinstance(tag.value, int) else 1
        inherited = orientation if page.tags.get(_ORIENTATION) is None else 1
        return TiffPage(
            size=(page.imagewidth, page.imagelength),
            offset=page.offset,
            big=tiff.is_bigtiff,
            order=tiff.byteorder,
            first=page.offset == main[0].offset,
            orientation=orientation,
            inherited=inherited,
            deep=_is_deep(page),
            inverted=page.photometric == 0,
            white=_white(page),
            pages=len(full),
            alike=len(several),
            notes=tuple(notes),
        )


def put_first(file: BinaryIO, page: TiffPage) -> BinaryIO:
    """The file with this page as its first."""
    if page.first:
        file.seek(0)
        return file
    file.seek(0)
    data = bytearray(file.read())
    struct.pack_into(
        page.order + ("Q" if page.big else "I"), data, 8 if page.big else 4, page.offset
    )
    return io.BytesIO(data)


def deep_samples(file: BinaryIO) -> npt.NDArray[np.uint16]:
    """RGB samples ``(H, W, 3)`` of a first page that is deep, as they are stored.

    Raises:
        Exception: They are damaged, or cannot be decoded.
    """
    import tifffile  # noqa: PLC0415

    file.seek(0)
    with tifffile.TiffFile(file) as tiff:
        page: Any = tiff.pages[0]
        ends = zip(page.dataoffsets, page.databytecounts, strict=True)
        if max(start + count for start, count in ends) > tiff.filehandle.size:
            raise OSError("image file is truncated")
        if page.compression == 5 or page.bitspersample not in (8, 16):
            return _by_opencv(file, page)
        samples = page.asarray()
        if page.axes.startswith("S"):  # a plane a colour
            samples = np.moveaxis(samples, 0, -1)
    rgb: npt.NDArray[np.uint16] = samples.reshape(page.imagelength, page.imagewidth, -1)[:, :, :3]
    return rgb


def _by_opencv(file: BinaryIO, page: Any) -> npt.NDArray[np.uint16]:  # noqa: ANN401
    import cv2  # noqa: PLC0415

    file.seek(0)
    data = np.frombuffer(file.read(), np.uint8)
    samples = cv2.imdecode(data, cv2.IMREAD_UNCHANGED)
    if samples is None or samples.dtype != np.uint16:
        raise OSError("its compression cannot be undone")
    rgb: npt.NDArray[np.uint16] = samples.reshape(page.imagelength, page.imagewidth, -1)[
        :, :, 2::-1
    ]
    return rgb


def _with_below(page: Any) -> Iterator[Any]:  # noqa: ANN401
    """A page, and those in folders below it."""
    yield page
    try:
        below = page.pages or ()
    except Exception:  # a damaged folder costs nobody the photo
        return
    for one in below:
        yield from _with_below(one)


def _value(page: Any, tag: int) -> Any:  # noqa: ANN401
    found = page.tags.get(tag)
    return found.value if found else None


def _is_raw(page: Any) -> bool:  # noqa: ANN401
    return (
        page.photometric in (_CFA, _LINEAR_RAW)
        or page.compression in _RAW_COMPRESSIONS
        or page.tags.get(_DNG_VERSION) is not None
    )


def _is_reduced(page: Any) -> bool:  # noqa: ANN401
    return bool(int(page.subfiletype) & (_REDUCED | _MASK)) or _value(page, _SUBFILE) == 2


def _area(page: Any) -> tuple[int, int]:  # noqa: ANN401
    return page.imagewidth, page.imagelength


def _is_deep(page: Any) -> bool:  # noqa: ANN401
    return page.photometric in (*_GREY, _RGB) and 8 < page.bitspersample <= 16


def _white(page: Any) -> int | None:  # noqa: ANN401
    """The white that the file names, by a tag or by samples of 10 to 14 bits."""
    named = _value(page, _WHITE)
    named = max(named) if isinstance(named, tuple) and named else named
    if isinstance(named, int) and 255 <= named < 65535:
        return named
    bits = page.bitspersample
    return (1 << bits) - 1 if 8 < bits < 16 else None


def _check_compression(page: Any) -> None:  # noqa: ANN401
    """Refuse what would make libtiff speak on the screen."""
    if page.compression not in _DECODED:
        name = getattr(page.compression, "name", str(page.compression)).replace("_", " ")
        raise RefusedError(f"is compressed by {name}, which cannot be undone inside a TIFF")


def _check_white(page: Any) -> None:  # noqa: ANN401
    """Refuse what would be read wrongly as a photo."""
    sample_format = int(page.sampleformat)
    if sample_format == 3:
        raise RefusedError("has floating-point pixels, which have no defined white")
    if sample_format not in {1, 4}:
        raise RefusedError("has negative or complex pixels, which have no defined white")
    if page.bitspersample > 16:
        raise RefusedError(f"has {page.bitspersample}-bit pixels, which have no defined white")
