"""Telling a file's kind by its content: a format that is read, or, in words, what it is instead."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from annotate.formats.documents import json_of, xml_of
from skyline_viz.datasets.tables.parquet_files import SUFFIX
from skyline_viz.photo import PHOTO_SUFFIXES
from skyline_viz.skyline import CSV_HEADERS

READ = frozenset({"json", "coco", "labelme", "cvat", "csv", "mask", "parquet"})
"""Kinds that are formats; any other kind is in words."""

_SAYS = {"skyline-labels": "json", "skyline": "csv"}


def kind_of(file: Path) -> str:
    """The kind of a file.

    Raises:
        FormatError: It cannot be read, or is no sound JSON or XML.
    """
    ending = file.suffix.lower()
    if ending == ".xml":
        return kind_of_xml(xml_of(file).tag)
    if ending == ".json":
        return kind_of_json(json_of(file))
    if ending == ".csv":
        return _kind_of_csv(_first_line(file))
    if ending in PHOTO_SUFFIXES:
        return "mask"
    if ending == SUFFIX:
        return "parquet"
    return "YOLO text; export COCO instead" if ending == ".txt" and _is_yolo(file) else ""


def kind_of_json(document: Any) -> str:  # noqa: ANN401
    """The kind of a JSON document."""
    if isinstance(document, list):
        tasks = [one for one in document if isinstance(one, dict)]
        studio = any("data" in one or "annotations" in one for one in tasks)
        return "Label Studio's own JSON; export it as COCO" if studio else "JSON with a list"
    if not isinstance(document, dict):
        return "JSON, but no object"
    said = document.get("format")
    if isinstance(said, str) and said in _SAYS:
        return _SAYS[said]
    if "shapes" in document:
        return "labelme"
    if "annotations" in document and "images" in document:
        return "coco"
    return _other_kind(document)


def kind_of_xml(tag: str) -> str:
    """The kind of an XML document, by its root."""
    if tag == "annotations":
        return "cvat"
    if tag == "annotation":
        return "Pascal VOC or the old LabelMe; export COCO instead"
    return f"XML of no known kind, with <{tag[:40]}>"


def shown(kind: str) -> str:
    """A kind in words."""
    return {
        "coco": "COCO",
        "labelme": "LabelMe",
        "json": "labels.json",
        "csv": "a skyline",
        "parquet": "a table of labels",
    }.get(kind, kind)


def _other_kind(document: dict[str, Any]) -> str:
    if isinstance(document.get("image"), dict) and "annotations" in document:
        return "masks of Segment Anything, which have no labels; export COCO instead"
    project = document.get("_via_img_metadata", document)
    files = project.values() if isinstance(project, dict) else []
    regions = [one["regions"] for one in files if isinstance(one, dict) and "regions" in one]
    if regions or "_via_settings" in document:
        shapes = sum(len(one) for one in regions if isinstance(one, list | dict))
        return (
            f"a VGG Image Annotator project with {shapes} regions on {len(regions)} photos; "
            f"export it as COCO"
        )
    if "objects" in document and "size" in document:
        return "Supervisely's own JSON; export it as COCO"
    keys = ", ".join(sorted(str(one)[:30] for one in document)[:6])
    return f"JSON of no known kind, with {keys or 'nothing in it'}"


def _kind_of_csv(first: str) -> str:
    if first in map(",".join, CSV_HEADERS):
        return "csv"
    if "region_shape_attributes" in first:
        return "CSV of the VGG Image Annotator; export COCO instead"
    return f"CSV of no known kind, with {first[:60] or 'nothing in it'}"


def _is_yolo(file: Path) -> bool:
    parts = _first_line(file).split()
    try:
        return len(parts) > 4 and all(0 <= float(one) <= 1 for one in parts[1:20])
    except ValueError:
        return False


def _first_line(file: Path) -> str:
    try:
        with file.open("rb") as opened:
            lines = opened.read(200).decode("utf-8-sig", "replace").splitlines()
            return lines[0] if lines else ""
    except OSError:
        return ""
