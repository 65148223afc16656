"""The stages up to the path as maps, and which pixels of them a lean recording shows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import cv2
import numba
import numpy as np
import numpy.typing as npt
import rerun as rr

from skyline_viz.arrays import F32, Bool, Int
from skyline_viz.certainty.search_tables import search_tables
from skyline_viz.colours import Colour
from skyline_viz.detection import Detection
from skyline_viz.skyline import Skyline
from skyline_viz.stage import (
    ADDED,
    BACK,
    BIN,
    DETOUR,
    FORWARD,
    FUSED,
    LINK,
    ORIENTATION,
    OURS,
    STRENGTH,
    Quantity,
    Stage,
    of_term,
)
from skyline_viz.terms import Term
from skyline_viz.viewer import entities
from skyline_viz.viewer.maps.map_aids import log_broad, log_broad_edges, log_fade, log_scale
from skyline_viz.viewer.maps.near import Near, Sampled, Sampler, let_go
from skyline_viz.viewer.maps.value_maps import (
    BANDS,
    COARSE,
    FINE,
    ValueMap,
    dense_map,
    image_of,
    shades,
    sparse_map,
    value_range,
)

_RLE = cv2.IMWRITE_PNG_STRATEGY_RLE

LEAN_PIXELS = 6
"""Edge pixels of each column whose values a lean recording shows at least; all of them, where a
photo has no more than that on an average."""

QUANTITIES = {entities.of_quantity(one): one for one in (*OURS, DETOUR)}
"""What the map of each stage of our detector shows."""


def log_maps(
    recording: rr.RecordingStream,
    at: Callable[[str], str],
    detection: Detection,
    shown: Bool | None,
    near: Near | None = None,
) -> int:
    """Log all stages of a detection that are maps, whatever they are.

    Args:
        recording: Where to.
        at: Gives the full path of an entity.
        detection: The detection.
        shown: ``(n,)`` which edge pixels to show, see `shown_pixels`; None shows all of them, adds
            tensor and cost of all other pixels, the terms of the cost, and everything exact, as
            numbers.
        near: Where these are kept exactly of a large photo, see `Near`; None keeps them everywhere
            or, if lean, nowhere.

    Returns:
        The number of edge pixels that are shown.
    """
    kept: npt.NDArray[np.intp] | slice = slice(None) if shown is None else np.flatnonzero(shown)
    rows, columns = detection.edge_rows[kept], detection.edge_columns[kept]
    shape, full = detection.edges.shape, shown is None or near is not None
    table: dict[str, Any] = {"edge_row": rows, "edge_column": columns}
    stages = dict(detection.stages)
    for name in tuple(stages):
        stage = stages.pop(name)  # its map may be as large as the photo, and is let go of
        if stage.quantity == FUSED and not full:
            continue  # the cost has it in it
        entity = at(entities.of_quantity(stage.quantity))
        if stage.where == "mask":
            edges = np.asarray(stage.values, np.bool_)
            recording.log(entity, encoded_edges(edges))
            log_broad_edges(recording, entity, edges)
        elif near and (stage.where == "photo" or stage.dense):
            quantity, sampled = stage.quantity, near.sample(_sampler(stage))
            if not quantity.smooth:
                values = stage.values if stage.where == "edges" else stage.values[rows, columns]
                table[name] = values[kept] if stage.where == "edges" else values
            del stage
            near.log(recording, entity, quantity, sampled)
            if quantity == STRENGTH:
                _log_fade(recording, at(entities.ORIENTATION), near.map(quantity, sampled, COARSE))
                let_go(recording)
        elif stage.where == "photo" and stage.quantity.smooth:  # whole even if lean
            levels = FINE if shown is None else BANDS
            dense_map(stage.quantity, stage.values, levels).log(recording, entity)
        elif stage.where in ("edges", "photo"):
            values = stage.values[kept] if stage.where == "edges" else stage.values[rows, columns]
            table[name] = values
            dense = _log_stage(recording, entity, stage, values, (shape, rows, columns), exact=full)
            if dense is not None and stage.quantity == STRENGTH:
                veil = dense_map(STRENGTH, dense, COARSE)
                _log_fade(recording, at(entities.ORIENTATION), veil)
            if near:
                let_go(recording)
    if full:
        recording.log(at(entities.EDGE_PIXELS), rr.AnyValues(True, **table))
        log_terms(recording, at, detection, near)
        log_search(recording, at, detection, near)
    return len(rows)


def _sampler(stage: Stage) -> Sampler:
    """What gives the values of a stage at some pixels."""
    if stage.at:
        return stage.at
    whole = stage.map()
    assert whole is not None
    return places_of(whole)


def _log_stage(
    recording: rr.RecordingStream,
    entity: str,
    stage: Stage,
    values: npt.NDArray[Any],
    places: tuple[tuple[int, ...], Int, Int],
    *,
    exact: bool,
) -> npt.NDArray[Any] | None:
    """Log a stage with its values at some edge pixels; if exact also of all others it has.

    Returns:
        The values of all pixels, if it has them.
    """
    shape, rows, columns = places
    if stage.legend:
        # broadened before the map is there, which may be large
        colours, index = np.unique([one for _, one in stage.legend], axis=0, return_inverse=True)
        shades_of = np.zeros(shape, np.uint8)
        shades_of[rows, columns] = (1 + np.ravel(index).astype(np.uint8))[values]
        log_broad(recording, entity, shades_of, colours.astype(np.uint8))
        del shades_of
        classes = np.zeros(shape, np.uint16)
        classes[rows, columns] = values + 1
        recording.log(entity, _words(stage.legend), image_of(classes))
        if stage.quantity == BIN:
            hues = shades(ORIENTATION, COARSE)
            log_scale(recording, entity, shape, hues, value_range(ORIENTATION))
        return None
    dense = stage.map() if exact else None
    if dense is not None:
        log_exact_map(recording, entity, stage.quantity, dense)
        return dense
    height, width = shape
    levels = FINE if exact else COARSE
    sparse = sparse_map(stage.quantity, (height, width), rows, columns, values, levels)
    sparse.log(recording, entity)
    return None


def _log_fade(recording: rr.RecordingStream, entity: str, strength: ValueMap) -> None:
    """Fade the map of orientations where the gradient is weak."""
    steps = np.linspace(strength.low, strength.high, strength.levels)
    log_fade(recording, entity, strength.classes, np.concatenate([[strength.high], steps]))


def log_terms(
    recording: rr.RecordingStream,
    at: Callable[[str], str],
    detection: Detection,
    near: Near | None = None,
) -> None:
    """Log what each pixel pays for each term of the nodal cost, and for our own together.

    Of a term that edge pixels alone can pay nothing is shown elsewhere.
    """
    none, edges = np.float32(np.nan), kept_of(detection.edges, near)
    added: F32 | Sampled | None = None
    for term in shown_terms(detection):
        paid = kept_of(term.map(), near)
        if term.paid_by == "all":
            added = paid if added is None else each(np.add, added, paid)
        if term.paid_by == "edges":
            paid = each(lambda costs, is_edge: np.where(is_edge, costs, none), paid, edges)
        log_whole(recording, at, of_term(term.name), paid, near)
        del paid
    if added is not None:
        log_whole(recording, at, ADDED, added, near)


def log_search(
    recording: rr.RecordingStream,
    at: Callable[[str], str],
    detection: Detection,
    near: Near | None = None,
) -> None:
    """Log what the search for the path has found at each pixel, see `SEARCH`."""
    tables = search_tables(detection.cost, detection.delta, detection.link_weight)
    back = kept_of(tables.back, near)
    above = kept_of(tables.above, near)
    reach = max(-int(tables.back.min()), int(tables.back.max()), 1)
    del tables
    log_whole(recording, at, FORWARD, above, near)
    del above
    rows = each(lambda steps: steps.astype(np.float32), back)
    log_whole(recording, at, replace(BACK, low=-reach, high=reach), rows, near)
    weight = np.float32(detection.link_weight)
    log_whole(recording, at, LINK, each(lambda steps: np.abs(steps) * weight, rows), near)


def log_whole(
    recording: rr.RecordingStream,
    at: Callable[[str], str],
    quantity: Quantity,
    values: F32 | Sampled,
    near: Near | None,
) -> None:
    """Log a map ``(H, W)``, of a large photo only as much as is kept of it.

    Args:
        recording: Where to.
        at: Gives the full path of an entity.
        quantity: What the values are.
        values: ``(H, W)``, or what is kept of it; NaN is none.
        near: What is kept exactly of a large photo.
    """
    entity = at(entities.of_quantity(quantity))
    kept: Any = values if isinstance(values, Sampled) else kept_of(values, near)
    if near:
        near.map(quantity, kept, COARSE).log(recording, entity)
        let_go(recording)
    else:
        dense_map(quantity, kept, COARSE).log(recording, entity)


def kept_of(whole: npt.NDArray[Any], near: Near | None) -> Any:  # noqa: ANN401
    """A map ``(H, W)`` itself, or what is kept of it if it is that of a large photo."""
    return near.sample(places_of(whole)) if near else whole


def each(how: Callable[..., npt.NDArray[Any]], *maps: Any) -> Any:  # noqa: ANN401
    """What becomes of maps of a photo, whether they are whole or what is kept of them."""
    if isinstance(maps[0], Sampled):
        blocks = how(*(one.blocks for one in maps))
        return Sampled(blocks, how(*(one.exact for one in maps)))
    return how(*maps)


def places_of(whole: npt.NDArray[np.floating[Any]]) -> Sampler:
    """What gives the values of a map at some pixels."""
    return lambda rows, columns: whole[rows, columns]


SEARCH = (DETOUR, FORWARD, BACK, LINK)
"""What the search for the path knows of each pixel: the min-marginals, which are logged with their
exact values, the forward table, from where the way to it comes, and what that step costs."""


def shown_terms(detection: Detection) -> list[Term]:
    """The terms of the nodal cost that are not switched off, and that any pixel pays."""
    nobody = "others" if detection.edges.all() else ""
    nodal = detection.cost_model.nodal
    return [term for term in nodal if term.weight and term.paid_by != nobody]


def encoded_edges(edges: Bool) -> rr.EncodedImage:
    """Edge map ``(H, W)`` in white on black, one bit a pixel: a quarter of any other encoding."""
    white = edges.astype(np.uint8) * np.uint8(255)
    how = [cv2.IMWRITE_PNG_BILEVEL, 1, cv2.IMWRITE_PNG_COMPRESSION, 1]
    _, data = cv2.imencode(".png", white, [*how, cv2.IMWRITE_PNG_STRATEGY, _RLE])
    return rr.EncodedImage(contents=data.tobytes(), media_type="image/png")


@lru_cache(maxsize=4)
def _words(legend: tuple[tuple[str, Colour], ...]) -> rr.AnnotationContext:
    """Words and colour of each class; class 0 is no value."""
    named = [rr.AnnotationInfo(1 + at, words, colour) for at, (words, colour) in enumerate(legend)]
    return rr.AnnotationContext([rr.AnnotationInfo(0, "", (0, 0, 0, 0)), *named])


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
    sparse.log(recording, at(entities.DETOUR), aids=False)  # no tab of a lean recording shows it


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
