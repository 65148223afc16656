"""Stages of a detection as pictures to be laid over the photo, as large as its view.

Where the view is smaller than the photo, only what it shows is made: of a stage that is known at
edge pixels each pixel of the view shows one of those that fall into it, none is lost between them;
the tensor is computed at the pixels in the middle of those of the view; other maps are averaged.
"""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from annotate.work.images import jpeg, png, view_size
from annotate.work.pictures import Picture
from skyline_viz.arrays import F32, U8, Int
from skyline_viz.colours import coloured
from skyline_viz.detection import Detection
from skyline_viz.stage import Quantity, Stage, of_term

_QUALITY = 85  # of an overlay as JPEG: colours stand for values, and smooth maps must not show it
_ENOUGH = 200_000  # values that tell where the colours begin and end

Size = tuple[int, int]


def overlays(detection: Detection) -> dict[str, str]:
    """What can be laid over a photo, and how it reads: maps among its stages, terms of its cost.

    A term with the name of a stage, such as the score, is shown by that.
    """
    stages = {
        name: one.quantity.title for name, one in detection.stages.items() if one.where != "columns"
    }
    terms = [term.name for term in detection.cost_model.nodal if term.weight]
    return stages | {name: of_term(name).title for name in terms if name not in stages}


def overlay(detection: Detection, name: str) -> Picture:
    """A stage or a term of the cost, as large as the view of the photo.

    As PNG, transparent where it has no value, and all of it where the detection has no such stage;
    as JPEG where the view is smaller than the photo, and every pixel has a value.
    """
    height, width = detection.edges.shape
    shape = height, width
    size = view_size(*shape)
    found = detection.stages.get(name)
    if found is not None:
        layer = _layer(detection, found, size)
    elif terms := [term for term in detection.cost_model.nodal if term.name == name]:
        layer = _map(of_term(name), _averaged(terms[0].map(), size))
    else:
        layer = np.zeros((*size, 4), np.uint8)
    if layer.shape[2] == 4:
        return png(layer)
    if size == shape:
        return png(np.asarray(cv2.cvtColor(layer, cv2.COLOR_RGB2RGBA), np.uint8))
    return jpeg(layer, _QUALITY, exact_colours=True)


def _layer(detection: Detection, stage: Stage, size: Size) -> U8:
    """RGBA of a stage that has no value somewhere, else RGB."""
    height, width = detection.edges.shape
    if stage.where == "mask":
        rows, columns = np.divmod(np.flatnonzero(stage.values), width)
        return _points((height, width), size, rows, columns, np.full((1, 3), 255, np.uint8))
    if size != (height, width) and stage.at is not None:
        rows, columns = (_middles(*one) for one in zip((height, width), size, strict=True))
        every = np.repeat(rows, size[1]), np.tile(columns, size[0])
        return _map(stage.quantity, stage.at(*every).reshape(size))
    whole = stage.map()
    if whole is not None:
        return _map(stage.quantity, _averaged(whole, size))
    if stage.where != "edges":
        return np.zeros((*size, 4), np.uint8)
    if stage.legend:
        colours = np.array([colour for _, colour in stage.legend], np.uint8)[stage.values]
    else:
        colours = _colours(stage.quantity, stage.values)
    return _points((height, width), size, detection.edge_rows, detection.edge_columns, colours)


def _points(
    shape: Size,
    size: Size,
    rows: npt.NDArray[np.integer[Any]],
    columns: npt.NDArray[np.integer[Any]],
    colours: U8,
) -> U8:
    """Pixels of a photo with their colours, ``(k, 3)`` or one for all, in its view."""
    layer = np.zeros((*size, 4), np.uint8)
    if size != shape:
        rows, columns = rows * size[0] // shape[0], columns * size[1] // shape[1]
    places = rows * size[1] + columns
    packed = np.full((len(colours), 4), 255, np.uint8)
    packed[:, :3] = colours
    layer.view(np.uint32).ravel()[places] = packed.view(np.uint32).ravel()
    return layer


def _middles(length: int, count: int) -> Int:
    """The pixels of a row or column of the photo in the middle of those of its view."""
    middles: Int = ((2 * np.arange(count) + 1) * length // (2 * count)).astype(np.int32)
    return middles


def _averaged(values: npt.NDArray[Any], size: Size) -> F32:
    if values.shape == size:
        return np.asarray(values, np.float32)
    averaged = cv2.resize(np.asarray(values, np.float32), size[::-1], interpolation=cv2.INTER_AREA)
    return np.asarray(averaged, np.float32)


def _map(quantity: Quantity, values: F32) -> U8:
    """A map ``(H, W)`` as RGB; where there is no value, it has the last colour."""
    missing = np.isnan(values)
    if missing.any():
        values = np.where(missing, values[~missing].max(initial=0.0), values)
    return _colours(quantity, values)


def _colours(quantity: Quantity, values: npt.NDArray[Any]) -> U8:
    """Colours of values, from the quantity's lowest to its highest, or but for a hundredth."""
    if values.size == 0:
        return np.zeros((0, 3), np.uint8)
    low, high = quantity.low, quantity.high
    some = values.ravel()[:: max(values.size // _ENOUGH, 1)]
    if low is None:
        low = float(np.percentile(some, 0.5))
    if high is None:
        high = float(np.percentile(some, 99.5))
    return coloured(quantity.colour_map, (values - low) / max(high - low, 1e-6))
