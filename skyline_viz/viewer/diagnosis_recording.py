"""A diagnosis as Rerun entities: failing segments, what the truth lacks there, and the proof."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import rerun as rr

from skyline_viz.arrays import Int
from skyline_viz.colours import ALTERNATIVE, HALO
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.diagnosis.diagnosing import Diagnosis, Segment
from skyline_viz.diagnosis.remedies import Remedy
from skyline_viz.skyline import Skyline
from skyline_viz.system.names import named_in_markdown
from skyline_viz.viewer import entities
from skyline_viz.viewer.column_views import LINE_RADIUS, dashes
from skyline_viz.viewer.documents import markdown_document

_FRAME, _MISSED, _STARVED = (0xF5, 0xF5, 0xF5), (0xE6, 0x9F, 0x00), (0x56, 0xB4, 0xE9)
_NAMED = 3  # segments whose causes are written on the photo, those with the largest total error
_LEAST_FRAME = 6  # columns that the frame of a segment is wide at least
_SHORT = 45  # letters of flags that are written on the photo
_MARKED = 70  # the marks of the truth's pixels are this part of the height above it
_BEYOND = 8  # columns beside a segment in which the counterfactual path is drawn


def log_diagnosis(
    recording: rr.RecordingStream,
    diagnosis: Diagnosis,
    detection: Detection,
    truth: Skyline,
    name: str = "",
    mended: tuple[Remedy, Skyline] | None = None,
) -> None:
    """Log a diagnosis beside its detection.

    Args:
        recording: Where to.
        diagnosis: The diagnosis.
        detection: The detection.
        truth: The true line.
        name: Name of the photo, for the report.
        mended: The setting that helps most, and the line with it; None where none does, or nobody
            has tried.
    """
    mend = _said(mended[0]) if mended else ()
    recording.log(entities.DIAGNOSIS, markdown_document(diagnosis.markdown(name, mend)))
    if diagnosis.right:
        return
    case = Case(detection, truth, diagnosis.tolerance)
    height = len(detection.photo)
    boxes, lines = [], []
    room = height / 40
    for segment in diagnosis.segments:
        first, last = segment.columns
        part = slice(first, last + 1)
        both = np.concatenate([truth.rows[part], detection.skyline.rows[part]])
        wide = max(last + 1 - first, _LEAST_FRAME)
        left = (first + last + 1 - wide) / 2
        boxes.append((left, both.min() - room, wide, np.ptp(both) + 2 * room))
        if segment.proof and segment.cause != "truth doubtful":
            lines.append(_around(segment))
    corners = np.array(boxes, np.float32).reshape(-1, 4)
    by_error = sorted(range(len(boxes)), key=lambda at: -diagnosis.segments[at].total_error)
    named = by_error[:_NAMED]
    causes = [diagnosis.segments[at].title for at in named]
    for entity, shown, labels in (
        (entities.SEGMENTS, by_error[_NAMED:], None),
        (f"{entities.SEGMENTS}/largest", named, causes),
    ):
        for place, colour, across, order in (
            (f"{entity}/halo", HALO, 2.5, 19.0),  # a frame is to be seen on a white sky, too
            (entity, _FRAME, 1.0, 20.0),
        ):
            frames = rr.Boxes2D(
                mins=corners[shown, :2],
                sizes=corners[shown, 2:],
                labels=labels if place == entity else None,
                colors=[colour],
                radii=[-across],
                draw_order=order,
            )
            recording.log(place, frames)
    for place, colour, across, order in (
        (f"{entities.COUNTERFACTUAL}/halo", HALO, LINE_RADIUS + 1, 41.0),
        (entities.COUNTERFACTUAL, ALTERNATIVE, LINE_RADIUS, 42.0),
    ):
        strips = rr.LineStrips2D(lines, colors=[colour], radii=[-across], draw_order=order)
        recording.log(place, strips)
    _log_truth_pixels(recording, case)
    if mended:
        _log_remedy(recording, *mended)


def _said(remedy: Remedy) -> tuple[str, ...]:
    """What mends a photo, and with which flags, in Markdown."""
    flags = named_in_markdown(remedy.flags)
    return (
        f"**A_err {remedy.a_err:.2f} px** with {named_in_markdown(remedy.name)}  ",
        f"To be added: `{flags}`" if flags == remedy.flags else f"To be added: {flags}",
    )


def _log_remedy(recording: rr.RecordingStream, remedy: Remedy, line: Skyline) -> None:
    """Draw the line with other settings, in dashes: the proof of the cause is a whole one."""
    points = np.column_stack([np.arange(line.width) + 0.5, line.rows]).astype(np.float32)
    pieces = dashes([points], line.width)
    spelt = remedy.flags if len(remedy.flags) <= _SHORT else "other settings"
    labels = [f"{spelt}: A_err {remedy.a_err:.2f} px"]
    middle = len(pieces) // 2
    for entity, strips, shown in (
        (entities.REMEDY, pieces[:middle] + pieces[middle + 1 :], None),
        (f"{entities.REMEDY}/named", [pieces[middle]], labels),
    ):
        strip = rr.LineStrips2D(
            strips, colors=[ALTERNATIVE], radii=[-1.5], labels=shown, draw_order=43.0
        )
        recording.log(entity, strip)


def _around(segment: Segment) -> npt.NDArray[np.float32]:
    """Points of the path that was brought back, in a segment and a little beyond."""
    start, rows = segment.line
    first = max(segment.columns[0] - _BEYOND - start, 0)
    stop = segment.columns[1] + 1 + _BEYOND - start
    part = rows[first:stop]
    places = start + first + np.arange(len(part)) + 0.5
    return np.column_stack([places, part]).astype(np.float32)


def _log_truth_pixels(recording: rr.RecordingStream, case: Case) -> None:
    """Mark where the truth has no edge, and where its edge pixels are in starved bins.

    The marks lie above the truth: on it they would hide it, and what comes back to it.
    """
    above = max(round(len(case.detection.photo) / _MARKED), 2)
    on_edge = case.pixels >= 0
    starved = np.zeros(len(on_edge), np.bool_)
    detection = case.detection
    starved[on_edge] = detection.starved[case.pixels[on_edge]]
    for entity, where, colour in (
        (entities.TRUTH_MISSED, ~on_edge & case.truth.visible, _MISSED),
        (entities.TRUTH_STARVED, starved & case.truth.visible, _STARVED),
    ):
        points = _points(np.flatnonzero(where), case.rows - above)
        marks = rr.Points2D(points, colors=[colour], radii=[-2.0], draw_order=45.0)
        recording.log(entity, marks)


def _points(columns: npt.NDArray[np.intp], rows: Int) -> npt.NDArray[np.float32]:
    return np.column_stack([columns + 0.5, rows[columns]]).astype(np.float32)
