"""LabelMe, and X-AnyLabeling: a JSON file a photo."""

from __future__ import annotations

import base64
import binascii
import io
import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from annotate.formats.common import Entry, runs_of_points
from annotate.formats.drawings import Drawing, Shape
from annotate.formats.importing import Found
from skyline_viz.datasets.coco import list_of, size_of_drawing, text_of
from skyline_viz.datasets.outlines import FormatError, Points, Runs, check_pixels, points_of
from skyline_viz.files import write_text

_LINE = "skyline"
_KINDS = {"linestrip": "line", "line": "line", "polygon": "polygon", "rectangle": "box"}


def write_labelme(entries: list[Entry], folder: Path) -> None:
    """Write a JSON file for each photo, with a line strip for each run of visible columns."""
    for entry in entries:
        label = entry.label
        shapes: list[dict[str, Any]] = [
            {
                "label": _LINE,
                "points": run.tolist() if len(run) > 1 else [*run.tolist(), *run.tolist()],
                "group_id": None,
                "description": str(label.comment or ""),
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


def drawing_of_labelme(document: dict[str, Any], file: Path, found: Found) -> Drawing:
    """What a LabelMe document says of its photo; shapes that are not sound are problems.

    Raises:
        FormatError: The document is not sound; without its name and a full stop.
    """
    path, flags = document.get("imagePath"), document.get("flags")
    shapes = []
    for place, told in enumerate(list_of(document.get("shapes"), "what it calls shapes"), 1):
        try:
            shapes.append(_shape(told))
        except FormatError as error:
            found.problem(f"{file}: shape {place} is left out: {error}.")
    tags = flags if isinstance(flags, dict) else {}
    return Drawing(
        tuple(text_of(one, "its imagePath") for one in (path,) if one),
        size_of_drawing(document.get("imageHeight"), document.get("imageWidth")),
        tuple(shapes),
        tuple(tag for tag, on in tags.items() if on is True),
    )


def _shape(told: Any) -> Shape:  # noqa: ANN401
    if not isinstance(told, dict):
        raise FormatError("it is no object")
    label = text_of(told.get("label"), "its label")
    kind = text_of(told.get("shape_type", "polygon"), "its shape_type")
    if kind not in (*_KINDS, "mask"):
        return Shape(label, kind[:40])
    points = points_of(told.get("points"))
    if kind == "mask":
        return Shape(label, "mask", runs=_mask(told.get("mask"), points))
    least = 3 if kind == "polygon" else 2
    if len(points) < least:
        raise FormatError(f"a {kind} has {len(points)} points")
    if _KINDS[kind] != "box":
        check_pixels([points])
    return Shape(label, _KINDS[kind], (points,))


def _mask(told: Any, box: Points) -> Runs:  # noqa: ANN401
    """The pixels of a mask, a PNG in base 64 that lies with its first pixel at a point."""
    try:
        packed = base64.b64decode(text_of(told, "its mask"), validate=True)
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(io.BytesIO(packed), formats=("PNG",)) as picture:
                inside = np.asarray(picture.convert("L")) > 0
    except FormatError:
        raise
    except (binascii.Error, Image.DecompressionBombError, Image.DecompressionBombWarning):
        raise FormatError("its mask is no picture") from None
    except Exception:  # decoders raise OSError, SyntaxError, ValueError, struct.error, ...
        raise FormatError("its mask is no picture") from None
    changes = np.flatnonzero(np.diff(inside.ravel())) + 1
    bounds = np.concatenate([[0], changes, [inside.size]])
    lengths = np.diff(bounds).tolist()
    if inside.ravel()[0]:
        lengths = [0, *lengths]
    left, top = (round(one) for one in box[0].tolist())
    height, width = inside.shape
    return Runs(tuple(lengths), height, width, left, top, by_column=False)
