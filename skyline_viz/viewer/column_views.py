"""What runs along the columns as Rerun entities: skylines on the photo, strips, and plots."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

import numpy as np
import numpy.typing as npt
import rerun as rr

from skyline_viz.arrays import F64, runs
from skyline_viz.colours import HALO, Colour, coloured
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.evaluation.metrics import column_errors
from skyline_viz.skyline import Skyline
from skyline_viz.viewer import entities

LINE_RADIUS = 1.0
"""Half the width of the path on the photo, in points of the screen, at any zoom."""

TRUTH_RADIUS = 2.25
"""The same of the truth, which lies below the path."""

ALTERNATIVE_RADIUS = 1.6
"""The same of a second detection's line, which lies between both."""

STRIP_ERRORS = (1.0, 2.0, 4.0, 8.0, 16.0)
"""Errors above which the strip gets brighter, in pixels."""

STRIP_MARGINS = (4.0, 2.0, 1.0, 0.5, 0.25)
"""Margins below which the strip gets brighter, where there is no truth."""

_ERROR, _MARGIN, _COST = (0xA0, 0x6E, 0x00), (0x3C, 0x7C, 0xA0), (0x7C, 0x7C, 0x7C)
_LINK = (0xB0, 0x8C, 0xD8)
_DASHES = 80  # and gaps, across a photo
_LEAST_SHARE = 0.01  # of what truth and path pay differently, for a term to have a curve
_LIGHT_ERROR, _LIGHT_MARGIN, _LIGHT_COST = (  # lines are read on black, areas by their height
    (0xE6, 0xA5, 0x2A),
    (0x6F, 0xB6, 0xDC),
    (0xD0, 0xD0, 0xD0),
)


def log_line(
    recording: rr.RecordingStream,
    entity: str,
    skyline: Skyline,
    colour: Colour,
    radius: float = LINE_RADIUS,
    *,
    dashed: bool = False,
) -> None:
    """Log a skyline with its dark halo; where it is not visible there is a gap, or dashes.

    Args:
        recording: Where to.
        entity: Entity path; the halo lies at ``halo`` below it.
        skyline: The line.
        colour: Its colour.
        radius: Half its width. Where lines agree, the thin one lies on the wide one, so that
            both show.
        dashed: Whether what is found but not visible is drawn in thin dashes, ``hidden`` below it.
    """
    strokes = line_strips(skyline)
    if dashed:
        unseen = dashes(line_strips(replace(skyline, visible=~skyline.visible)), skyline.width)
        thin = rr.LineStrips2D(unseen, colors=[colour], radii=[-1.0], draw_order=29.0)
        recording.log(f"{entity}/hidden", thin)
    for place, tone, across, order in (
        (f"{entity}/halo", HALO, radius + 1.0, 30.0 - radius),
        (entity, colour, radius, 40.0 - radius),
    ):
        radii = np.array([-across], np.float32)  # negative: points of the screen, not pixels
        recording.log(place, rr.LineStrips2D(strokes, colors=[tone], radii=radii, draw_order=order))


def line_strips(skyline: Skyline) -> list[npt.NDArray[np.float32]]:
    """Points ``(m, 2)`` of (x, y) of each visible run of a skyline, in the viewer's coordinates."""
    centres = np.arange(skyline.width, dtype=np.float32) + np.float32(0.5)
    points = np.column_stack([centres, skyline.rows])
    return [points[first : last + 1] for first, last in runs(skyline.visible)]


def dashes(strips: list[npt.NDArray[np.float32]], width: int) -> list[npt.NDArray[np.float32]]:
    """Every second piece of lines.

    Args:
        strips: Points ``(m, 2)`` of each, a column apart.
        width: Columns of the photo, which has so many dashes and gaps together.
    """
    dash = max(round(width / _DASHES), 2)
    starts = [(one, at) for one in strips for at in range(0, len(one), 2 * dash)]
    return [one[at : at + dash] for one, at in starts]


def log_columns(
    recording: rr.RecordingStream,
    at: Callable[[str], str],
    detection: Detection,
    margins: F64,
    truth: Skyline | None,
) -> None:
    """Log error, margin, nodal cost and link cost of each column, and the strip on the photo.

    Args:
        recording: Where to.
        at: Gives the full path of an entity.
        detection: The detection.
        margins: ``(W,)`` its margins.
        truth: The true skyline.
    """
    node, link = path_costs(detection)
    finite = margins[np.isfinite(margins)]
    curves = {
        entities.MARGINS: (np.minimum(margins, finite.max(initial=0.0)), _MARGIN),
        entities.NODE_COSTS: (node, _COST),
    }
    strip = 1 + np.digitize(-margins, -np.array(STRIP_MARGINS), right=True)
    words = [
        f"margin over {STRIP_MARGINS[0]:g}",
        *(f"margin up to {one:g}" for one in STRIP_MARGINS),
    ]
    if truth:
        errors = column_errors(detection.skyline, truth)
        curves[entities.ERRORS] = (np.nan_to_num(errors), _ERROR)
        known = ~np.isnan(errors)
        strip = np.where(known, 1 + np.digitize(errors, STRIP_ERRORS, right=True), 0)
        words = [f"error up to {STRIP_ERRORS[0]:g} px"]
        words += [f"error over {one:g} px" for one in STRIP_ERRORS]
    else:
        recording.log(at(entities.ERRORS), rr.Clear(recursive=False))  # an earlier photo's
    for entity, (values, colour) in curves.items():
        recording.log(at(entity), curve(values, colour))
    recording.log(at(entities.LINK_COSTS), rr.BarChart(link.astype(np.float32), color=_LINK))
    _log_strip(recording, at(entities.STRIP), strip, words, len(detection.photo))


