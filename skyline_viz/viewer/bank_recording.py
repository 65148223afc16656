"""A filter bank as Rerun entities, and which of its filters each pixel of the path used."""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
import rerun as rr

from skyline_viz.arrays import U8, Int
from skyline_viz.colours import PATH
from skyline_viz.detection import FilterDetection
from skyline_viz.filter_bank import FilterBank
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_pictures import BankPictures, cell_box, draw_bank


def log_filter_bank(recording: rr.RecordingStream, bank: FilterBank, *, under: str = "") -> None:
    """Log the filters as a mosaic and the samples as a heat map, for the whole recording.

    Hovering a cell says which bin it is, what it stands for, and how many samples it has seen.

    Args:
        recording: Where to.
        bank: The filter bank.
        under: Parent of the entity paths.
    """
    pictures = _drawn(bank)
    legend = [
        rr.AnnotationInfo(1 + index, f"{bank.bins.label(index)}: {count:,} samples", _CLEAR)
        for index, count in enumerate(bank.samples.tolist())
    ]
    cells = rr.SegmentationImage(pictures.cells.astype(np.uint16), opacity=1.0)
    for entity, picture in (
        (entities.BANK_FILTERS, pictures.filters),
        (entities.BANK_SAMPLES, pictures.samples),
    ):
        place = entities.below(under, entity)
        recording.log(place, _png(picture), static=True)
        context = rr.AnnotationContext([rr.AnnotationInfo(0, "", _CLEAR), *legend])
        recording.log(f"{place}/cells", context, cells, static=True)


def log_path_bins(recording: rr.RecordingStream, detection: FilterDetection) -> None:
    """Log which bin the path used, column by column, on the timeline `entities.COLUMN`.

    Scrubbing that timeline moves a point along the path, frames its filter in the mosaic, and
    tells what is known about the pixel.
    """
    bins = path_bins(detection)
    width = len(bins)
    times = [rr.TimeColumn(entities.COLUMN, sequence=np.arange(width))]
    rows = detection.skyline.rows
    places = np.column_stack([np.arange(width) + 0.5, rows + 0.5])
    points = rr.Points2D.columns(positions=places, radii=np.full(width, -5.0))
    recording.send_columns(entities.CHOSEN, times, points)
    recording.log(
        entities.CHOSEN, rr.Points2D.from_fields(colors=[PATH], draw_order=50.0), static=True
    )
    on_edge = bins >= 0
    boxes = np.array([cell_box(one, detection.bank.bins) for one in bins[on_edge].tolist()], float)
    boxes = boxes.reshape(-1, 4)
    frames = rr.Boxes2D.columns(
        half_sizes=(boxes[:, 2:] - boxes[:, :2]) / 2 + 2, centers=(boxes[:, 2:] + boxes[:, :2]) / 2
    ).partition(on_edge.astype(np.int64))
    recording.send_columns(entities.BANK_CHOSEN, times, frames)
    recording.log(
        entities.BANK_CHOSEN,
        rr.Boxes2D.from_fields(colors=[PATH], radii=[-2.5], draw_order=50.0),
        static=True,
    )
    words = rr.TextDocument.columns(
        text=[_about(detection, column, one) for column, one in enumerate(bins.tolist())],
        media_type=["text/markdown"] * width,
    )
    recording.send_columns(entities.BANK_USED, times, words)


def path_bins(detection: FilterDetection) -> Int:
    """Bin that the path used in each column, ``(W,)``; -1 where it crosses no edge."""
    width = detection.edges.shape[1]
    rows = detection.skyline.rows.astype(np.intp)
    places = detection.edge_rows.astype(np.intp) * width + detection.edge_columns  # ascending
    wanted = rows * width + np.arange(width)
    found = np.searchsorted(places, wanted).clip(max=max(len(places) - 1, 0))
    on_edge = detection.edges[rows, np.arange(width)]
    bins = np.full(width, -1, np.int32)
    bins[on_edge] = detection.bins[found[on_edge]]
    return bins


_CLEAR = (0, 0, 0, 0)


@lru_cache(maxsize=2)
def _drawn(bank: FilterBank) -> BankPictures:
    """Draw a bank once, however many recordings show it."""
    return draw_bank(bank)


def _about(detection: FilterDetection, column: int, index: int) -> str:
    row = int(detection.skyline.rows[column])
    cost = float(detection.cost[row, column])
    lines = [f"**Column {column}**, row {row}  "]
    if index < 0:
        lines += ["The path crosses no edge here, so no filter was used.  "]
    else:
        bank = detection.bank
        pixel = _edge_pixel(detection, row, column)
        starved = ", **starved**" if bank.starved[index] else ""
        lines += [
            f"{bank.bins.label(index).capitalize()}  ",
            f"{int(bank.samples[index]):,} training samples{starved}  ",
            f"Strength {detection.strength[pixel]:.1f} grey levels/px, "
            f"coherence {detection.coherence[pixel]:.2f}, "
            f"orientation {detection.orientation[pixel]:.0f}°  ",
            f"Score {detection.scores[pixel]:.3f}  ",
        ]
    return "\n".join([*lines, f"Nodal cost {cost:.3f}"])


def _edge_pixel(detection: FilterDetection, row: int, column: int) -> int:
    """Place of an edge pixel in the arrays ``(n,)``, which run row by row."""
    wanted = np.array([row, column], detection.edge_rows.dtype)  # another type copies all of them
    first = int(np.searchsorted(detection.edge_rows, wanted[0]))
    last = int(np.searchsorted(detection.edge_rows, wanted[0], side="right"))
    return first + int(np.searchsorted(detection.edge_columns[first:last], wanted[1]))


def _png(picture: U8) -> rr.EncodedImage:
    _, data = cv2.imencode(".png", cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))
    return rr.EncodedImage(contents=data.tobytes(), media_type="image/png")
