"""Pictures inside a report: as large as they are looked at, and within a number of bytes.

A stage that is known at edge pixels alone keeps its lines when it is made smaller: each pixel of
the picture shows the loudest one of those that fall into it, which is the strongest edge, the
highest score, or the cheapest pixel. Edges themselves are as bright as there are many.
"""

from __future__ import annotations

import base64
import io
import math
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt
from PIL import Image

from skyline_viz.arrays import F32, U8, Int
from skyline_viz.colours import coloured
from skyline_viz.detection import Detection
from skyline_viz.overlay import css
from skyline_viz.stage import Quantity, Stage

_QUALITIES = (82, 70, 55, 40, 25)  # of WebP, tried from the best one on
_AVERAGED = cv2.INTER_AREA
_STOPS = 9  # colours of a scale


@dataclass(frozen=True)
class Picture:
    """A picture as it stands in a page."""

    address: str
    """Its bytes as a data URI."""

    width: int
    """Pixels a row."""

    height: int
    """Rows."""


@dataclass(frozen=True)
class StagePicture:
    """A stage of a detection as a picture, with its scale."""

    title: str
    """What it shows, in words."""

    picture: Picture
    """The picture, on black where there is no value."""

    scale: tuple[str, ...] = ()
    """Colours of its scale, evenly spaced, as style sheets write them; none for a yes or no."""

    low: str = ""
    """Value of the first colour."""

    high: str = ""
    """Value of the last one, with its unit."""


def reduced_size(height: int, width: int, most: int) -> tuple[int, int]:
    """Height and width of a picture no side of which has more than `most` pixels.

    >>> reduced_size(519, 1388, 640), reduced_size(300, 400, 640)
    ((239, 640), (300, 400))
    """
    scale = min(most / max(height, width), 1.0)
    return max(round(height * scale), 1), max(round(width * scale), 1)


def photo_picture(photo: U8, most: int, most_bytes: int) -> Picture:
    """A photo ``(H, W, 3)``, at most `most` pixels a side and about `most_bytes` large."""
    height, width = reduced_size(len(photo), photo.shape[1], most)
    small = cv2.resize(photo, (width, height), interpolation=_AVERAGED)
    return encoded(np.asarray(small, np.uint8), most_bytes)


