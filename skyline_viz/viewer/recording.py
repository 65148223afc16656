"""A detection as Rerun entities: what every stage saw, ready to be looked at.

    with new_recording("photo.rrd", "photo.jpg") as recording:
        log_detection(recording, detection, truth)

Everything goes to the recording that is passed in; there is no global one. Where things are is
written in `viewer.entities`. Coordinates are Rerun's: the pixel in row r and column c covers
x from c to c + 1 and y from r to r + 1; a skyline, the upper side of the first terrain pixels, lies
at y = row.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

import cv2
import numpy as np
import numpy.typing as npt
import rerun as rr
import rerun.blueprint as rrb

from skyline_viz.arrays import U8, Bool, check_photo
from skyline_viz.colours import PATH, TRUTH
from skyline_viz.detection import Detection
from skyline_viz.evaluation.metrics import column_errors
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.files import replacing
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.stage import DETOUR, Quantity
from skyline_viz.system.endings import held_back
from skyline_viz.system.memory import FULL_MEGAPIXELS
from skyline_viz.system.names import printable, recording_id, shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_recording import log_filter_bank
from skyline_viz.viewer.blueprints import detection_blueprint, stages_blueprint
from skyline_viz.viewer.column_views import TRUTH_RADIUS, log_columns, log_line, log_series
from skyline_viz.viewer.contents import Contents, Fidelity
from skyline_viz.viewer.documents import markdown_document
from skyline_viz.viewer.maps.near import Near, let_go
from skyline_viz.viewer.maps.stage_maps import (
    QUANTITIES,
    encoded_edges,
    log_detour,
    log_exact_map,
    log_maps,
    places_of,
    shown_pixels,
)
from skyline_viz.viewer.pixel_recording import log_pixels, opening_column
from skyline_viz.viewer.program.rerun_file import saved
from skyline_viz.viewer.program.rerun_internals import let_go_of_orphans
from skyline_viz.viewer.report import report

APPLICATION = "skyline-viz"
"""Application id of all recordings: they share what is changed about the layout by hand."""

_BATCH = 1 << 18  # bytes: less than a map

_LEAN_JPEG = 75  # quality: at 85 the photo takes a third of a lean recording


@contextmanager
def new_recording(path: str | os.PathLike[str], name: str) -> Iterator[rr.RecordingStream]:
    """Write a recording to a file, which appears when it is complete.

    When the work is interrupted by Ctrl-C, the file holds what was logged before.

    Args:
        path: The ``.rrd`` file.
        name: What the viewer calls the recording.

    Raises:
        OSError: The disk is full; what was at `path` is untouched.
    """
    interrupted: KeyboardInterrupt | None = None
    # streams that nobody holds any more keep what was logged, 2 MB a photo, until told to let go
    let_go_of_orphans()
    with replacing(path) as temporary:
        batches = rr.ChunkBatcherConfig.DEFAULT()
        batches.flush_num_bytes = _BATCH  # compress maps while the next ones are made
        with held_back():  # half a stream complains when it goes
            recording = rr.RecordingStream(
                APPLICATION, recording_id=recording_id(name), batcher_config=batches
            )
        recording.set_log_time_enabled(False)  # else a photo would be a film of its stages
        recording.reset_time()  # an earlier one of that name, in this thread, may have left its own
        with saved(recording, temporary):
            try:
                recording.send_recording_name(shown_in_viewer(printable(name)))
                yield recording
            except KeyboardInterrupt as stopped:
                interrupted = stopped
    if interrupted:
        raise interrupted


def log_detection(
    recording: rr.RecordingStream,
    detection: Detection,
    truth: Skyline | None = None,
    *,
    name: str = "",
    fidelity: Fidelity = "full",
    under: str = "",
) -> Verdict:
    """Log all stages of a detection.

    Args:
        recording: Where to; its current time, such as ``recording.set_time("image", sequence=3)``,
            holds for everything that is logged.
        detection: The detection.
        truth: The true skyline, to compare with.
        name: Name of the photo, for the report.
        fidelity: How much to keep.
        under: Parent of all entity paths, to keep two detections apart.

    Returns:
        What the detection comes to.

    Raises:
        SkylineError: The truth has another width than the photo.
    """
    at = partial(entities.below, under)
    photo = detection.photo
    height = len(photo)
    near = _near(recording, at, detection, truth) if fidelity == "full" else None
    shown = shown_pixels(detection, truth) if near or fidelity == "lean" else None
    if near and shown is not None:
        shown |= near.mask[detection.edge_rows, detection.edge_columns]
    recording.log(at(entities.PHOTO), _encoded(photo, fidelity))
    if near:
        let_go(recording)  # a large photo is not to wait for maps as large
    count = log_maps(recording, at, detection, shown, near)
    unsure = detection.uncertainty()  # while the maps above are being compressed
    verdict = Verdict.of(detection.skyline, unsure.margins, height, truth)
    if near:
        detour = near.sample(places_of(unsure.detour))
        unsure = replace(unsure, detour=detour.blocks)  # and no map of the whole photo any more
        near.log(recording, at(entities.DETOUR), DETOUR, detour)
    else:
        log_detour(recording, at, detection, unsure.detour, shown)
    log_line(recording, at(entities.PATH), detection.skyline, PATH, dashed=True)
    if truth:
        log_line(recording, at(entities.TRUTH), truth, TRUTH, TRUTH_RADIUS)
    else:
        recording.log(at(entities.TRUTH), rr.Clear(recursive=True))  # an earlier photo's
    log_columns(recording, at, detection, unsure.margins, truth)
    metrics = {one: getattr(verdict, one) for one in ("a_err", "worst_error", "margin")}
    for metric, value in {**metrics, "confidence": detection.confidence}.items():
        if value is not None:
            recording.log(at(f"{entities.METRICS}/{metric}"), rr.Scalars(value))
    for stage, seconds in detection.seconds.items():
        recording.log(at(f"{entities.TIMINGS}/{stage}"), rr.Scalars(1000 * seconds))
    text = report(name, detection, verdict, count, near.said() if near else "")
    recording.log(at(entities.REPORT), markdown_document(text))
    if fidelity != "lean":
        if detection.bank is not None:
            log_filter_bank(recording, detection.bank, under=under)
        if not under:
            contents = Contents.of(detection, fidelity, truth=truth is not None)
            _lay_out(recording, detection_blueprint(contents))
    return verdict


def log_along_columns(
    recording: rr.RecordingStream,
    detection: Detection,
    truth: Skyline | None,
    openings: Mapping[str, int] | None = None,
) -> None:
    """Log what runs along the timeline `entities.COLUMN`, which takes a recording of one photo.

    Whatever is to be seen beside it is logged before, at `entities.OPENING` on that timeline.

    Args:
        recording: Where to.
        detection: The detection.
        truth: The true skyline.
        openings: Where other timelines begin, by name; the pixels that the viewer opens with are
            to be seen on them, too.
    """
    margins = detection.margins()
    errors = column_errors(detection.skyline, truth) if truth else None
    log_pixels(recording, detection, truth, opening_column(errors, margins), openings or {})
    log_series(recording, detection, margins, truth)


def _near(
    recording: rr.RecordingStream,
    at: Callable[[str], str],
    detection: Detection,
    truth: Skyline | None,
) -> Near | None:
    """Log which pixels of a large photo are kept exactly; None where all are."""
    height, width = detection.edges.shape
    if height * width <= FULL_MEGAPIXELS * 1e6:
        return None
    near = Near.to((height, width), detection.skyline, truth)
    recording.log(at(entities.EXACT), encoded_edges(near.mask))
    let_go(recording)  # of what finding the line took, too
    return near


def log_stages(
    recording: rr.RecordingStream,
    photo: U8,
    maps: Mapping[str, npt.NDArray[np.floating] | Bool],
    skyline: Skyline,
    truth: Skyline | None = None,
) -> None:
    """Log the stages of another detector, whatever they are, for the same views.

    Names that `viewer.entities` knows, such as ``"edges"`` or ``"tensor/strength"``, appear
    where ours do; others get a view of their own from `blueprints.stages_blueprint`.

    Args:
        recording: Where to.
        photo: ``(H, W, 3)`` uint8 RGB.
        maps: Name and map of each stage: ``(H, W)``, NaN or False where there is no value.
        skyline: The detected line.
        truth: The true line.

    Raises:
        TypeError: The photo is not a uint8 array.
        ValueError: A map or the photo has another shape.
        SkylineError: A line has another width than the photo.
    """
    check_photo(photo)
    height, width = photo.shape[:2]
    for line in (skyline, truth):
        if line is not None and line.width != width:
            raise SkylineError(f"the photo is {width} columns wide, the skyline {line.width}")
    for stage, values in maps.items():
        if values.shape != (height, width):
            raise ValueError(f"{stage} has the shape {values.shape}, the photo {(height, width)}")
    recording.log(entities.PHOTO, _encoded(photo, "full"))
    for stage, values in maps.items():
        if values.dtype == np.bool_:
            recording.log(stage, encoded_edges(np.asarray(values, np.bool_)))
        else:
            quantity = QUANTITIES.get(stage, Quantity(stage.rsplit("/", 1)[-1]))
            log_exact_map(recording, stage, quantity, values.astype(np.float32))
    log_line(recording, entities.PATH, skyline, PATH)
    if truth:
        log_line(recording, entities.TRUTH, truth, TRUTH, TRUTH_RADIUS)
    _lay_out(recording, stages_blueprint(height, width, maps))


def _lay_out(recording: rr.RecordingStream, layout: rrb.Blueprint) -> None:
    """Give a recording a layout, for whoever has not made one of their own."""
    recording.send_blueprint(layout, make_active=False, make_default=True)


def _encoded(photo: U8, fidelity: Fidelity) -> rr.EncodedImage:
    backwards = cv2.cvtColor(photo, cv2.COLOR_RGB2BGR)
    if fidelity == "lean":
        _, data = cv2.imencode(".jpg", backwards, [cv2.IMWRITE_JPEG_QUALITY, _LEAN_JPEG])
        return rr.EncodedImage(contents=data.tobytes(), media_type="image/jpeg")
    _, data = cv2.imencode(".png", backwards, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    return rr.EncodedImage(contents=data.tobytes(), media_type="image/png")
