"""The stages of a photo as a recording in memory, such as a server sends to a browser."""

from __future__ import annotations

import threading

import rerun as rr

from skyline_viz.detection import Detection
from skyline_viz.skyline import Skyline
from skyline_viz.viewer import entities
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.contents import Contents, fidelity_of
from skyline_viz.viewer.recording import APPLICATION, log_along_columns, log_detection

_one_at_a_time = threading.Lock()  # a recording takes as much memory as its photo is large


def recorded(detection: Detection, truth: Skyline, name: str) -> bytes:
    """Bytes of a recording of a photo's stages: nothing of it is ever on the disk.

    Args:
        detection: What the detector saw.
        truth: The line to compare with, such as the one that is being labelled.
        name: Name of the photo.
    """
    with _one_at_a_time:
        recording = rr.RecordingStream(APPLICATION, recording_id=name)
        recording.set_log_time_enabled(False)
        recording.reset_time()  # one of that name, before it in this thread, may have left its own
        stream = rr.binary_stream(recording)
        try:
            recording.send_recording_name(name)
            fidelity = fidelity_of(detection.edges.size)
            recording.set_time(entities.COLUMN, sequence=entities.OPENING)
            log_detection(recording, detection, truth, name=name, fidelity=fidelity)
            recording.reset_time()
            log_along_columns(recording, detection, truth)
            contents = Contents.of(detection, fidelity, truth=True, columns=True)
            recording.send_blueprint(detection_blueprint(contents))
            return stream.read() or b""
        finally:
            recording.disconnect()
