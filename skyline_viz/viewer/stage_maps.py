"""The stages between edges and path as maps, and which pixels of them a lean recording shows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba
import numpy as np
import numpy.typing as npt
import rerun as rr

from skyline_viz.arrays import F32, Bool
from skyline_viz.detection import Detection
from skyline_viz.detector import FilterDetection
from skyline_viz.skyline import Skyline
from skyline_viz.tensor import tensor_map
from skyline_viz.viewer import entities
from skyline_viz.viewer.bank_recording import bin_legend
from skyline_viz.viewer.value_maps import COARSE, FINE, Quantity, dense_map, sparse_map

LEAN_PIXELS = 6
"""Edge pixels of each column whose values a lean recording shows at least; all of them, where a
photo has no more than that on an average."""

STRENGTH = Quantity("strength", "inferno", " grey levels/px", (0.08, 1.0), low=0.0)
COHERENCE = Quantity("coherence", "viridis", low=0.0, high=1.0)
ORIENTATION = Quantity("orientation", "twilight_shifted", "°", low=0.0, high=180.0)
SCORE = Quantity("score", "viridis", low=0.0, high=1.0)
COST = Quantity("nodal cost", "magma_r", span=(0.0, 0.88), contrast=0.5)
DETOUR = Quantity("detour", "magma_r", " dearer than the path", (0.0, 0.88), 0.5, low=0.0)

QUANTITIES = {
    entities.STRENGTH: STRENGTH,
    entities.COHERENCE: COHERENCE,
    entities.ORIENTATION: ORIENTATION,
    entities.SCORE: SCORE,
    entities.COST: COST,
    entities.DETOUR: DETOUR,
}
"""What the map of each stage shows."""


def log_maps(
    recording: rr.RecordingStream,
    at: Callable[[str], str],
    detection: Detection,
    shown: Bool | None,
) -> int:
    """Log tensor, bin, score and cost.

    Args:
        recording: Where to.
        at: Gives the full path of an entity.
        detection: The detection.
        shown: ``(n,)`` which edge pixels to show, see `shown_pixels`; None shows all of them, adds
            tensor and cost of all other pixels, and everything exact, as numbers.

    Returns:
        The number of edge pixels that are shown.
    """
    kept = slice(None) if shown is None else np.flatnonzero(shown)
    rows, columns = detection.edge_rows[kept], detection.edge_columns[kept]
    values: dict[str, F32] = {
        entities.SCORE: detection.scores[kept],
        entities.COST: detection.cost[rows, columns],
    }
    if isinstance(detection, FilterDetection):
        values |= {
            entities.STRENGTH: detection.strength[kept],
            entities.COHERENCE: detection.coherence[kept],
            entities.ORIENTATION: detection.orientation[kept],
        }
    dense: dict[str, F32] = {}
    if shown is None:
        dense = {entities.COST: detection.shown_cost}
        if isinstance(detection, FilterDetection):
            tensor = tensor_map(detection.photo)
            dense |= {
                entities.STRENGTH: tensor.strength,
                entities.COHERENCE: tensor.coherence,
                entities.ORIENTATION: tensor.orientation,
            }
        exact = {entity.rsplit("/", 1)[-1]: one for entity, one in values.items()}
        table: dict[str, Any] = {"edge_row": rows, "edge_column": columns, **exact}
        if isinstance(detection, FilterDetection):
            table["bin"] = detection.bins
        recording.log(at(entities.EDGE_PIXELS), rr.AnyValues(True, **table))
    shape = detection.edges.shape
    levels = FINE if shown is None else COARSE
    for entity, at_edges in values.items():
        if entity in dense:
            log_exact_map(recording, at(entity), QUANTITIES[entity], dense[entity])
        else:
            quantity = QUANTITIES[entity]
            sparse = sparse_map(quantity, shape, rows, columns, at_edges, levels)
            sparse.log(recording, at(entity))
    if isinstance(detection, FilterDetection):
        bin_map = np.zeros(shape, np.uint16)
        bin_map[rows, columns] = detection.bins[kept] + 1
        legend = bin_legend(detection.bank.bins)
        recording.log(at(entities.BIN), legend, rr.SegmentationImage(bin_map))
    for stage, further in detection.maps.items():
        quantity = Quantity(stage)
        dense_map(quantity, further, levels).log(recording, at(entities.map_of(stage)))
    return len(rows)


def log_detour(
    recording: rr.RecordingStream,
    at: Callable[[str], str],
    detection: Detection,
    detour: F32,
    shown: Bool | None,
) -> None:
    """Log how much dearer than the path the cheapest path through each pixel is.

    Takes the arguments of `log_maps`, and the detours ``(H, W)``.
    """
    if shown is None:
        log_exact_map(recording, at(entities.DETOUR), DETOUR, detour)
        return
    kept = np.flatnonzero(shown)
    rows, columns = detection.edge_rows[kept], detection.edge_columns[kept]
    values = detour[rows, columns]
    sparse = sparse_map(DETOUR, detection.edges.shape, rows, columns, values, COARSE)
    sparse.log(recording, at(entities.DETOUR))


def log_exact_map(
    recording: rr.RecordingStream,
    entity: str,
    quantity: Quantity,
    values: npt.NDArray[np.floating],
) -> None:
    """Log a dense map ``(H, W)``, and beside it its exact values, row by row."""
    dense_map(quantity, values, FINE).log(recording, entity)
    recording.log(entity, rr.AnyValues(exact=np.ravel(values)))


def shown_pixels(detection: Detection, truth: Skyline | None) -> Bool:
    """Which edge pixels a lean recording shows, ``(n,)``.

    The `LEAN_PIXELS` cheapest of each column: what the path had to choose from. And those within
    two rows of the path and of the truth, cheap or not.
    """
    width = detection.edges.shape[1]
    shown: Bool = np.ones(len(detection.scores), np.bool_)
    if len(shown) <= LEAN_PIXELS * width:
        return shown
    costs = detection.cost[detection.edge_rows, detection.edge_columns]
    dearest = _kth_cheapest(detection.edge_columns, costs, width, LEAN_PIXELS)
    shown = costs <= dearest[detection.edge_columns]
    for line in (detection.skyline, truth):
        if line is not None:
            shown |= np.abs(line.rows[detection.edge_columns] - detection.edge_rows) <= 2
    return shown


@numba.njit(cache=True, nogil=True)
def _kth_cheapest(columns: npt.NDArray[np.int32], costs: F32, width: int, count: int) -> F32:
    """Cost of the `count`-th cheapest pixel of each column; infinite where there are fewer."""
    cheapest = np.full((width, count), np.inf, np.float32)
    for pixel in range(len(costs)):
        cost = costs[pixel]
        best = cheapest[columns[pixel]]
        if cost < best[-1]:
            place = count - 1
            while place > 0 and best[place - 1] > cost:
                best[place] = best[place - 1]
                place -= 1
            best[place] = cost
    return cheapest[:, -1]
