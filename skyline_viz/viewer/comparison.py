"""A second detection beside the first in a recording: its line, its stages, and where they part.

Every map of the second less that of the first is a map of its own, red where the second has more
and blue where the first has. What is alike in both is left black.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import rerun as rr

from skyline_viz.arrays import F32, Bool
from skyline_viz.colours import ALTERNATIVE
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.differences import (
    ALIKE,
    Difference,
    cost_difference,
    differences,
    edge_difference,
    same_terms,
)
from skyline_viz.diagnosis.parting import Parting, parting
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.skyline import Skyline
from skyline_viz.stage import COST, EDGES, SCORE, Quantity
from skyline_viz.system.memory import FULL_MEGAPIXELS
from skyline_viz.system.names import shortened
from skyline_viz.viewer import entities
from skyline_viz.viewer.column_views import ALTERNATIVE_RADIUS, curve, log_line
from skyline_viz.viewer.contents import Fidelity
from skyline_viz.viewer.documents import markdown_document
from skyline_viz.viewer.maps.near import Near
from skyline_viz.viewer.maps.stage_maps import log_whole, shown_pixels
from skyline_viz.viewer.parting_words import markdown
from skyline_viz.viewer.recording import log_detection

_DIFFERENCE = (0xAA, 0x8E, 0x0A)  # the yellow of the second line, as dark as areas need it
_ALONE = ((0x4D, 0xA3, 0xE8), (0xF0, 0x7A, 0x5A))  # edges of the first alone, and of the second
_BOTH = (0x60, 0x60, 0x60)
_MOST = 24  # characters of a name on a map
_USUAL, _FORBIDS = 95.0, 10.0  # percentile of usual costs; how far beyond it others forbid

LEAN = tuple(
    Quantity(one.name, about=one.name.capitalize(), group=f"{entities.APART}/stage")
    for one in (EDGES, COST)
)
"""The maps of what differs in a lean recording, whatever their ranges."""


@dataclass(frozen=True)
class Compared:
    """What a second detection comes to beside the first."""

    verdict: Verdict
    """What it comes to by itself."""

    parting: Parting
    """Where both part."""

    maps: tuple[Quantity, ...]
    """The maps of what differs, under `entities.APART`, also those where nothing does."""

    @property
    def unlike(self) -> tuple[Quantity, ...]:
        """Those maps of which something differs."""
        parted = {(one.kind, one.name) for one in self.parting.parts}
        return tuple(one for one in self.maps if (_kind(one), one.name) in parted)

    @property
    def of_any_photo(self) -> tuple[Quantity, ...]:
        """Those maps of which something may differ on other photos, which have other ranges."""
        stages = (EDGES.name, SCORE.name, COST.name)
        return tuple(
            replace(one, low=None, high=None)
            for one in self.maps
            if _kind(one) == "term" or one.name in stages
        )


def log_comparison(
    recording: rr.RecordingStream,
    detection: Detection,
    other: Detection,
    truth: Skyline | None,
    name: str,
    fidelity: Fidelity = "full",
) -> Compared:
    """Log a second detection of a photo, after the first one has been logged.

    Its line is the yellow one. Its stages have the paths of the first under `entities.OTHER`.

    Args:
        recording: Where to.
        detection: The first detection.
        other: The second one, of the same photo.
        truth: The true skyline.
        name: What to call the photo in the report of the second one.
        fidelity: How much of it to keep; of *lean* the differences of edges and nodal cost alone,
            the latter at the pixels that the maps of one of both show.

    Returns:
        What the second detection comes to.
    """
    verdict = log_detection(
        recording, other, truth, name=name, fidelity=fidelity, under=entities.OTHER
    )
    log_line(recording, entities.ALTERNATIVE, other.skyline, ALTERNATIVE, ALTERNATIVE_RADIUS)
    lower = other.skyline.rows - detection.skyline.rows
    recording.log(entities.DIFFERENCES, curve(lower, _DIFFERENCE))
    found = parting(detection, other, truth)
    recording.log(entities.COMPARISON, markdown_document(markdown(found)))
    maps = _log_differences(recording, detection, other, truth, fidelity)
    return Compared(verdict, found, maps)


def _log_differences(
    recording: rr.RecordingStream,
    first: Detection,
    second: Detection,
    truth: Skyline | None,
    fidelity: Fidelity,
) -> tuple[Quantity, ...]:
    """Log what differs of each map, and return what the maps show."""
    large = first.edges.size > FULL_MEGAPIXELS * 1e6
    near = None
    if large and fidelity == "full":
        near = Near.to(first.edges.shape, first.skyline, second.skyline, truth)
    wanted = differences(first, second)
    if fidelity == "lean":
        wanted = iter((edge_difference(first, second), cost_difference(first, second)))
    maps = []
    for one in wanted:
        if one.values is None:
            continue
        values = one.values
        if fidelity == "lean" and one.name != EDGES.name:
            values = np.where(_shown(first, truth) | _shown(second, truth), values, np.nan)
        quantity = _quantity(one, first, second)
        maps.append(quantity)
        if one.name == EDGES.name:
            _log_edges(recording, first, second)
        else:
            log_whole(recording, partial(entities.below, ""), quantity, _unlike(values), near)
    return tuple(maps)


def _kind(one: Quantity) -> str:
    """Whether a map shows what differs of a stage, or of a term."""
    return one.group.rpartition("/")[2]


def _shown(detection: Detection, truth: Skyline | None) -> Bool:
    """``(H, W)`` pixels that a lean recording of a detection shows."""
    kept = np.flatnonzero(shown_pixels(detection, truth))
    shown = np.zeros(detection.edges.shape, np.bool_)
    shown[detection.edge_rows[kept], detection.edge_columns[kept]] = True
    return shown


def _unlike(values: F32) -> F32:
    """The values that differ; NaN elsewhere."""
    unlike: F32 = np.where(np.abs(values) > ALIKE, values, np.float32(np.nan))
    return unlike


def _quantity(one: Difference, first: Detection, second: Detection) -> Quantity:
    """How a difference is shown: black in the middle of its range is alike."""
    assert one.values is not None
    sizes = np.abs(one.values[np.isfinite(one.values) & (np.abs(one.values) > ALIKE)])
    reach = rounded_up(reach_of(sizes, forbidding=not same_terms(first, second)))
    names = [shortened(found.method, _MOST) for found in (second, first)]
    return Quantity(
        one.name,
        "blue_or_red",
        f" {one.unit}" if one.unit else "",
        low=-reach,
        high=reach,
        about=one.title.capitalize(),
        group=f"{entities.APART}/{one.kind}",
        tabs=("Compare",),
        word=f"{one.title}, {' less '.join(names)}",
    )


def reach_of(sizes: F32, *, forbidding: bool) -> float:
    """How far the colours of a map reach.

    Args:
        sizes: Sizes of the differences.
        forbidding: Whether there may be costs by which other methods forbid single pixels. These
            count as infinite: they take the last colour, and leave the others to the rest.

    >>> sizes = np.array([0.5] * 99 + [2e5], np.float32)
    >>> reach_of(sizes, forbidding=True), reach_of(sizes, forbidding=False)
    (0.5, 200000.0)
    """
    largest = float(sizes.max(initial=0.0))
    if not forbidding or not largest:
        return largest
    usual = float(np.percentile(sizes, _USUAL))
    return usual if largest > _FORBIDS * usual else largest


def rounded_up(value: float) -> float:
    """The end of a range that holds a value: a half of a power of ten, or a multiple of it.

    >>> rounded_up(0.43), rounded_up(3.1), rounded_up(0.0)
    (0.45, 3.5, 1.0)
    """
    if value <= ALIKE:
        return 1.0
    step = 10.0 ** math.floor(math.log10(value)) / 2
    return math.ceil(round(value / step, 6)) * step


def _log_edges(recording: rr.RecordingStream, first: Detection, second: Detection) -> None:
    """Log of whom each edge pixel is."""
    classes = first.edges.astype(np.uint8) + 2 * second.edges.astype(np.uint8)
    alone = [f"edge of {one.method} alone" for one in (first, second)]
    legend = [(0, "", (0, 0, 0, 0)), (1, alone[0], _ALONE[0]), (2, alone[1], _ALONE[1])]
    words = [rr.AnnotationInfo(*one) for one in (*legend, (3, "edge of both", _BOTH))]
    entity = f"{entities.APART}/stage/{EDGES.name}"
    recording.log(entity, rr.AnnotationContext(words), rr.SegmentationImage(classes, opacity=1.0))
