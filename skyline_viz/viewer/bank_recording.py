"""A filter bank as Rerun entities: its filters, and what they have learned from."""

from __future__ import annotations

from functools import lru_cache

import cv2
import rerun as rr

from skyline_viz.arrays import U8
from skyline_viz.filter_bank import FilterBank
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_pictures import BankPictures, draw_bank

_CLEAR = (0, 0, 0, 0)


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
    cells = rr.SegmentationImage(pictures.cells.astype("uint16"), opacity=1.0)
    for entity, picture in (
        (entities.BANK_FILTERS, pictures.filters),
        (entities.BANK_SAMPLES, pictures.samples),
    ):
        place = entities.below(under, entity)
        recording.log(place, _png(picture), static=True)
        context = rr.AnnotationContext([rr.AnnotationInfo(0, "", _CLEAR), *legend])
        recording.log(f"{place}/cells", context, cells, static=True)


@lru_cache(maxsize=2)
def _drawn(bank: FilterBank) -> BankPictures:
    """Draw a bank once, however many recordings show it."""
    return draw_bank(bank)


def _png(picture: U8) -> rr.EncodedImage:
    _, data = cv2.imencode(".png", cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))
    return rr.EncodedImage(contents=data.tobytes(), media_type="image/png")
