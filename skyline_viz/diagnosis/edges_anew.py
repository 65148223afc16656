"""Edges found anew around both lines, with other thresholds: what the detector itself would do.

The other counterfactuals give the truth what it lacks. This one gives it nothing: Canny looks
again, in a band around path and truth alone, and what it finds there is judged by the same filters.
"""

from __future__ import annotations

import numpy as np

from skyline_viz.arrays import F32, Bool
from skyline_viz.cost import CostModel, Seen
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detecting.known import looks_of
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.edges import edge_pixels, find_edges
from skyline_viz.evaluation.metrics import scaled

FACTORS = {0.5: "half the", 0.25: "a quarter of the", 2.0: "twice the"}
"""Factors of the Canny thresholds that are tried, and what they are in words."""

ROOM = 6.0
"""Rows above and below both lines that belong to the band, at 519 rows."""


def cost_anew(case: Case, first: int, last: int, factor: float) -> F32 | None:
    """Nodal costs ``(H, W)`` with edges found anew in a band around path and truth.

    Args:
        case: Detection and truth.
        first: First column of the band.
        last: Last one.
        factor: Of the Canny thresholds. With one below 1 edges are added to those that there are,
            with one above 1 those stay that are strong enough.

    Returns:
        The costs; None for methods that have no such thresholds, and where no edge changes.
    """
    detection = case.detection
    if not isinstance(detection, FilterDetection):
        return None
    edges = _edges(detection, _band(case, first, last), factor)
    if (edges == detection.edges).all():
        return None
    return _cost(detection, edges)


def _band(case: Case, first: int, last: int) -> Bool:
    """``(H, W)`` the pixels around both lines in some columns, without those of a frame."""
    height, width = case.detection.edges.shape
    room = round(scaled(ROOM, height))
    part = slice(first, last + 1)
    top = np.minimum(case.path_rows, case.drawn_rows)[part] - room
    bottom = np.maximum(case.path_rows, case.drawn_rows)[part] + room
    at = np.arange(height)[:, None]
    band = np.zeros((height, width), np.bool_)
    band[:, part] = (at >= top) & (at <= bottom)
    if isinstance(case.detection, FilterDetection):
        inside = np.zeros((height, width), np.bool_)
        inside[case.detection.frame.inside(case.detection.photo)] = True
        band &= inside
    return band


def _edges(detection: FilterDetection, band: Bool, factor: float) -> Bool:
    """``(H, W)`` the edges, found anew in a band."""
    edges = detection.edges.copy()
    rows, columns = np.flatnonzero(band.any(axis=1)), np.flatnonzero(band.any(axis=0))
    if not len(rows):
        return edges
    down, across = detection.frame.inside(detection.photo)
    # a few pixels more at each side: gradients and Canny compare neighbours
    part = (
        slice(max(rows[0] - 3, down.start), min(rows[-1] + 4, down.stop)),
        slice(max(columns[0] - 3, across.start), min(columns[-1] + 4, across.stop)),
    )
    low, high = (factor * one for one in detection.thresholds)
    found = find_edges(detection.photo[part], detection.config.edge_source, low, high)
    anew = edges[part] & found if factor > 1 else edges[part] | found
    edges[part] = np.where(band[part], anew, edges[part])
    return edges


def _cost(detection: FilterDetection, edges: Bool) -> F32:
    """``(H, W)`` nodal costs with other edges: those that were there keep what is known of them."""
    pixels = edge_pixels(edges)
    looks = looks_of(detection.photo, pixels, detection.bank, {}, found=detection)
    seen = Seen(
        photo=detection.photo,
        sky=detection.sky,
        edges=edges,
        pixels=pixels,
        strength=looks.tensor.strength,
        scores=looks.scores,
        config=detection.config,
        bank=detection.bank,
    )
    return CostModel.of(seen).total()
