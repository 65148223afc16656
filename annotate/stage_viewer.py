"""The stages of a photo in Rerun's viewer, in a tab of its own beside the page."""

from __future__ import annotations

import subprocess
import threading
from contextlib import ExitStack

from skyline_viz.aftermath import ended, passing_folder
from skyline_viz.detection import Detection
from skyline_viz.recording import log_detection, new_recording
from skyline_viz.skyline import Skyline
from skyline_viz.viewer import serve


class StageViewer:
    """Serves the stages of one photo at a time to a browser on this machine."""

    def __init__(self) -> None:
        self._around = ExitStack()
        self._folder = self._around.enter_context(passing_folder("skyline-stages-"))
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def show(self, detection: Detection, line: Skyline, name: str) -> str:
        """Record the stages, serve them, and return the address to open.

        Args:
            detection: What the detector saw.
            line: The line as it is labelled now, which counts as the truth.
            name: Name of the photo.

        Raises:
            ViewerError: The viewer cannot be started.
        """
        with self._lock:
            self._stop()
            file = self._folder / "stages.rrd"
            with new_recording(file, name) as recording:
                log_detection(recording, detection, line, name=name)
            self._process, address = serve([file])
            return address

    def close(self) -> None:
        """Stop serving."""
        with self._lock:
            self._stop()
            self._around.close()

    def _stop(self) -> None:
        if self._process:
            ended(self._process)
            self._process = None
