"""A second detection beside the first in a recording: its line, its stages, and what differs."""

from __future__ import annotations

import numpy as np
import rerun as rr

from skyline_viz.colours import ALTERNATIVE
from skyline_viz.detection import Detection
from skyline_viz.evaluation.metrics import TOLERANCE, scaled, wrong_segments
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.skyline import Skyline
from skyline_viz.system.names import named_in_markdown
from skyline_viz.viewer import entities
from skyline_viz.viewer.column_views import ALTERNATIVE_RADIUS, curve, log_line
from skyline_viz.viewer.contents import Fidelity
from skyline_viz.viewer.documents import markdown_document
from skyline_viz.viewer.recording import log_detection
from skyline_viz.viewer.report import listed_segments

_DIFFERENCE = (0xAA, 0x8E, 0x0A)  # the yellow of the second line, as dark as areas need it


def log_comparison(
    recording: rr.RecordingStream,
    detection: Detection,
    other: Detection,
    truth: Skyline | None,
    name: str,
    fidelity: Fidelity = "full",
) -> Verdict:
    """Log a second detection of a photo, after the first one has been logged.

    Its line is the yellow one. Its stages have the paths of the first under `entities.OTHER`.

    Args:
        recording: Where to.
        detection: The first detection.
        other: The second one, of the same photo.
        truth: The true skyline.
        name: What to call the second one.
        fidelity: How much of it to keep.

    Returns:
        What the second detection comes to.
    """
    height = len(detection.photo)
    verdict = log_detection(
        recording, other, truth, name=name, fidelity=fidelity, under=entities.OTHER
    )
    log_line(recording, entities.ALTERNATIVE, other.skyline, ALTERNATIVE, ALTERNATIVE_RADIUS)
    lower = other.skyline.rows - detection.skyline.rows
    recording.log(entities.DIFFERENCES, curve(lower, _DIFFERENCE))
    apart = wrong_segments(np.abs(lower).astype(np.float64), height)
    words = listed_segments(apart) or "none"
    text = (
        f"**{named_in_markdown(name)}** against the first  \n"
        f"Columns over {scaled(TOLERANCE, height):.3g} px apart: {words}  \n"
        f"Largest difference {np.abs(lower).max():.0f} px, "
        f"mean {np.abs(lower).mean():.2f} px\n"
    )
    recording.log(entities.COMPARISON, markdown_document(text))
    return verdict
