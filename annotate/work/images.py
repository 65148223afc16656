"""Pictures for the page as PNG or JPEG: views of the photo, its line straightened, stages."""

from __future__ import annotations

import cv2
import numpy as np
import numpy.typing as npt
from matplotlib import colormaps

from skyline_viz.arrays import F32, U8, Bool
from skyline_viz.detection import Detection
from skyline_viz.detector import FilterDetection
from skyline_viz.skyline import Skyline
from skyline_viz.tensor import tensor_map

TILE = 512
"""Side of a tile, in pixels."""

VIEW = 2048
"""Longest side of the view of a whole photo, in pixels."""

EXACT = 2_000_000
"""Photos of at most so many pixels are shown as they are."""

BAND = 40
"""Rows above and below the line in the straightened strip."""

STAGES = ("edges", "strength", "coherence", "orientation", "bin", "score", "cost")
"""Stages that can be laid over the photo."""

_MAPS = {
    "strength": "inferno",
    "coherence": "viridis",
    "orientation": "twilight_shifted",
    "bin": "twilight_shifted",
    "score": "viridis",
    "cost": "magma_r",
}


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
    """A stage as RGBA, as large as the view of the photo; transparent where it has no value."""
    shape = detection.edges.shape
    size = view_size(*shape)
    if name == "edges":
        layer = np.full((*shape, 4), 255, np.uint8)
        layer[..., 3] = detection.edges * np.uint8(255)
    elif name == "cost":
        cost = detection.shown_cost
        ruled_out = np.isnan(cost)
        dearest = cost[~ruled_out].max(initial=0.0)
        layer = _coloured(_scaled(np.where(ruled_out, dearest, cost)), name)
    elif name in ("strength", "coherence", "orientation"):
        values: F32 = getattr(tensor_map(detection.photo), name)
        layer = _coloured(_scaled(values, 180.0 if name == "orientation" else None), name)
    else:
        at_edges, shown = detection.scores, detection.edges
        if name == "bin" and isinstance(detection, FilterDetection):
            count = detection.bank.bins.orientations
            at_edges = (detection.bins % count / count).astype(np.float32)
        elif name == "bin":
            shown = np.zeros(shape, np.bool_)  # other methods have none
        values = np.zeros(shape, np.float32)
        values[detection.edge_rows, detection.edge_columns] = at_edges
        layer = _coloured(values, name, shown)
    if size != shape:
        layer = cv2.resize(_spread(layer, shape, size), size[::-1], interpolation=cv2.INTER_AREA)
    _, data = cv2.imencode(".png", cv2.cvtColor(layer, cv2.COLOR_RGBA2BGRA), _FAST)
    return data.tobytes()


_FAST = [cv2.IMWRITE_PNG_COMPRESSION, 1]


def _coloured(values: F32, name: str, where: Bool | None = None) -> U8:
    table = (colormaps[_MAPS[name]](np.arange(256)) * 255).astype(np.uint8)
    layer: U8 = table[(values.clip(0, 1) * 255).astype(np.uint8)]
    if where is not None:
        layer[..., 3] = where * np.uint8(255)
    return layer


def _scaled(values: npt.NDArray[np.float32], top: float | None = None) -> F32:
    """Values from 0 to 1: up to `top`, or between the extremes but for a hundredth."""
    if top is not None:
        return values / np.float32(top)
    low, high = np.percentile(values[::4, ::4], [0.5, 99.5])
    scaled: F32 = ((values - low) / max(high - low, 1e-6)).astype(np.float32)
    return scaled


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
