"""The stages of a photo as a recording for Rerun's viewer, which the page opens in another tab."""

from __future__ import annotations

import threading

import rerun as rr

from skyline_viz.detection import Detection
from skyline_viz.skyline import Skyline
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.contents import Contents, fidelity_of
from skyline_viz.viewer.recording import APPLICATION, log_detection

_one_at_a_time = threading.Lock()  # a recording takes as much memory as its photo is large


def stages(detection: Detection, line: Skyline, name: str) -> bytes:
    """Record the stages of a photo: in memory, so that nothing is left on the disk.

    Args:
        detection: What the detector saw.
        line: The line as it is labelled now, which counts as the truth.
        name: Name of the photo.
    """
    with _one_at_a_time:
        recording = rr.RecordingStream(APPLICATION, recording_id=name)
        recording.set_log_time_enabled(False)
        stream = rr.binary_stream(recording)
        try:
            recording.send_recording_name(name)
            fidelity = fidelity_of(detection.edges.size)
            log_detection(recording, detection, line, name=name, fidelity=fidelity)
            contents = Contents.of(detection, fidelity, truth=True)
            recording.send_blueprint(detection_blueprint(contents))
            return stream.read() or b""
        finally:
            recording.disconnect()
