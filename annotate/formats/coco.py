"""COCO: the sky of each photo as polygons or run lengths."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from annotate.formats.common import Entry
from annotate.formats.drawings import Drawing, Shape
from annotate.formats.importing import Found
from skyline_viz.datasets.coco import POLYGON, RLE, Region, photos_of_coco
from skyline_viz.files import write_text

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
    for one in photos_of_coco(document, file, found):
        shapes = tuple(map(_shape, one.regions))
        yield Drawing(one.names, one.size, shapes, whole=whole)


def _shape(region: Region) -> Shape:
    kind = "mask" if region.runs else "polygon" if region.rings else "box"
    return Shape(region.label, kind, region.rings, region.runs)


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
