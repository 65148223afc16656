"""COCO: regions of photos as polygons or run lengths, as its documents tell them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from skyline_viz.arrays import Bool
from skyline_viz.datasets.outlines import (
    FormatError,
    Points,
    Runs,
    check_pixels,
    points_of,
    polygon_mask,
)
from skyline_viz.skyline import Skyline, SkylineError

POLYGON, RLE = "annotations-polygon.json", "annotations-rle.json"
"""The files that `skyline-annotate export` writes, both of the same regions."""

SKY = "sky"
"""What a category of sky is called, unless another one is named."""


class Reports(Protocol):
    """Gets what is wrong with a document, while the rest of it is read."""

    def problem(self, sentence: str) -> None:
        """Something could not be read, though it should be."""

    def note(self, text: str, of: Any = None) -> None:  # noqa: ANN401
        """Something was left out; the text has no full stop, and `of` names what it is about."""


@dataclass(frozen=True, eq=False)
class Region:
    """A region of a photo; without rings and runs it is no more than a box."""

    label: str
    """Its category."""

    rings: tuple[Points, ...] = ()
    """Corners of polygons whose union it is."""

    runs: Runs | None = None
    """Its pixels."""

    def mask(self, height: int, width: int) -> Bool:
        """Its pixels in a photo of a size.

        Raises:
            FormatError: It does not fit.
        """
        if self.runs is not None:
            return self.runs.mask(height, width)
        return polygon_mask(self.rings, height, width)[0]


@dataclass(frozen=True, eq=False)
class Annotated:
    """A photo of a document, and its regions."""

    names: tuple[str, ...]
    """What the document calls the photo, the likeliest first."""

    size: tuple[int, int] | None
    """Height and width of the photo, where the document says so."""

    regions: tuple[Region, ...]
    """What was drawn on it."""

    def line(self, size: tuple[int, int], sky: str | None, terrain: str | None) -> Skyline:
        """The line below the sky, or above the terrain.

        Args:
            size: Height and width of the photo.
            sky: Category of sky; `SKY` unless given.
            terrain: Category of terrain, instead of `sky`.

        Raises:
            SkylineError: There is no such region, or it does not fit the photo.
        """
        if self.size is not None and self.size != size:
            height, width = self.size
            raise SkylineError(
                f"its regions are drawn on {width}x{height} pixels, and the photo has "
                f"{size[1]}x{size[0]}"
            )
        wanted = (terrain or sky or SKY).casefold()
        chosen = [
            one
            for one in self.regions
            if one.label.strip().casefold() == wanted and (one.rings or one.runs)
        ]
        if not chosen:
            labels = ", ".join(sorted({one.label for one in self.regions})) or "none"
            raise SkylineError(f"no region is called {wanted}; its regions are {labels}")
        found = np.zeros(size, np.bool_)
        try:
            for one in chosen:
                found |= one.mask(*size)
        except FormatError as error:
            raise SkylineError(f"{error}") from error
        return Skyline.from_mask(~found if terrain else found)


def is_coco(document: object) -> bool:
    """Whether a JSON document is COCO."""
    return isinstance(document, dict) and {"images", "annotations"} <= document.keys()


def photos_of_coco(document: dict[str, Any], file: object, found: Reports) -> Iterator[Annotated]:
    """What a COCO document says of each photo.

    Args:
        document: The document.
        file: What to call it in sentences.
        found: Gets what is wrong.

    Raises:
        FormatError: Its parts are no lists of objects.
    """
    categories = {
        one["id"]: one["name"]
        for one in _objects(document.get("categories", []), "categories", file)
        if isinstance(one.get("id"), int | str) and isinstance(one.get("name"), str)
    }
    images: dict[int | str, tuple[dict[str, Any], list[Region]]] = {}
    for one in _objects(document.get("images", []), "images", file):
        if not isinstance(one.get("id"), int | str):
            found.problem(f"{file}: an image has no id that is a number or text.")
        elif one["id"] in images:
            found.problem(f"{file}: two images have the id {one['id']}.")
        else:
            images[one["id"]] = (one, [])
    for place, one in enumerate(_objects(document["annotations"], "annotations", file), 1):
        shown, image = one.get("id", place), one.get("image_id")
        if not isinstance(image, int | str) or image not in images:
            found.note(f"{file}: annotations whose image is not in the file were left out", shown)
            continue
        category = one.get("category_id")
        known = isinstance(category, int | str) and category in categories
        label = categories[category] if known else f"category {category!r:.40}"
        try:
            images[image][1].append(_region(label, one.get("segmentation")))
        except FormatError as error:
            found.problem(f"{file}: annotation {shown!r:.40} is left out: {error}.")
    for image, regions in images.values():
        try:
            names = [text_of(image.get("file_name"), "its file_name")]
            extra = image.get("extra")  # Roboflow keeps the name that a photo had before it
            if isinstance(extra, dict) and isinstance(extra.get("name"), str):
                names.append(extra["name"])
            size = size_of_drawing(image.get("height"), image.get("width"))
        except FormatError as error:
            found.problem(f"{file}: the image {image['id']!r:.40} is left out: {error}.")
        else:
            yield Annotated(tuple(names), size, tuple(regions))


def text_of(told: Any, what: str) -> str:  # noqa: ANN401
    """A value that is text.

    Raises:
        FormatError: It is not.
    """
    if not isinstance(told, str):
        raise FormatError(f"{what} is no text")
    return told


def list_of(told: Any, what: str) -> list[Any]:  # noqa: ANN401
    """A value that is a list.

    Raises:
        FormatError: It is not.
    """
    if not isinstance(told, list):
        raise FormatError(f"{what} is no list")
    return told


def side_of(told: Any) -> int:  # noqa: ANN401
    """A height or width in pixels.

    Raises:
        FormatError: It is none.
    """
    try:
        side = int(told)
    except (TypeError, ValueError, OverflowError):
        raise FormatError("its height or width is no number") from None
    if not 0 < side <= 10**5 or isinstance(told, bool):
        raise FormatError(f"a side of {side} pixels is none of a photo")
    return side


def size_of_drawing(height: Any, width: Any) -> tuple[int, int] | None:  # noqa: ANN401
    """The size that a file tells; None where it tells none.

    Raises:
        FormatError: It is none of a photo.
    """
    return None if height is None or width is None else (side_of(height), side_of(width))


def _objects(told: Any, what: str, file: object) -> Sequence[dict[str, Any]]:  # noqa: ANN401
    if not isinstance(told, list) or not all(isinstance(one, dict) for one in told):
        raise FormatError(f"{file} is not sound COCO: its {what} are no list of objects.")
    return told


def _region(label: str, told: Any) -> Region:  # noqa: ANN401
    if isinstance(told, dict):
        return Region(label, runs=_runs(told))
    if not told:
        return Region(label)
    rings = list_of(told, "its segmentation")
    if not isinstance(rings[0], list):
        rings = [rings]
    found = []
    for ring in rings:
        if not isinstance(ring, list) or len(ring) % 2 or len(ring) < 6:
            raise FormatError("a polygon is no list of three or more points")
        found.append(points_of([ring[place : place + 2] for place in range(0, len(ring), 2)]))
    check_pixels(found)
    return Region(label, tuple(found))


def _runs(told: dict[str, Any]) -> Runs:
    size, counts = told.get("size"), told.get("counts")
    if not isinstance(size, list) or len(size) != 2 or not all(type(one) is int for one in size):
        raise FormatError("the size of its run lengths is no height and width")
    lengths = _decompressed(counts) if isinstance(counts, str) else list_of(counts, "its counts")
    if not all(type(one) is int and one >= 0 for one in lengths):
        raise FormatError("its run lengths are no whole numbers")
    runs = Runs(tuple(lengths), *size)
    runs.check()
    return runs


def _decompressed(text: str) -> list[int]:
    """Run lengths of COCO's compressed strings: 5 bits a character, changes from the third on."""
    counts: list[int] = []
    value = shift = 0
    for character in text:
        bits = ord(character) - 48
        if not 0 <= bits < 64 or shift > 60:
            raise FormatError("a compressed run length is damaged")
        value |= (bits & 31) << shift
        shift += 5
        if not bits & 32:
            if bits & 16:
                value -= 1 << shift
            counts.append(value + (counts[-2] if len(counts) > 2 else 0))
            value = shift = 0
    if shift:
        raise FormatError("a compressed run length is cut off")
    return counts
