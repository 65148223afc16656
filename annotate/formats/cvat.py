"""CVAT for images 1.1, and the tracks of CVAT for video: one XML file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree as ET  # written only; `documents.xml_of` reads

from annotate.formats.common import Entry, runs_of_points
from annotate.formats.drawings import Drawing, Shape
from annotate.formats.importing import Found
from skyline_viz.datasets.coco import side_of, size_of_drawing
from skyline_viz.datasets.outlines import FormatError, Points, Runs, check_pixels, points_of
from skyline_viz.files import write_text

_LINE = "skyline"
_KINDS = {"polyline": "line", "polygon": "polygon", "mask": "mask"}
_OTHERS = ("box", "points", "ellipse", "cuboid", "skeleton")


def write_cvat(entries: list[Entry], folder: Path) -> None:
    """Write CVAT for images 1.1, with a polyline for each run of visible columns."""
    root = ET.Element("annotations")
    ET.SubElement(root, "version").text = "1.1"
    task = ET.SubElement(ET.SubElement(root, "meta"), "task")
    ET.SubElement(task, "name").text = "skylines"
    ET.SubElement(task, "size").text = str(len(entries))
    ET.SubElement(task, "mode").text = "annotation"
    labels = ET.SubElement(task, "labels")
    tags = sorted({_xml_text(tag) for entry in entries for tag in entry.label.tags} - {_LINE})
    for name, kind in ((_LINE, "polyline"), *((tag, "tag") for tag in tags)):
        label = ET.SubElement(labels, "label")
        ET.SubElement(label, "name").text = name
        ET.SubElement(label, "type").text = kind
        ET.SubElement(label, "attributes")
    for number, entry in enumerate(entries):
        _write_image(root, number, entry)
    ET.indent(root)
    text = ET.tostring(root, encoding="unicode")
    write_text(folder / "annotations.xml", f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n')


def drawings_of_cvat(root: ET.Element, file: Path, found: Found) -> Iterator[Drawing]:
    """What a CVAT document says of each photo."""
    for image in root.iter("image"):
        shapes = []
        for element in image:
            if element.tag in (*_KINDS, *_OTHERS):
                try:
                    shapes.append(_shape(element, element.get("label", "")))
                except FormatError as error:
                    name = image.get("name", "")
                    found.problem(f"{file}: a {element.tag} of {name} is left out: {error}.")
        tags = tuple(one.get("label", "") for one in image.iter("tag"))
        try:
            size = size_of_drawing(image.get("height"), image.get("width"))
            yield Drawing((image.get("name", ""),), size, tuple(shapes), tags)
        except FormatError as error:
            found.problem(f"{file}: the image {image.get('name', '')} is left out: {error}.")
    yield from _frames(root, file, found)


def _frames(root: ET.Element, file: Path, found: Found) -> Iterator[Drawing]:
    """Tracks, which know the frames of a video by number: CVAT saves them as frame_000012."""
    frames: dict[int, list[Shape]] = {}
    for track in root.iter("track"):
        for element in track:
            if element.tag not in (*_KINDS, *_OTHERS) or element.get("outside") == "1":
                continue
            try:
                frame = _whole(element.get("frame"), "its frame")
                shape = _shape(element, track.get("label", ""))
                frames.setdefault(frame, []).append(shape)
            except FormatError as error:
                found.problem(f"{file}: a {element.tag} of a track is left out: {error}.")
    height, width = (root.findtext(f".//original_size/{side}") for side in ("height", "width"))
    try:
        size = size_of_drawing(height, width)
    except FormatError:
        size = None
    for frame, shapes in frames.items():
        names = [f"frame_{frame:06}{ending}" for ending in (".png", ".jpg", ".jpeg")]
        yield Drawing(tuple(names), size, tuple(shapes))


def _shape(element: ET.Element, label: str) -> Shape:
    kind = _KINDS.get(element.tag, element.tag)
    if kind == "mask":
        return Shape(label, kind, runs=_runs(element))
    if element.tag not in _KINDS:
        return Shape(label, kind)
    points = _points(element.get("points", ""))
    if len(points) < (3 if kind == "polygon" else 1):
        raise FormatError(f"it has {len(points)} points")
    check_pixels([points])
    return Shape(label, kind, (points,))


def _points(text: str) -> Points:
    try:
        pairs = [[float(one) for one in pair.split(",")] for pair in text.split(";") if pair]
    except ValueError:
        raise FormatError("points are no pairs of numbers") from None
    return points_of(pairs)


def _runs(element: ET.Element) -> Runs:
    """The pixels of a mask, along the rows of its box."""
    box = {name: _whole(element.get(name), f"its {name}") for name in ("left", "top")}
    sides = [side_of(element.get(name)) for name in ("height", "width")]
    try:
        lengths = tuple(int(one) for one in element.get("rle", "").split(","))
    except ValueError:
        raise FormatError("its run lengths are no whole numbers") from None
    missing = sides[0] * sides[1] - sum(lengths)
    if len(lengths) % 2 == 0 and missing > 0:  # a last run outside may be left out
        lengths = (*lengths, missing)
    runs = Runs(lengths, sides[0], sides[1], **box, by_column=False)
    runs.check()
    return runs


def _whole(told: str | None, what: str) -> int:
    try:
        return int(float(told or ""))
    except (ValueError, OverflowError):
        raise FormatError(f"{what} is no number") from None


def _write_image(root: ET.Element, number: int, entry: Entry) -> None:
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


def _xml_text(text: str) -> str:
    """Text without the characters that XML cannot hold."""
    allowed = "".join(one if one >= " " or one in "\t\n" else "?" for one in text)
    return allowed.encode("utf-8", "replace").decode()
