"""Labels for other tools: COCO, LabelMe, CVAT."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET  # documents with a DOCTYPE are refused

import numpy as np
import numpy.typing as npt

from annotate.formats.common import (
    Entry,
    FormatError,
    Imported,
    check_size,
    from_points,
    runs_of_points,
    size_of,
)
from annotate.formats.tables import load_json
from skyline_viz.files import write_text
from skyline_viz.skyline import Skyline

_POLYGON, _RLE = "annotations-polygon.json", "annotations-rle.json"
_SKY, _LINE = "sky", "skyline"


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
    for name, skies in ((_POLYGON, polygons), (_RLE, codes)):
        document = {
            "info": {"description": "Sky above the skyline"},
            "images": images,
            "categories": [{"id": 1, "name": _SKY, "supercategory": "landscape"}],
            "annotations": skies,
        }
        write_text(folder / name, json.dumps(document) + "\n")


def read_coco(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read the sky of each photo: run lengths, plain or compressed, or polygons."""
    file = source
    if source.is_dir():
        file = source / _RLE if (source / _RLE).exists() else source / _POLYGON
    document = load_json(file)
    try:
        categories = {one["id"]: one["name"] for one in document["categories"]}
        images = {one["id"]: one for one in document["images"]}
        found = []
        for one in document["annotations"]:
            image = images[one["image_id"]]
            if categories[one["category_id"]] != _SKY or image["file_name"] not in names:
                continue
            height, width = int(image["height"]), int(image["width"])
            name = names[image["file_name"]]
            rows_there, columns_there = size_of(name, photos)
            if (height, width) != (rows_there, columns_there):
                there = f"{columns_there}x{rows_there}"
                raise FormatError(f"{name} has {there} pixels, its label {width}x{height}.")
            told = one["segmentation"]
            rows = (
                _from_counts(told["counts"], height, width)
                if isinstance(told, dict)
                else _from_polygons(told, height, width)
            )
            found.append(Imported(name, check_size(name, Skyline(rows=rows), photos)))
    except FormatError:
        raise
    except (KeyError, TypeError, ValueError, IndexError, AttributeError, OverflowError) as error:
        raise FormatError(f"{file} is not sound COCO: {error}.") from error
    return found


def write_labelme(entries: list[Entry], folder: Path) -> None:
    """Write a JSON file for each photo, with a line strip for each run of visible columns."""
    for entry in entries:
        label = entry.label
        shapes: list[dict[str, Any]] = [
            {
                "label": _LINE,
                "points": run.tolist() if len(run) > 1 else [*run.tolist(), *run.tolist()],
                "group_id": None,
                "description": "",
                "shape_type": "linestrip",
                "flags": {},
            }
            for run in runs_of_points(entry.skyline)
        ]
        document = {
            "version": "5.5.0",
            "flags": dict.fromkeys(label.tags, True),
            "shapes": shapes,
            "imagePath": label.name,
            "imageData": None,
            "imageHeight": label.height,
            "imageWidth": label.width,
        }
        write_text(folder / f"{entry.stem}.json", json.dumps(document) + "\n")