def log_series(
    recording: rr.RecordingStream, detection: Detection, margins: F64, truth: Skyline | None
) -> None:
    """Log what is known of each column along the timeline `entities.COLUMN`, see `entities.SERIES`.

    Args:
        recording: Where to.
        detection: The detection.
        margins: ``(W,)`` its margins.
        truth: The true skyline.
    """
    node, link = path_costs(detection)
    known = {
        "margin": (np.where(np.isfinite(margins), margins, np.nan), "margin", _LIGHT_MARGIN),
        "path/node": (node, "nodal cost", _LIGHT_COST),
        "path/link": (link, "link cost", _LINK),
    }
    if truth is not None:
        errors = column_errors(detection.skyline, truth)
        known["error"] = (errors, "error", _LIGHT_ERROR)
        rows = Case(detection, truth, 0.0).rows
        own = detection.cost_model.split(detection.skyline.rows.astype(np.int32))
        apart = {
            name: np.where(truth.visible, paid - own[name], np.nan)
            for name, paid in detection.cost_model.split(rows).items()
        }
        everything = np.add.reduce(list(apart.values()))
        sizes = {name: np.nansum(np.abs(values)) for name, values in apart.items()}
        least = _LEAST_SHARE * sum(sizes.values())
        apart = {name: values for name, values in apart.items() if sizes[name] > least}
        colours = {term.name: term.colour for term in detection.cost_model.terms}
        for name, values in {**apart, "all": everything}.items():
            red, green, blue = bytes.fromhex(colours.get(name, "#FFFFFF")[1:])
            title = f"{name} {np.nansum(values):+.1f}"
            place = f"apart/{name.replace(' ', '_')}"
            known[place] = (_smooth(values), title, (red, green, blue))
    for name, (values, title, colour) in known.items():
        columns = np.flatnonzero(np.isfinite(values))
        entity = f"{entities.SERIES}/{name}"
        look = rr.SeriesLines(colors=[colour], names=[title], widths=[1.5])
        recording.log(entity, look, static=True)
        times = [rr.TimeColumn(entities.COLUMN, sequence=columns)]
        recording.send_columns(entity, times, rr.Scalars.columns(scalars=values[columns]))


def _smooth(values: F64) -> F64:
    """Means of nine columns, as many as are known of them; unknown ones stay so."""
    known = np.isfinite(values)
    nine = np.ones(9)
    sums = np.convolve(np.where(known, values, 0.0), nine)[4 : 4 + len(values)]
    counts = np.convolve(known.astype(np.float64), nine)[4 : 4 + len(values)]
    return np.where(known, sums / np.maximum(counts, 1.0), np.nan)


def curve(values: npt.NDArray[np.floating], colour: Colour) -> rr.BarChart:
    """A value of each column ``(W,)`` as an area.

    Bars are two columns wide: the viewer lays translucent bars over each other, and narrower ones
    would leave dark stripes. So the colour should be a dark one.
    """
    wide = np.full(len(values), 2.0, np.float32)
    return rr.BarChart(values.astype(np.float32), color=colour, widths=wide)


def path_costs(detection: Detection) -> tuple[F64, F64]:
    """Nodal cost of the path in each column, and link cost paid to reach it, each ``(W,)``."""
    rows = detection.skyline.rows.astype(np.intp)
    node = detection.cost[rows, np.arange(len(rows))].astype(np.float64)
    link = detection.link_weight * np.abs(np.diff(rows, prepend=rows[:1]))
    return node, link


def _log_strip(
    recording: rr.RecordingStream,
    entity: str,
    classes: npt.NDArray[np.intp],
    words: list[str],
    height: int,
) -> None:
    """A strip along the lower rim of the photo; class 0 is transparent."""
    strip = np.zeros((height, len(classes)), np.uint8)
    strip[-max(4, height // 50) :] = classes
    recording.log(
        entity,
        _strip_legend(tuple(words)),
        rr.SegmentationImage(strip, opacity=1.0),
    )


@lru_cache(maxsize=2)
def _strip_legend(words: tuple[str, ...]) -> rr.AnnotationContext:
    colours = coloured("inferno", np.linspace(0.15, 0.95, len(words))).tolist()
    infos = [rr.AnnotationInfo(0, "", (0, 0, 0, 0))]
    for word, colour in zip(words, colours, strict=True):
        infos.append(rr.AnnotationInfo(len(infos), word, tuple(colour)))
    return rr.AnnotationContext(infos)
