"""A detection inside a Jupyter notebook: the viewer in the cell's output.

    sv.show_detection(detection, truth)

Needs the extra ``notebook``: ``pip install "skyline-viz[notebook]"``.
"""

from __future__ import annotations

from typing import Literal

import rerun as rr
import rerun.notebook as rrn

from skyline_viz.detection import Detection
from skyline_viz.skyline import Skyline
from skyline_viz.system.names import printable, shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.contents import Contents, Fidelity
from skyline_viz.viewer.recording import APPLICATION, log_along_columns, log_detection


def show_detection(
    detection: Detection,
    truth: Skyline | None = None,
    *,
    name: str = "photo",
    fidelity: Fidelity = "lean",
    width: int | Literal["auto"] = "auto",
    height: int = 640,
) -> None:
    """Show all stages of a detection in the output of a notebook's cell.

    Args:
        detection: The detection.
        truth: The true skyline, to compare with.
        name: What the viewer calls the photo.
        fidelity: How much to keep, see `recording.Fidelity`. A full detection of an ordinary photo
            takes 26 MB: a notebook server passes no more than a few megabytes at its defaults.
        width: Of the viewer in pixels, or the cell's.
        height: Of the viewer in pixels.

    Raises:
        ImportError: The extra ``notebook`` is not installed.
        SkylineError: The truth has another width than the photo.
    """
    if not rrn.HAS_NOTEBOOK:
        raise ImportError('viewers in notebooks need: pip install "skyline-viz[notebook]".')
    recording = rr.RecordingStream(APPLICATION)
    recording.set_log_time_enabled(False)
    recording.send_recording_name(shown_in_viewer(printable(name)))
    contents = Contents.of(detection, fidelity, truth=truth is not None, columns=True)
    viewer = rrn.Viewer(
        width=width, height=height, recording=recording, blueprint=detection_blueprint(contents)
    )
    recording.set_time(entities.COLUMN, sequence=entities.OPENING)
    log_detection(recording, detection, truth, name=name, fidelity=fidelity)
    recording.reset_time()
    log_along_columns(recording, detection, truth)
    recording.flush()
    viewer.update_panels(top="hidden", blueprint="hidden", selection="hidden", time="collapsed")
    viewer.display()