def encoded(picture: U8, most_bytes: int) -> Picture:
    """A picture ``(h, w, 3)`` as WebP; what stays too large is made coarser, and then smaller."""
    data = b""
    for quality in _QUALITIES:
        data = _webp(picture, quality)
        if len(data) <= most_bytes:
            break
    height, width = picture.shape[:2]
    if len(data) > most_bytes and min(height, width) > 16:
        half = cv2.resize(picture, (width // 2, height // 2), interpolation=_AVERAGED)
        return encoded(np.asarray(half, np.uint8), most_bytes)
    address = f"data:image/webp;base64,{base64.b64encode(data).decode('ascii')}"
    return Picture(address, width, height)


def stage_pictures(detection: Detection, most: int, most_bytes: int) -> tuple[StagePicture, ...]:
    """The stages of figure 1, and what else a method shows with them.

    Args:
        detection: The detection.
        most: Pixels a side at the most.
        most_bytes: Bytes of all of them together, about.
    """
    shown = [one for one in detection.stages.values() if "Stages" in one.quantity.tabs]
    each = most_bytes // max(len(shown), 1)
    height, width = detection.edges.shape
    size = reduced_size(height, width, most)
    return tuple(_stage(detection, one, size, each) for one in shown)


def _stage(
    detection: Detection, stage: Stage, size: tuple[int, int], most_bytes: int
) -> StagePicture:
    quantity, shape = stage.quantity, detection.edges.shape
    if stage.where == "edges":
        places = detection.edge_rows, detection.edge_columns
        values = _loudest_points(quantity, stage.values, places, shape, size)
    elif stage.where == "mask":
        share = cv2.resize(stage.values.astype(np.float32), size[::-1], interpolation=_AVERAGED)
        values = np.sqrt(np.asarray(share, np.float32))  # one pixel in ten is a line still
    else:
        whole = stage.map()
        assert whole is not None  # the path, which alone has none, is on no tab
        values = _reduced_map(quantity, np.asarray(whole, np.float32), size)
    picture, low, high = _coloured(quantity, values)
    made = encoded(picture, most_bytes)
    if stage.where == "mask":
        return StagePicture(stage.about, made)
    words = _short(low), f"{_short(high)}{quantity.unit}"
    stops = _places(quantity, np.linspace(0, 1, _STOPS))
    colours = coloured(stage.colour_map, stops).tolist()
    return StagePicture(stage.about, made, tuple(css((r, g, b)) for r, g, b in colours), *words)


def _quiet_when_high(quantity: Quantity) -> bool:
    """Whether small values are what one looks for, as of costs."""
    return quantity.colour_map.endswith("_r")


def _loudest_points(
    quantity: Quantity,
    values: npt.NDArray[Any],
    places: tuple[Int, Int],
    shape: tuple[int, ...],
    size: tuple[int, int],
) -> F32:
    """Values ``(n,)`` of some pixels in a smaller map ``(h, w)``, NaN where there is none."""
    small = np.full(size, np.nan, np.float32)
    order = np.argsort(-values if _quiet_when_high(quantity) else values, kind="stable")
    rows, columns = (
        one[order] * new // old for one, new, old in zip(places, size, shape, strict=True)
    )
    small[rows, columns] = values[order]  # of several in one place the last one stays
    return small


def _reduced_map(quantity: Quantity, values: F32, size: tuple[int, int]) -> F32:
    """A map ``(H, W)`` at ``(h, w)``: a smooth one averaged, else the loudest of each part."""
    height, width = values.shape
    if quantity.smooth:
        return np.asarray(cv2.resize(values, size[::-1], interpolation=_AVERAGED), np.float32)
    sign = np.float32(-1 if _quiet_when_high(quantity) else 1)
    known = np.where(np.isnan(values), np.float32(-np.inf), sign * values)
    kernel = np.ones((math.ceil(height / size[0]), math.ceil(width / size[1])), np.uint8)
    dilated = cv2.dilate(known, kernel, borderType=cv2.BORDER_REPLICATE)
    rows, columns = (
        ((2 * np.arange(new) + 1) * old // (2 * new))
        for new, old in zip(size, values.shape, strict=True)
    )
    small = np.asarray(dilated, np.float32)[np.ix_(rows, columns)]
    return np.where(np.isinf(small), np.float32(np.nan), sign * small)


def _coloured(quantity: Quantity, values: F32) -> tuple[U8, float, float]:
    """Colours ``(h, w, 3)`` of a map on black, and the values of the first and the last one."""
    known = values[np.isfinite(values)]
    low = quantity.low if quantity.low is not None else float(known.min(initial=0.0))
    high = quantity.high if quantity.high is not None else float(known.max(initial=low))
    missing = np.isnan(values)
    shares = np.clip((np.where(missing, low, values) - low) / max(high - low, 1e-6), 0.0, 1.0)
    picture = coloured(quantity.colour_map, _places(quantity, shares))
    picture[missing] = 0
    return picture, low, high


def _places(quantity: Quantity, shares: npt.NDArray[np.floating]) -> npt.NDArray[np.floating]:
    """Where on its colour map a quantity shows values, given as shares of its range."""
    first, last = quantity.span
    places: npt.NDArray[np.floating] = first + (last - first) * shares**quantity.contrast
    return places


def _webp(picture: U8, quality: int) -> bytes:
    file = io.BytesIO()
    Image.fromarray(picture).save(file, "WEBP", quality=quality, method=4)
    return file.getvalue()


def _short(value: float) -> str:
    """A number with three digits.

    >>> _short(118.64), _short(-1.31), _short(0.0)
    ('119', '-1.31', '0')
    """
    return f"{value:.3g}"
