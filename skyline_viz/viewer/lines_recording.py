"""Lines along other ridges than the path: numbered on the photo, and what each pays by term."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import rerun as rr

from skyline_viz.arrays import Int
from skyline_viz.certainty.other_lines import OtherLine
from skyline_viz.detection import Detection
from skyline_viz.evaluation.metrics import column_errors
from skyline_viz.skyline import Skyline
from skyline_viz.viewer import entities
from skyline_viz.viewer.column_views import log_line
from skyline_viz.viewer.documents import markdown_document
from skyline_viz.viewer.method_recording import COLOURS

_RADIUS = 1.3
_PLACES = (1, 3, 5, 7)  # eighths of the line where its number stands: they do not meet so
_WORDS = ("orange", "sky blue", "vermilion", "lime")


def log_lines(
    recording: rr.RecordingStream,
    detection: Detection,
    lines: Sequence[OtherLine],
    truth: Skyline | None,
) -> None:
    """Log the best other lines of a detection, and a table of what they pay.

    Args:
        recording: Where to.
        detection: The detection.
        lines: Lines along other ridges, the cheapest first; up to four are shown.
        truth: The true skyline, for the error of each.
    """
    height = len(detection.photo)
    path = detection.skyline.pixel_rows(height).clip(0, height - 1).astype(np.int32)
    rows: list[tuple[str, Int, float, float]] = [("path, magenta", path, 0.0, 0.0)]
    for at, (word, line) in enumerate(zip(_WORDS, lines, strict=False)):
        entity = f"{entities.OTHER_LINES}/{at + 1}"
        skyline = Skyline(line.rows.astype(np.float32))
        log_line(recording, entity, skyline, COLOURS[word], _RADIUS)
        column = _own_column(line.rows, [path, *(other.rows for other in lines[:at])], at)
        number = rr.Points2D(
            [(column + 0.5, line.rows[column])],
            colors=[COLOURS[word]],
            labels=[f"{at + 1}"],
            radii=[-4.0],
            draw_order=50.0,
        )
        recording.log(f"{entity}/number", number)
        rows.append((f"{at + 1}, {word}", line.rows, line.detour, line.apart))
    recording.log(entities.OTHER_LINES_TABLE, markdown_document(_table(detection, rows, truth)))


def _own_column(rows: Int, others: Sequence[Int], at: int) -> int:
    """The column nearest to a line's own place in which it is far from the others."""
    apart = np.min([np.abs(rows - one) for one in others], axis=0)
    far = np.flatnonzero(apart >= np.percentile(apart, 75))
    wanted = len(rows) * _PLACES[at] // 8
    return int(far[np.abs(far - wanted).argmin()])


def _table(
    detection: Detection, rows: Sequence[tuple[str, Int, float, float]], truth: Skyline | None
) -> str:
    """What path and lines pay for each term."""
    if len(rows) == 1:
        return "There is no other line: nothing else is possible.\n"
    paid = {
        name: {term: costs.sum() for term, costs in detection.cost_model.split(line).items()}
        for name, line, _, _ in rows
    }
    terms = [
        term.name
        for term in detection.cost_model.terms
        if any(one[term.name] for one in paid.values())
    ]
    head = ["line", "dearer by", "elsewhere", *terms]
    if truth is not None and truth.visible.any():
        head.insert(1, "A_err (px)")
    lines = ["Whole lines along other ridges, the cheapest first, and what each pays in all.", ""]
    lines += [f"| {' | '.join(head)} |", f"| --- |{' ---: |' * (len(head) - 1)}"]
    for name, line, detour, apart in rows:
        told = [f"{detour:.1f}", f"{apart:.0%}", *(f"{paid[name][term]:.1f}" for term in terms)]
        if len(told) < len(head) - 1 and truth is not None:
            errors = column_errors(Skyline(line.astype(np.float32)), truth)
            told.insert(0, f"{np.nanmean(errors):.2f}")
        lines.append(f"| {name} | {' | '.join(told)} |")
    return "\n".join(lines) + "\n"
