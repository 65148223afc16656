"""Maps of values for the viewer: every pixel in its colour, every colour with its value and unit.

A map is a `SegmentationImage`: each class stands for a value, an `AnnotationContext` gives it its
colour and its words. So hovering a pixel says "strength 41.2 grey levels/px" instead of a shade,
pixels without a value are transparent, and a sparse map costs a fraction of a dense float image.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt
import pyarrow as pa
import rerun as rr

from skyline_viz.arrays import U8, Int
from skyline_viz.colours import coloured
from skyline_viz.stage import Quantity
from skyline_viz.viewer.maps.map_aids import log_broad, log_scale

COARSE, FINE = 255, 4095
"""Values that a map tells apart: one byte a pixel in lean recordings, two in full ones."""

BANDS = 21
"""Values of a smooth map in lean recordings: bands of equal pixels take a third of the bytes."""

_BROAD = 12  # of what is broadened, of which nobody reads values


@dataclass(frozen=True, eq=False)
class ValueMap:
    """A map, ready to be logged."""

    classes: npt.NDArray[np.unsignedinteger[Any]]
    """``(H, W)`` 0 without a value, else 1 + the level."""

    levels: int
    """Number of levels."""

    quantity: Quantity
    """What it shows."""

    low: float
    """Value of the first level."""

    high: float
    """Value of the last one."""

    def values(self) -> npt.NDArray[np.float64]:
        """Value of each pixel to within half a step, ``(H, W)``; NaN without one."""
        step = (self.high - self.low) / (self.levels - 1)
        return np.where(self.classes > 0, self.low + (self.classes - 1.0) * step, np.nan)

    def log(self, recording: rr.RecordingStream, entity: str, *, aids: bool = True) -> None:
        """Log the map and what its classes mean.

        Args:
            recording: Where to.
            entity: Entity path of the map.
            aids: Whether to log what helps to read it, too, see `map_aids`.
        """
        if aids:
            self._log_aids(recording, entity)  # first: the map is compressed while others are made
        means = legend(self.quantity, self.low, self.high, self.levels)
        recording.log(entity, means, image_of(self.classes))

    def _log_aids(self, recording: rr.RecordingStream, entity: str) -> None:
        few = shades(self.quantity, _BROAD)
        if not self.classes.all():  # else nothing is sparse
            log_broad(recording, entity, self._bands(), few, lowest=self.quantity.low_is_bright)
        colours, ends = shades(self.quantity, COARSE), (self.low, self.high)
        log_scale(recording, entity, self.classes.shape, colours, ends)

    def _bands(self) -> U8:
        """The classes in `_BROAD` levels."""
        levels = np.arange(self.levels) * (_BROAD - 1) / (self.levels - 1)
        table: U8 = np.concatenate([[0], np.rint(1 + levels)]).astype(np.uint8)
        if self.classes.dtype == np.uint8:  # a tenth of the time
            return np.asarray(cv2.LUT(self.classes, np.resize(table, 256)), np.uint8)
        bands: U8 = table[self.classes]
        return bands


def image_of(classes: npt.NDArray[np.unsignedinteger[Any]]) -> rr.SegmentationImage:
    """Classes ``(H, W)`` as Rerun takes them, without the two copies that it makes of an array.

    They must not change before the recording has been flushed.
    """
    flat = np.ascontiguousarray(classes).reshape(-1).view(np.uint8)
    inner = pa.Array.from_buffers(pa.uint8(), flat.size, [None, pa.py_buffer(flat)])
    kind = pa.list_(pa.field("item", pa.uint8(), nullable=False))
    return rr.SegmentationImage.from_fields(
        buffer=pa.ListArray.from_arrays(pa.array([0, flat.size], pa.int32()), inner, type=kind),
        format=rr.components.ImageFormat(
            width=classes.shape[1],
            height=classes.shape[0],
            channel_datatype=rr.ChannelDatatype.from_np_dtype(classes.dtype),
        ),
        opacity=1.0,
    )


def sparse_map(
    quantity: Quantity,
    shape: tuple[int, int],
    rows: Int,
    columns: Int,
    values: npt.NDArray[np.floating],
    levels: int,
) -> ValueMap:
    """Map of values at some pixels.

    Args:
        quantity: What they are.
        shape: Height and width.
        rows: ``(n,)`` row of each value.
        columns: ``(n,)`` its column.
        values: ``(n,)``.
        levels: Values to tell apart, `COARSE` or `FINE`.
    """
    low, high = value_range(quantity, values)
    classes = np.zeros(shape, _dtype(levels))
    classes[rows, columns] = classes_of(values, low, high, levels)
    return ValueMap(classes, levels, quantity, low, high)


def dense_map(quantity: Quantity, values: npt.NDArray[np.floating], levels: int) -> ValueMap:
    """Map ``(H, W)`` of values; NaN is no value, and infinite counts as the end of the range."""
    low, high = value_range(quantity, values[np.isfinite(values)])
    return ValueMap(classes_of(values, low, high, levels), levels, quantity, low, high)


def _dtype(levels: int) -> type[np.uint8 | np.uint16]:
    return np.uint8 if levels <= COARSE else np.uint16


def value_range(quantity: Quantity, *values: npt.NDArray[np.floating[Any]]) -> tuple[float, float]:
    """Range of a map, rounded outwards to halves of a power of ten: photos share their legends.

    Args:
        quantity: What it shows, which may say where the range begins and ends.
        values: All finite values, in any number of arrays.
    """
    low, high = quantity.low, quantity.high
    if low is None:
        low = float(min(one.min(initial=0.0) for one in values))
    if high is None:
        high = float(max(one.max(initial=low) for one in values))
    span = high - low
    if span <= 0:
        return low, low + 1.0
    step = 10.0 ** math.floor(math.log10(span)) / 2
    first = low if quantity.low is not None else math.floor(low / step) * step
    last = high if quantity.high is not None else math.ceil(high / step) * step
    return first, last


def classes_of(
    values: npt.NDArray[np.floating[Any]], low: float, high: float, levels: int
) -> npt.NDArray[np.unsignedinteger[Any]]:
    """Class of each value: 1 + its level; 0 where there is none, which is NaN."""
    scaled = (values - low) * ((levels - 1) / (high - low)) + 1.5
    np.clip(scaled, 1.0, levels, out=scaled)
    np.copyto(scaled, 0.0, where=np.isnan(scaled))
    return scaled.astype(_dtype(levels))


@lru_cache(maxsize=64)
def legend(quantity: Quantity, low: float, high: float, levels: int) -> rr.AnnotationContext:
    """Colour and words of each level. Photos share them, so they are kept.

    Args:
        quantity: What the values are.
        low: Value of the first level.
        high: Value of the last one.
        levels: Number of levels.
    """
    step = (high - low) / (levels - 1)
    words = ["", *(quantity.label(low + level * step, step) for level in range(levels))]
    opaque = np.pad(shades(quantity, levels), ((0, 0), (0, 1)), constant_values=255)
    return _context(words, np.pad(opaque, ((1, 0), (0, 0))))


def _context(words: Sequence[str], colours: U8) -> rr.AnnotationContext:
    """Words and colours ``(n, 4)`` of classes, as Rerun takes them.

    It would make an object of each colour, which takes ten times as long.
    """
    like = rr.AnnotationContext([rr.AnnotationInfo(0)]).context
    assert like is not None
    kind = like.as_arrow_array().type
    one = kind.value_type
    described = one.field("class_description").type
    ids = pa.array(np.arange(len(words), dtype=np.uint16))
    numbers = np.ascontiguousarray(colours, np.uint8).view(">u4").ravel().astype(np.uint32)
    info = pa.StructArray.from_arrays(
        [ids, pa.array(words), pa.array(numbers)], fields=list(described.field("info").type)
    )
    none = [pa.array([[]] * len(words), field.type) for field in list(described)[1:]]
    classes = pa.StructArray.from_arrays([info, *none], fields=list(described))
    map_of = pa.StructArray.from_arrays([ids, classes], fields=list(one))
    listed = pa.ListArray.from_arrays(pa.array([0, len(words)], pa.int32()), map_of, type=kind)
    return rr.AnnotationContext.from_fields(context=listed)


def shades(quantity: Quantity, levels: int) -> U8:
    """Colours ``(levels, 3)`` of so many values, evenly from the first to the last."""
    first, last = quantity.span
    places = first + (last - first) * np.linspace(0, 1, levels) ** quantity.contrast
    return coloured(quantity.colour_map, places)
