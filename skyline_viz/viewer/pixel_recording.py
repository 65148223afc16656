"""One pixel of the path and one of the truth, all the way down, column by column.

Scrubbing the timeline `entities.COLUMN` moves both along their lines: the point on the photo, the
grey patch with its structure tensor, the filter, their product, and what the pixel pays.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import rerun as rr

from skyline_viz.arrays import F32, F64, Int
from skyline_viz.colours import PATH, TRUTH, Colour
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.diagnosis.explanation import Explanation, Filtered, explain_pixels
from skyline_viz.filter_bank import FilterBank
from skyline_viz.skyline import Skyline
from skyline_viz.stage import Quantity
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_pictures import cell_box
from skyline_viz.viewer.maps.value_maps import FINE, classes_of, legend
from skyline_viz.viewer.pixel_words import about_pixels

FULL_STRENGTH = 220.0
"""Gradient strength from which on the ellipse of the structure tensor fills its patch."""

PATCH = Quantity("grey level", "gray", low=0.0, high=255.0)
"""What the filter sees."""

_ROUND = np.linspace(0, 2 * np.pi, 33)


@dataclass(frozen=True, eq=False)
class _Walk:
    """The pixels of one line, column by column, as the viewer shows them."""

    line: str
    """Its name, ``path`` or ``truth``."""

    colour: Colour

    times: Int
    """``(k,)`` the places on the timeline of the columns that have a pixel."""

    told: Sequence[Explanation]
    """``(k,)``."""

    def until(self, time: int) -> _Walk:
        """The part of it up to a place on the timeline."""
        count = int(np.searchsorted(self.times, time, side="right"))
        return replace(self, times=self.times[:count], told=self.told[:count])


@dataclass(frozen=True, eq=False)
class _When:
    """When pixels are to be seen."""

    times: Int
    """``(m,)`` all places on the timeline of columns."""

    places: Mapping[str, Int]
    """``(m,)`` where these are on each timeline that shows them, by its name."""

    def columns(self) -> list[rr.TimeColumn]:
        """The same, as Rerun takes it."""
        return [rr.TimeColumn(name, sequence=at) for name, at in self.places.items()]


def log_pixels(
    recording: rr.RecordingStream,
    detection: Detection,
    truth: Skyline | None,
    opening: int,
    openings: Mapping[str, int],
) -> None:
    """Log the pixel of the path and that of the truth in every column.

    The truth's pixel is the edge pixel that belongs to it, where there is one within a few rows.

    Args:
        recording: Where to.
        detection: The detection.
        truth: The true skyline.
        opening: The column at which the timeline opens: that with the largest error.
        openings: Where other timelines begin, by name: the pixels in that column are shown there.
    """
    width = detection.edges.shape[1]
    times = np.arange(width, dtype=np.int32)
    every = times.copy()
    every[entities.OPENING] = opening
    lines = [("path", PATH, detection.skyline.rows.astype(np.int32), np.ones(width, np.bool_))]
    if truth is not None:
        lines.append(("truth", TRUTH, Case(detection, truth, 0.0).rows, truth.visible))
    walks = []
    for line, colour, rows, known in lines:
        kept = np.flatnonzero(known[every])
        columns = every[kept]
        told = explain_pixels(detection, rows[columns], columns)
        walks.append(_Walk(line, colour, times[kept], told))
    products = [one.filtered.product for walk in walks for one in walk.told if one.filtered]
    most = float(np.abs(np.array(products, np.float32)).max(initial=0.0))
    _log_walks(recording, detection, walks, _When(times, {entities.COLUMN: times}), most)
    if openings:
        first = times[: entities.OPENING + 1]
        begun = {name: np.array([at], np.int32) for name, at in openings.items()}
        walks = [walk.until(entities.OPENING) for walk in walks]
        _log_walks(recording, detection, walks, _When(first, begun), most)


def _log_walks(
    recording: rr.RecordingStream,
    detection: Detection,
    walks: Sequence[_Walk],
    when: _When,
    most: float,
) -> None:
    """Log the pixels of all lines, their products on a scale up to `most`."""
    for walk in walks:
        _log_points(recording, walk, when)
        filtered = [one.filtered for one in walk.told if one.filtered]
        if detection.bank is not None and len(filtered) == len(walk.told):
            _log_frames(recording, walk, filtered, detection.bank, when)
            _log_pictures(recording, walk, filtered, detection.bank, when, most)
    told = [(one.line, one.times, one.told) for one in walks]
    words = about_pixels(detection, told, when.times)
    texts = rr.TextDocument.columns(text=words, media_type=["text/markdown"] * len(words))
    recording.send_columns(entities.PIXEL_ABOUT, when.columns(), texts)


def _log_points(recording: rr.RecordingStream, walk: _Walk, when: _When) -> None:
    """A point on the photo, and none where the line has none."""
    entity = f"{entities.CHOSEN}/{walk.line}"
    places = [[one.column + 0.5, one.row + 0.5] for one in walk.told]
    points = rr.Points2D.columns(positions=np.array(places, np.float32).reshape(-1, 2))
    recording.send_columns(entity, when.columns(), points.partition(_lengths(walk, when.times)))
    look = rr.Points2D.from_fields(colors=[walk.colour], radii=[-5.0], draw_order=50.0)
    recording.log(entity, look, static=True)


def _log_frames(
    recording: rr.RecordingStream,
    walk: _Walk,
    filtered: Sequence[Filtered],
    bank: FilterBank,
    when: _When,
) -> None:
    """A frame around the filter that each pixel uses; none around that of a pixel without edge."""
    entity = f"{entities.BANK_CHOSEN}/{walk.line}"
    used = np.array([one.edge for one in walk.told], np.bool_)
    bins = [one.bin for one, edge in zip(filtered, used.tolist(), strict=True) if edge]
    boxes = np.array([cell_box(one, bank.bins) for one in bins], np.float32).reshape(-1, 4)
    frames = rr.Boxes2D.columns(
        half_sizes=(boxes[:, 2:] - boxes[:, :2]) / 2 + 2, centers=(boxes[:, 2:] + boxes[:, :2]) / 2
    )
    lengths = _lengths(walk, when.times)
    lengths[lengths > 0] = used
    recording.send_columns(entity, when.columns(), frames.partition(lengths))
    look = rr.Boxes2D.from_fields(colors=[walk.colour], radii=[-2.5], draw_order=50.0)
    recording.log(entity, look, static=True)


def _log_pictures(
    recording: rr.RecordingStream,
    walk: _Walk,
    filtered: Sequence[Filtered],
    bank: FilterBank,
    when: _When,
    most: float,
) -> None:
    """Patch with ellipse, filter, and product, each with its values when hovered."""
    there = _lengths(walk, when.times)
    parent, size = entities.pixel_of(walk.line), bank.size
    products = np.array([one.product for one in filtered], np.float32).reshape(-1, size, size)
    most_tap = float(np.abs(bank.filters).max())
    for name, quantity, values in (
        ("patch", PATCH, [one.patch.astype(np.float32) for one in filtered]),
        ("filter", _two_sided("tap", most_tap), [one.taps for one in filtered]),
        ("product", _two_sided("share of the score", most), list(products)),
    ):
        low, high = quantity.low or 0.0, quantity.high or 0.0
        classes = np.zeros((len(when.times), size, size), np.uint16)
        for at, one in zip(np.flatnonzero(there).tolist(), values, strict=True):
            classes[at] = classes_of(one, low, high, FINE)
        look = rr.SegmentationImage.from_fields(
            format=rr.components.ImageFormat(
                width=size, height=size, channel_datatype=rr.ChannelDatatype.U16
            ),
            opacity=1.0,
        )
        entity = f"{parent}/{name}"
        recording.log(entity, legend(quantity, low, high, FINE), look, static=True)
        pictures = rr.SegmentationImage.columns(buffer=[one.tobytes() for one in classes])
        recording.send_columns(entity, when.columns(), pictures)
    strips = [strip for one in filtered for strip in ellipse(one, size)]
    outlines = rr.LineStrips2D.columns(strips=strips)
    recording.send_columns(f"{parent}/ellipse", when.columns(), outlines.partition(2 * there))
    drawn = rr.LineStrips2D.from_fields(colors=[walk.colour], radii=[-1.5], draw_order=50.0)
    recording.log(f"{parent}/ellipse", drawn, static=True)


def _two_sided(name: str, most: float) -> Quantity:
    """What is positive, red, or negative, blue."""
    most = most or 1.0
    return Quantity(name, "blue_red", low=-most, high=most)


def ellipse(filtered: Filtered, size: int) -> tuple[F32, F32]:
    """Outline ``(33, 2)`` of a structure tensor in its patch, and its axis ``(2, 2)``, as (x, y).

    The axis points along the gradient. A strength of `FULL_STRENGTH` reaches the rim of the patch.
    """
    angle = np.deg2rad(filtered.orientation)
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    scale = size / 2 * min(1.0, FULL_STRENGTH / max(filtered.strength, 1e-6)) / FULL_STRENGTH
    first, second = (scale * one for one in filtered.axes)
    outline = first * np.cos(_ROUND)[:, None] * along + second * np.sin(_ROUND)[:, None] * across
    axis = np.stack([-first * along, first * along])
    middle = size / 2
    return (outline + middle).astype(np.float32), (axis + middle).astype(np.float32)


def _lengths(walk: _Walk, times: Int) -> npt.NDArray[np.int64]:
    """``(W,)`` how many pixels a line has at each time: one or none."""
    return np.isin(times, walk.times).astype(np.int64)


def opening_column(errors: F64 | None, margins: F64) -> int:
    """The column to look at first: the one with the largest error, else the least sure one.

    >>> opening_column(np.array([1.0, np.nan, 7.0]), np.array([0.1, 0.2, 0.3]))
    2
    >>> opening_column(None, np.array([0.4, 0.2, np.inf]))
    1
    """
    if errors is not None and np.isfinite(errors).any():
        return int(np.nanargmax(errors))
    return int(np.argmin(margins))
