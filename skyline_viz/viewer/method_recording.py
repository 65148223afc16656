"""Several methods on one photo in a recording: their lines in named colours, and their stages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import rerun as rr

from skyline_viz.colours import PATH, TRUTH, Colour
from skyline_viz.detection import Detection
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.skyline import Skyline
from skyline_viz.system.names import named_in_markdown, shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.column_views import log_line
from skyline_viz.viewer.contents import Fidelity
from skyline_viz.viewer.documents import markdown_document
from skyline_viz.viewer.recording import log_detection

COLOURS: dict[str, Colour] = {
    "orange": (0xE6, 0x9F, 0x00),
    "sky blue": (0x56, 0xB4, 0xE9),
    "vermilion": (0xD5, 0x5E, 0x00),
    "lime": (0xB6, 0xE8, 0x80),
    "violet": (0xB0, 0x80, 0xFF),
    "white": (0xF5, 0xF5, 0xF5),
    "blue": (0x00, 0x72, 0xB2),
    "brown": (0xA0, 0x70, 0x50),
}
"""Colours of the methods' lines, in their order; none of them is that of path or truth."""

_RADIUS = 1.2


def log_methods(
    recording: rr.RecordingStream,
    detection: Detection,
    others: Sequence[Detection],
    truth: Skyline | None,
    fidelity: Fidelity = "full",
) -> None:
    """Log what other methods found on a photo, after our detection has been logged.

    The stages of a method have the paths of ours under `entities.METHODS`, by its name.

    Args:
        recording: Where to.
        detection: Our detection, for the table.
        others: At most as many as there are `COLOURS`.
        truth: The true skyline.
        fidelity: How much to keep.
    """
    height = len(detection.photo)
    ours = Verdict.of(detection.skyline, detection.margins(), height, truth)
    lines = [
        "| line | method | A_err | worst | ms |",
        "| --- | --- | ---: | ---: | ---: |",
        _row("magenta", detection, ours),
    ]
    for (word, colour), other in zip(COLOURS.items(), others, strict=False):
        under = entities.stages_of(other.method)
        verdict = log_detection(
            recording, other, truth, name=other.method, fidelity=fidelity, under=under
        )
        line = entities.line_of(other.method)
        log_line(recording, line, other.skyline, colour, _RADIUS)
        lines.append(_row(word, other, verdict))
    methods = zip((one.method for one in others), COLOURS.values(), strict=False)
    swatches = {"path": PATH, **dict(methods)}
    if truth:
        lines.append("| turquoise | truth | | | |")
        swatches["truth"] = TRUTH
    _log_swatches(recording, swatches, detection.edges.shape)
    text = "\n".join(lines)
    recording.log(entities.METHODS_TABLE, markdown_document(text))


def _log_swatches(
    recording: rr.RecordingStream, swatches: Mapping[str, Colour], shape: tuple[int, ...]
) -> None:
    """Write the names of lines on the photo, below each other, each in its colour."""
    height, width = shape
    down = height * (0.04 + 0.06 * np.arange(len(swatches)))
    points = np.column_stack([np.full(len(down), 0.1 * width), down])
    names = [shown_in_viewer(name) for name in swatches]
    marks = rr.Points2D(
        points, labels=names, colors=list(swatches.values()), radii=[-5.0], show_labels=True
    )
    recording.log(entities.METHODS_SWATCHES, marks)


def _row(colour: str, detection: Detection, verdict: Verdict) -> str:
    error, worst = "", ""
    if verdict.a_err is not None:
        error, worst = f"{verdict.a_err:.2f} px", f"{verdict.worst_error:.0f} px"
    took = f"{1000 * detection.total_seconds:.0f}"
    name = named_in_markdown(detection.method)
    return f"| {colour} | {name} | {error} | {worst} | {took} |"
