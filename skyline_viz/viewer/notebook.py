"""A detection inside a Jupyter notebook: the viewer in the cell's output.

    sv.show_detection(detection, truth)

A click on a pixel asks the running Python about it. Where the viewer cannot run, as on a page to
which a notebook was exported, there is a picture of the skyline in its place.

Needs the extra ``notebook``: ``pip install "rerun-sdk[notebook]"``.
"""

from __future__ import annotations

import base64
import io
import math
from dataclasses import replace
from typing import Any, Literal

import rerun as rr
import rerun.notebook as rrn
from PIL import Image

from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.remedies import most_helpful
from skyline_viz.diagnosis.sweep import Sweep, setting_sweeps
from skyline_viz.overlay import draw_overlay
from skyline_viz.skyline import Skyline
from skyline_viz.system.names import printable, shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_recording import log_filter_bank
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.clicks import answer, clicked_pixel
from skyline_viz.viewer.comparison import log_comparison
from skyline_viz.viewer.contents import Contents, Fidelity, MethodContents
from skyline_viz.viewer.diagnosis_recording import log_diagnosis
from skyline_viz.viewer.program.rerun_internals import notebook_widget
from skyline_viz.viewer.recording import APPLICATION, log_along_columns, log_detection
from skyline_viz.viewer.sweep_recording import log_sweeps, opening_of

STILL_PIXELS = 400_000
"""Pixels of the picture that stands for the viewer where it cannot run."""

_HINT = "Click on a pixel to see what is known of it."


def show_detection(
    detection: Detection,
    truth: Skyline | None = None,
    *,
    name: str = "photo",
    other: Detection | None = None,
    sweep: bool = False,
    fidelity: Fidelity = "lean",
    width: int | Literal["auto"] = "auto",
    height: int = 640,
) -> None:
    """Show all stages of a detection in the output of a notebook's cell.

    With a truth, the tab *Diagnosis* says why it went wrong where it did. A click on a pixel shows
    below the viewer what is known of it, as the tab *Pixel* does.

    Args:
        detection: The detection.
        truth: The true skyline, to compare with.
        name: What the viewer calls the photo.
        other: A second detection of the photo, to lay beside the first.
        sweep: Whether to sweep the settings of our detector, which takes some seconds.
        fidelity: How much to keep, see `recording.Fidelity`. A full detection of an ordinary photo
            takes 26 MB: a notebook server passes no more than a few megabytes at its defaults.
        width: Of the viewer in pixels, or the cell's.
        height: Of the viewer in pixels.

    Raises:
        ImportError: The extra ``notebook`` is not installed.
        SkylineError: The truth has another width than the photo.
        TypeError: Settings are to be swept of a method that has none of ours.
    """
    if not rrn.HAS_NOTEBOOK:
        raise ImportError('viewers in notebooks need: pip install "rerun-sdk[notebook]".')
    ours = detection if isinstance(detection, FilterDetection) else None
    if sweep and ours is None:
        raise TypeError(f"a sweep changes the settings of our detector, not {detection.method}.")
    sweeps = setting_sweeps(ours) if sweep and ours else []
    recording = rr.RecordingStream(APPLICATION)
    recording.set_log_time_enabled(False)
    recording.send_recording_name(shown_in_viewer(printable(name)))
    viewer = rrn.Viewer(width=width, height=height, recording=recording)
    contents = _log(recording, detection, truth, name, other, sweeps, fidelity)
    if sweeps and ours:
        log_sweeps(recording, sweeps, ours, truth)
    recording.send_blueprint(detection_blueprint(contents))
    recording.flush()
    viewer.update_panels(top="hidden", blueprint="hidden", selection="hidden", time="collapsed")
    opening = sweeps[0] if sweeps else None
    viewer.set_time_ctrl(
        sequence=opening_of(opening) if opening else entities.OPENING,
        timeline=opening.timeline if opening else entities.COLUMN,
        play=False,
    )
    _display(viewer, detection, truth)


def _log(
    recording: rr.RecordingStream,
    detection: Detection,
    truth: Skyline | None,
    name: str,
    other: Detection | None,
    sweeps: list[Sweep],
    fidelity: Fidelity,
) -> Contents:
    """Log all but the sweeps, and say what is logged then."""
    openings = {sweep.timeline: opening_of(sweep) for sweep in sweeps}
    for timeline, at in {entities.COLUMN: entities.OPENING, **openings}.items():
        recording.set_time(timeline, sequence=at)
    log_detection(recording, detection, truth, name=name, fidelity=fidelity)
    if fidelity == "lean" and detection.bank is not None:
        log_filter_bank(recording, detection.bank)
    more: dict[str, Any] = {"swept": sweeps[0].timeline if sweeps else ""}
    if other is not None:
        log_comparison(recording, detection, other, truth, other.method, fidelity)
        held = MethodContents.of(other)
        more |= {"compared": held.name, "compared_stages": held.stages}
    if truth is not None and truth.visible.any():
        diagnosis = diagnose(detection, truth)
        more["diagnosed"] = not diagnosis.right
        if not diagnosis.right:
            mended = most_helpful(detection, truth, diagnosis)
            log_diagnosis(recording, diagnosis, detection, truth, name, mended=mended)
    recording.reset_time()
    log_along_columns(recording, detection, truth, openings)
    contents = Contents.of(detection, fidelity, truth=truth is not None, columns=True, **more)
    return replace(contents, bank=detection.bank is not None)


def _display(viewer: rrn.Viewer, detection: Detection, truth: Skyline | None) -> None:
    """Show a viewer, and below it what is known of the pixel that was clicked last."""
    from IPython.display import display  # noqa: PLC0415  # the extra
    from ipywidgets import HTML, Output, VBox  # noqa: PLC0415

    said = Output()

    def show(event: object) -> None:
        """Answer a click."""
        if not isinstance(event, rrn.SelectionChangeEvent):
            return
        pixel = clicked_pixel(event.items, detection.edges.shape)
        if pixel is None:
            return
        found = answer(detection, *pixel)
        shown: list[dict[str, Any]] = [{"text/markdown": found.text}]
        if found.picture:
            shown.append({"image/png": base64.b64encode(found.picture).decode()})
        said.outputs = tuple(
            {"output_type": "display_data", "data": one, "metadata": {}} for one in shown
        )

    viewer.on_event(show)
    box = VBox([notebook_widget(viewer), HTML(_HINT), said])
    bundle = dict(box._repr_mimebundle_())
    bundle["image/png"] = base64.b64encode(still(detection, truth)).decode()
    display(bundle, raw=True)


def still(detection: Detection, truth: Skyline | None) -> bytes:
    """A small PNG of the photo with path and truth, for where the viewer cannot run.

    Args:
        detection: The detection.
        truth: The true skyline.
    """
    picture = Image.fromarray(draw_overlay(detection.photo, detection.skyline, truth))
    shrunk = min(math.sqrt(STILL_PIXELS / (picture.width * picture.height)), 1.0)
    size = (max(round(picture.width * shrunk), 1), max(round(picture.height * shrunk), 1))
    data = io.BytesIO()
    picture.resize(size, Image.Resampling.LANCZOS).quantize(128).save(data, "PNG", optimize=True)
    return data.getvalue()
