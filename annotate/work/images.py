"""Pictures for the page as PNG or JPEG: views of the photo, its line straightened, stages."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, U8
from skyline_viz.colours import coloured
from skyline_viz.detection import Detection
from skyline_viz.skyline import Skyline
from skyline_viz.stage import Quantity, of_term

TILE = 512
"""Side of a tile, in pixels."""

VIEW = 2048
"""Longest side of the view of a whole photo, in pixels."""

EXACT = 2_000_000
"""Photos of at most so many pixels are shown as they are."""

BAND = 40
"""Rows above and below the line in the straightened strip."""


def overlays(detection: Detection) -> tuple[str, ...]:
    """What can be laid over a photo: the maps among its stages, and the terms of its cost.

    A term with the name of a stage, such as the score, is shown by that.
    """
    stages = [name for name, one in detection.stages.items() if one.where != "columns"]
    terms = [term.name for term in detection.cost_model.nodal if term.weight]
    return tuple(dict.fromkeys([*stages, *terms]))


def view_size(height: int, width: int) -> tuple[int, int]:
    """Height and width of the view of a whole photo.

    >>> view_size(519, 1388), view_size(3024, 4032)
    ((519, 1388), (1536, 2048))
    """
    if height * width <= EXACT:
        return height, width
    scale = min(VIEW / max(height, width), 1.0)
    return max(round(height * scale), 1), max(round(width * scale), 1)


def view(photo: U8) -> tuple[bytes, str]:
    """The whole photo, and its content type: exact where it is small enough."""
    size = view_size(*photo.shape[:2])
    if size == photo.shape[:2]:
        return _png(photo), "image/png"
    return _jpeg(_reduced(photo, size), 90), "image/jpeg"


def thumbnail(photo: U8) -> bytes:
    """A JPEG of at most 240 by 160 pixels."""
    height, width = photo.shape[:2]
    scale = min(240 / width, 160 / height, 1.0)
    size = max(round(height * scale), 1), max(round(width * scale), 1)
    return _jpeg(_reduced(photo, size), 80)


def tile(photo: U8, across: int, down: int) -> bytes | None:
    """Exact pixels of a tile, as PNG; None where there is no such tile."""
    part = photo[down * TILE : (down + 1) * TILE, across * TILE : (across + 1) * TILE]
    return _png(part) if part.size else None


def strip(photo: U8, skyline: Skyline, width: int) -> bytes:
    """The band around a line, straightened, as PNG: the line lies on top of row `BAND`."""
    height = len(photo)
    rows = np.floor(skyline.rows + 0.5).astype(np.intp)
    around = np.arange(-BAND, BAND + 1)[:, None] + rows[None, :]
    band = photo[around.clip(0, height - 1), np.arange(skyline.width)[None, :]]
    band[(around < 0) | (around >= height)] = 0
    return _png(_reduced(band, (2 * BAND + 1, width)))


def stage(detection: Detection, name: str) -> bytes:
    """A stage or a term of the cost as RGBA, as large as the view of the photo, as PNG.

    Transparent where it has no value; all of it where the detection has no such stage.
    """
    shape = detection.edges.shape
    size = view_size(*shape)
    layer = _layer(detection, name)
    if size != shape:
        layer = cv2.resize(_spread(layer, shape, size), size[::-1], interpolation=cv2.INTER_AREA)
    _, data = cv2.imencode(".png", cv2.cvtColor(layer, cv2.COLOR_RGBA2BGRA), _FAST)
    return data.tobytes()


def _layer(detection: Detection, name: str) -> U8:
    shape = detection.edges.shape
    found = detection.stages.get(name)
    if found is None:
        terms = [term for term in detection.cost_model.nodal if term.name == name]
        return _coloured(of_term(name), terms[0].map()) if terms else _clear(shape)
    if found.where == "mask":
        layer = np.full((*shape, 4), 255, np.uint8)
        layer[..., 3] = np.where(found.values, 255, 0)
        return layer
    whole = found.map()
    if whole is not None:
        return _coloured(found.quantity, whole)
    layer = _clear(shape)
    if found.where == "edges":
        table = np.array([colour for _, colour in found.legend], np.uint8)
        rows, columns = detection.edge_rows, detection.edge_columns
        colours = table[found.values] if found.legend else _colours(found.quantity, found.values)
        layer[rows, columns, :3] = colours
        layer[rows, columns, 3] = 255
    return layer


_FAST = [cv2.IMWRITE_PNG_COMPRESSION, 1]


def _clear(shape: tuple[int, ...]) -> U8:
    return np.zeros((*shape, 4), np.uint8)


def _coloured(quantity: Quantity, values: F32) -> U8:
    """A map ``(H, W)`` as RGBA; where there is no value, it has the last colour."""
    missing = np.isnan(values)
    known = np.where(missing, values[~missing].max(initial=0.0), values)
    layer = np.full((*values.shape, 4), 255, np.uint8)
    layer[..., :3] = _colours(quantity, known)
    return layer


def _colours(quantity: Quantity, values: npt.NDArray[Any]) -> U8:
    """Colours of values, from the quantity's lowest to its highest, or but for a hundredth."""
    if values.size == 0:
        return np.zeros((0, 3), np.uint8)
    low, high = quantity.low, quantity.high
    some = values[::4, ::4] if values.ndim == 2 else values
    if low is None:
        low = float(np.percentile(some, 0.5))
    if high is None:
        high = float(np.percentile(some, 99.5))
    return coloured(quantity.colour_map, (values - low) / max(high - low, 1e-6))


def _spread(layer: U8, shape: tuple[int, ...], size: tuple[int, int]) -> U8:
    """Thicken single pixels before a reduction, which would make them fade."""
    if layer[..., 3].all():
        return layer
    around = round(shape[1] / size[1])
    return cv2.dilate(layer, np.ones((around, around), np.uint8)) if around > 1 else layer


def _reduced(photo: U8, size: tuple[int, int]) -> U8:
    if photo.shape[:2] == size:
        return photo
    reduced: U8 = cv2.resize(photo, size[::-1], interpolation=cv2.INTER_AREA)
    return reduced


def _png(photo: U8) -> bytes:
    _, data = cv2.imencode(".png", cv2.cvtColor(photo, cv2.COLOR_RGB2BGR), _FAST)
    return data.tobytes()


def _jpeg(photo: U8, quality: int) -> bytes:
    how = [cv2.IMWRITE_JPEG_QUALITY, quality]
    _, data = cv2.imencode(".jpg", cv2.cvtColor(photo, cv2.COLOR_RGB2BGR), how)
    return data.tobytes()