def read_labelme(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read line strips that are labelled ``skyline``."""
    files = [source] if source.is_file() else sorted(source.glob("*.json"))
    found = []
    for file in files:
        document = load_json(file)
        try:
            name = names.get(document["imagePath"]) or names.get(file.stem)
            runs = [
                _points(shape["points"])
                for shape in document["shapes"]
                if shape["label"] == _LINE and shape["shape_type"] in ("linestrip", "line")
            ]
            tags = tuple(tag for tag, on in document.get("flags", {}).items() if on is True)
            if name is None or not runs:
                continue
            skyline = from_points(runs, _side(document["imageWidth"]))
            height = _side(document.get("imageHeight", 0) or size_of(name, photos)[0])
        except FormatError as error:
            raise FormatError(f"{file}: {error}") from error
        except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as error:
            raise FormatError(f"{file} is not sound LabelMe: {error}.") from error
        found.append(Imported(name, check_size(name, skyline, photos, height), tags))
    return found


def write_cvat(entries: list[Entry], folder: Path) -> None:
    """Write CVAT for images 1.1, with a polyline for each run of visible columns."""
    root = ET.Element("annotations")
    ET.SubElement(root, "version").text = "1.1"
    for number, entry in enumerate(entries):
        label = entry.label
        place = {"id": str(number), "name": _xml_text(label.name)}
        size = {"width": str(label.width), "height": str(label.height)}
        image = ET.SubElement(root, "image", place | size)
        for run in runs_of_points(entry.skyline):
            points = ";".join(f"{x:.2f},{y:.2f}" for x, y in run.tolist())
            how = {"label": _LINE, "source": "semi-auto", "occluded": "0", "z_order": "0"}
            ET.SubElement(image, "polyline", how | {"points": points})
        for tag in label.tags:
            ET.SubElement(image, "tag", {"label": _xml_text(tag), "source": "manual"})
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    write_text(folder / "annotations.xml", f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n')


def read_cvat(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read polylines that are labelled ``skyline``."""
    file = source / "annotations.xml" if source.is_dir() else source
    try:
        text = file.read_text(encoding="utf-8-sig")
        if "<!DOCTYPE" in text or "<!ENTITY" in text:
            raise FormatError(f"{file} declares a document type, which labels do not need.")
        root = ET.fromstring(text)  # noqa: S314  # without a document type there are no entities
    except (OSError, ValueError, ET.ParseError) as error:
        if isinstance(error, FormatError):
            raise
        raise FormatError(f"{file} is not XML: {error}.") from error
    found = []
    for image in root.iter("image"):
        name = names.get(image.get("name", ""))
        lines = [one for one in image.iter("polyline") if one.get("label") == _LINE]
        if name is None or not lines:
            continue
        try:
            pairs = [[p.split(",") for p in one.get("points", "").split(";")] for one in lines]
            skyline = from_points(map(_points, pairs), _side(image.get("width")))
            height = _side(image.get("height", size_of(name, photos)[0]))
        except FormatError as error:
            raise FormatError(f"{file}: {error}") from error
        except (TypeError, ValueError) as error:
            raise FormatError(f"{file}: the line of {name} is not sound: {error}.") from error
        tags = tuple(one.get("label", "") for one in image.iter("tag"))
        found.append(Imported(name, check_size(name, skyline, photos, height), tags))
    return found


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


def _from_counts(counts: list[int] | str, height: int, width: int) -> npt.NDArray[np.float32]:
    if isinstance(counts, str):
        counts = _decompressed(counts)
    lengths = np.array(counts, np.int64)
    if (lengths < 0).any() or lengths.sum() != height * width:
        raise ValueError("run lengths do not fill the photo")
    mask = np.repeat(np.arange(len(lengths)) % 2 == 1, lengths).reshape(width, height).T
    return Skyline.from_mask(mask).rows


def _decompressed(text: str) -> list[int]:
    """Run lengths of COCO's compressed strings: 5 bits a character, changes from the third on."""
    counts: list[int] = []
    value = shift = 0
    for character in text.encode("ascii"):
        bits = character - 48
        if not 0 <= bits < 64 or shift > 60:
            raise ValueError("a compressed run length is damaged")
        value |= (bits & 31) << shift
        shift += 5
        if not bits & 32:
            if bits & 16:
                value -= 1 << shift
            counts.append(value + (counts[-2] if len(counts) > 2 else 0))
            value = shift = 0
    return counts


def _from_polygons(polygons: list[list[float]], height: int, width: int) -> npt.NDArray[np.float32]:
    """Rows where polygons that begin at the top end, at the centre of each column."""
    rows = np.zeros(width, np.float32)
    crossings: list[list[float]] = [[] for _ in range(width)]
    for polygon in polygons:
        points = _points(np.array(polygon, float).reshape(-1, 2))
        for (x0, y0), (x1, y1) in zip(points, np.roll(points, -1, axis=0), strict=True):
            if x0 == x1:
                continue
            low, high = sorted((x0, x1))
            first = max(int(np.ceil(low - 0.5)), 0)
            stop = min(int(np.ceil(high - 0.5)), width)
            for column in range(first, stop):
                share = (column + 0.5 - x0) / (x1 - x0)
                crossings[column].append(float(y0 + share * (y1 - y0)))
    for column, found in enumerate(crossings):
        ends = sorted(found)
        for top, bottom in zip(ends[::2], ends[1::2], strict=False):
            if top <= rows[column] + 0.5:
                rows[column] = np.floor(bottom + 0.5)
    return rows.clip(0, height)


def _points(told: Iterable[Any]) -> npt.NDArray[np.float64]:
    points = np.array(told, np.float64)
    if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
        raise ValueError("points are pairs of finite numbers")
    if np.abs(points).max(initial=0) > 1e6:
        raise ValueError("a point lies far outside any photo")
    return points


def _side(told: Any) -> int:  # noqa: ANN401
    side = int(told)
    if not 0 < side <= 10**5:
        raise ValueError(f"a side of {side} pixels")
    return side


def _xml_text(text: str) -> str:
    """Text without the characters that XML cannot hold."""
    allowed = "".join(one if one >= " " or one in "\t\n" else "?" for one in text)
    return allowed.encode("utf-8", "replace").decode()
