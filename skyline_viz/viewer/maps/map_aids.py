"""What helps to read a map: lines that last when it is shrunk, a scale of its colours, a fade.

All of it lies below a map's own entity, at `DRAWN`, and views are told that it cannot be hovered:
what a pixel says is always the value of that very pixel.
"""

from __future__ import annotations

import io
import zlib
from functools import lru_cache
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt
import rerun as rr
from PIL import Image

from skyline_viz.arrays import F64, U8, Bool

DRAWN = "drawn"
"""Parent of the aids below the entity of a map."""

SCALE = f"{DRAWN}/scale"
"""The scale of colours below the entity of a map."""

FADED_UNDER = 40.0
"""Gradient strength under which the colour of an orientation fades."""

_BELOW, _ABOVE = -5.0, 5.0  # in the order of drawing: a photo lies at -10, maps at 0
_DIM = 0.6  # opacity of what is broadened, lest it be taken for the map
_CELL = (427, 240)  # pixels of a view in a grid of three by three, in a window of 1280x800
_SEGMENTS = 32  # of a scale of colours
_PALE = (0xE0, 0xE0, 0xE0)
_SHADES = 16
_BACKGROUND = (12, 12, 12)

SCALE_SHARE = 0.12
"""How much wider a map is with its scale, as a share of its longer side."""

Classes = npt.NDArray[np.unsignedinteger[Any]]


def reach_of(shape: tuple[int, ...]) -> int:
    """How far a pixel spreads, so that a small view, which leaves pixels out, still meets it.

    >>> reach_of((519, 1388)), reach_of((1024, 1024)), reach_of((60, 80))
    (2, 2, 0)
    """
    shrunk = max(shape[1] / _CELL[0], shape[0] / _CELL[1])
    return max(int(np.ceil((shrunk - 1) / 2)), 0)


def broadened(classes: Classes, reach: int, lowest: bool) -> Classes:
    """Classes ``(H, W)`` of which each spreads over its neighbours; 0 is none.

    Args:
        classes: The classes.
        reach: How many pixels far.
        lowest: Whether of several the lowest one wins; else the highest.
    """
    square = np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)
    if not lowest:
        return _spread(classes, square)
    spread = _spread(np.negative(classes), square)  # 1 becomes the highest there is, and 0 stays
    return np.negative(spread)


def _spread(classes: Classes, square: U8) -> Classes:
    spread: Classes = np.asarray(cv2.dilate(classes, square), classes.dtype)
    return spread


def log_broad(
    recording: rr.RecordingStream,
    entity: str,
    classes: U8,
    colours: U8,
    *,
    lowest: bool = False,
) -> None:
    """Log a sparse map broadened, below the map itself; nothing of one that is not sparse.

    Args:
        recording: Where to.
        entity: Entity path of the map.
        classes: ``(H, W)`` its classes; 0 is no value.
        colours: ``(k, 3)`` colour of each class from 1 on.
        lowest: Whether low classes matter most.
    """
    place, reach = f"{entity}/{DRAWN}/broad", reach_of(classes.shape)
    known = np.count_nonzero(classes)
    if known == classes.size:
        return
    if not reach or known > classes.size / 2:
        recording.log(place, rr.Clear(recursive=False))  # an earlier photo's
        return
    picture = Image.fromarray(broadened(classes, reach, lowest))
    picture.putpalette(bytes(3) + colours.tobytes())
    recording.log(place, _png(picture, _DIM, _BELOW, transparency=0))


def _png(picture: Image.Image, opacity: float, order: float, **how: int) -> rr.EncodedImage:
    """A picture that takes a third of what the same classes would take.

    All is runs of pixels. To look for other repetitions takes four times as long, for a fifth less.
    """
    data = io.BytesIO()
    picture.save(data, "PNG", compress_type=zlib.Z_RLE, **how)
    return rr.EncodedImage(
        contents=data.getvalue(), media_type="image/png", opacity=opacity, draw_order=order
    )


def log_broad_edges(recording: rr.RecordingStream, entity: str, edges: Bool) -> None:
    """Log an edge map ``(H, W)`` broadened, above the map itself."""
    reach = reach_of(edges.shape)
    square = np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)
    wide = cv2.dilate(edges.astype(np.uint8), square).astype(np.bool_)
    picture = _png(Image.fromarray(wide), _DIM / 2, _ABOVE)
    recording.log(f"{entity}/{DRAWN}/broad", picture)


def log_scale(
    recording: rr.RecordingStream,
    entity: str,
    shape: tuple[int, ...],
    colours: U8,
    ends: tuple[float, float],
) -> None:
    """Log a scale of colours at the right of a map, with the values at its ends.

    Args:
        recording: Where to.
        entity: Entity path of the map.
        shape: Its height and width.
        colours: ``(k, 3)`` from the first to the last value, evenly.
        ends: The first and the last value.
    """
    bar, numbers = _scale(shape, colours.tobytes(), ends)
    recording.log(f"{entity}/{SCALE}", bar, numbers)


@lru_cache(maxsize=64)
def _scale(
    shape: tuple[int, ...], shades: bytes, ends: tuple[float, float]
) -> tuple[rr.LineStrips2D, rr.Points2D]:
    """Bar and numbers of `log_scale`; maps of a data set share many."""
    colours = np.frombuffer(shades, np.uint8).reshape(-1, 3)
    height, width = shape[:2]
    size = max(height, width)
    across = width + SCALE_SHARE / 2 * size
    rows = np.linspace(0.84 * height, 0.15 * height, _SEGMENTS + 1, dtype=np.float32)
    sides = np.full(_SEGMENTS, across, np.float32)
    lower, upper = np.stack([sides, rows[:-1]], axis=1), np.stack([sides, rows[1:]], axis=1)
    places = np.linspace(0, len(colours) - 1, _SEGMENTS).astype(np.intp)
    bar = rr.LineStrips2D(
        np.stack([lower, upper], axis=1), colors=colours[places], radii=[0.012 * size]
    )
    low, high = ends
    numbers = rr.Points2D(
        [(across, 0.87 * height), (across, 0.01 * height)],  # words lie below their points
        labels=[f"{low:.4g}", f"{high:.4g}"],
        colors=[_PALE],
        radii=[-0.5],
        show_labels=True,
    )
    return bar, numbers


def log_fade(
    recording: rr.RecordingStream,
    entity: str,
    classes: Classes,
    strengths: F64,
) -> None:
    """Log a veil over a map of orientations: dense where the gradient is weak.

    Args:
        recording: Where to.
        entity: Entity path of the map of orientations.
        classes: ``(H, W)`` the classes of the map of strengths.
        strengths: Gradient strength of each class; class 0 is a pixel without one.
    """
    shades = np.clip(strengths / FADED_UNDER * (_SHADES - 1), 0, _SHADES - 1)
    veil = (1 + shades).astype(np.uint8)[classes]
    picture = rr.SegmentationImage(veil, opacity=1.0, draw_order=_ABOVE)
    recording.log(f"{entity}/{DRAWN}/fade", _veil(), picture)


@lru_cache(maxsize=1)
def _veil() -> rr.AnnotationContext:
    shown = np.linspace(0, 1, _SHADES)
    return rr.AnnotationContext(
        [
            rr.AnnotationInfo(1 + shade, "", (*_BACKGROUND, round(255 * (1 - share))))
            for shade, share in enumerate(shown.tolist())
        ]
    )
