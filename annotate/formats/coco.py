"""COCO: the sky of each photo as polygons or run lengths."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from annotate.formats.common import Entry, FormatError
from annotate.formats.drawings import Drawing, Shape, list_of, size_of_drawing, text_of
from annotate.formats.importing import Found
from annotate.formats.outlines import Runs, check_pixels, points_of
from skyline_viz.files import write_text

POLYGON, RLE = "annotations-polygon.json", "annotations-rle.json"
"""The files that are written."""

_OURS = "Sky above the skyline"


def write_coco(entries: list[Entry], folder: Path) -> None:
    """Write the sky of each photo as a polygon, and once more run-length encoded."""
    images, polygons, codes = [], [], []
    for number, entry in enumerate(entries, 1):
        label, rows = entry.label, entry.skyline.pixel_rows(entry.label.height)
        images.append(
            {
                "id": number,
                "file_name": label.name,
                "width": label.width,
                "height": label.height,
            }
        )
        common = {
            "id": number,
            "image_id": number,
            "category_id": 1,
            "area": int(rows.sum()),
            "bbox": _box(rows),
        }
        outline = {"segmentation": [_outline(rows)], "iscrowd": 0}
        counts = {"size": [label.height, label.width], "counts": _counts(rows, label.height)}
        polygons.append(common | outline)
        codes.append(common | {"segmentation": counts, "iscrowd": 1})
    for name, skies in ((POLYGON, polygons), (RLE, codes)):
        document = {
            "info": {"description": _OURS},
            "images": images,
            "categories": [{"id": 1, "name": "sky", "supercategory": "landscape"}],
            "annotations": skies,
        }
        write_text(folder / name, json.dumps(document) + "\n")


def drawings_of_coco(document: dict[str, Any], file: Path, found: Found) -> Iterator[Drawing]:
    """What a COCO document says of each photo."""
    about = document.get("info")
    whole = isinstance(about, dict) and about.get("description") == _OURS
    categories = {
        one["id"]: one["name"]
        for one in _objects(document.get("categories", []), "categories", file)
        if isinstance(one.get("id"), int | str) and isinstance(one.get("name"), str)
    }
    images: dict[int | str, tuple[dict[str, Any], list[Shape]]] = {}
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
            images[image][1].append(_shape(label, one.get("segmentation")))
        except FormatError as error:
            found.problem(f"{file}: annotation {shown!r:.40} is left out: {error}.")
    for image, shapes in images.values():
        try:
            names = [text_of(image.get("file_name"), "its file_name")]
            extra = image.get("extra")  # Roboflow keeps the name that a photo had before it
            if isinstance(extra, dict) and isinstance(extra.get("name"), str):
                names.append(extra["name"])
            size = size_of_drawing(image.get("height"), image.get("width"))
        except FormatError as error:
            found.problem(f"{file}: the image {image['id']!r:.40} is left out: {error}.")
        else:
            yield Drawing(tuple(names), size, tuple(shapes), whole=whole)


def _objects(told: Any, what: str, file: Path) -> list[dict[str, Any]]:  # noqa: ANN401
    if not isinstance(told, list) or not all(isinstance(one, dict) for one in told):
        raise FormatError(f"{file} is not sound COCO: its {what} are no list of objects.")
    return told


def _shape(label: str, told: Any) -> Shape:  # noqa: ANN401
    if isinstance(told, dict):
        return Shape(label, "mask", runs=_runs(told))
    if not told:
        return Shape(label, "box")
    rings = list_of(told, "its segmentation")
    if not isinstance(rings[0], list):
        rings = [rings]
    found = []
    for ring in rings:
        if not isinstance(ring, list) or len(ring) % 2 or len(ring) < 6:
            raise FormatError("a polygon is no list of three or more points")
        found.append(points_of([ring[place : place + 2] for place in range(0, len(ring), 2)]))
    check_pixels(found)
    return Shape(label, "polygon", tuple(found))


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


def _box(rows: npt.NDArray[np.intp]) -> list[int]:
    """Left, top, width and height of the sky."""
    columns = np.flatnonzero(rows)
    if len(columns) == 0:
        return [0, 0, 0, 0]
    return [int(columns[0]), 0, int(np.ptp(columns)) + 1, int(rows.max())]


def _outline(rows: npt.NDArray[np.intp]) -> list[float]:
    """Outline of the sky on the borders of pixels, clockwise: x, y, x, y, ..."""
    width = len(rows)
    changes = np.flatnonzero(np.diff(rows)) + 1
    points = [(0, 0), (width, 0), (width, int(rows[-1]))]
    for column in changes[::-1].tolist():
        points += [(column, int(rows[column])), (column, int(rows[column - 1]))]
    points.append((0, int(rows[0])))
    return [float(one) for point in points for one in point]


def _counts(rows: npt.NDArray[np.intp], height: int) -> list[int]:
    """Run lengths down the columns, beginning with a run outside the sky."""
    counts = [0]
    for row in rows.tolist():
        for length, inside in ((row, True), (height - row, False)):
            if length == 0:
                continue
            if (len(counts) % 2 == 0) == inside:
                counts[-1] += length
            else:
                counts.append(length)
    return counts
