"""What another detection of the same photo knows already, and what of it still holds.

Settings are tried by the dozen, and most change a late stage alone, or nothing at all in a photo:
where no frame is found, it does not matter whether one is looked for. Tensor, bin and score of a
pixel depend on the photo around it, and not on which other pixels are edges. So with other edges
they are worked out for those pixels alone that are new.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TypeVar

import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Int
from skyline_viz.config import DetectorConfig
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detection import timed
from skyline_viz.edges import EDGE_SETTINGS, to_grey
from skyline_viz.filter_bank import FilterBank
from skyline_viz.frames.frame import Frame
from skyline_viz.score import score_at
from skyline_viz.tensor import Tensor, tensor_at
from skyline_viz.terms import EdgeTerm, Places

Values = TypeVar("Values", F32, Int)

_EDGES = {*EDGE_SETTINGS, "sky_edges"}
_CANNY = _EDGES - {"frame", "sky_edges"}  # whose outcome is compared instead
_PATH = {"delta", "link_weight"}


@dataclass(frozen=True, eq=False)
class Looks:
    """What edge pixels look like."""

    tensor: Tensor
    """Their structure tensor, each array ``(n,)``."""

    bins: Int
    """``(n,)`` int32 bin."""

    scores: F32
    """``(n,)`` score, in [0, 1]."""


def looks_of(
    photo: U8,
    pixels: tuple[Int, Int],
    bank: FilterBank,
    seconds: dict[str, float],
    planes: U8 | None = None,
    found: FilterDetection | None = None,
) -> Looks:
    """Stages 2 to 4 of some edge pixels: tensor, bins and score.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        pixels: ``(n,)`` int32 rows and columns of the edge pixels, row by row.
        bank: The filter bank.
        seconds: Seconds of the stages, to which is added.
        planes: The photo's `padded_planes`, where they are there already.
        found: Another detection of the photo, which knows its own pixels if it has the same bank.
    """
    rows, columns = pixels
    places = None
    if found is not None and found.bank is bank and len(found.scores):
        with timed(seconds, "tensor"):
            places = places_among(pixels, (found.edge_rows, found.edge_columns))
            new = np.flatnonzero(places < 0)
            rows, columns = rows[new], columns[new]
    with timed(seconds, "tensor"):
        tensor = tensor_at(photo, rows, columns, planes)
    with timed(seconds, "bins"):
        bins = bank.bins.of(tensor)
    with timed(seconds, "score"):
        scores = score_at(to_grey(photo), rows, columns, bins, bank.filters)
    if found is None or places is None:
        return Looks(tensor, bins, scores)
    with timed(seconds, "tensor"):
        tensor = Tensor(
            _joined(found.strength, tensor.strength, places, new),
            _joined(found.coherence, tensor.coherence, places, new),
            _joined(found.orientation, tensor.orientation, places, new),
        )
        bins = _joined(found.bins, bins, places, new)
        scores = _joined(found.scores, scores, places, new)
    return Looks(tensor, bins, scores)


def looks_again(found: FilterDetection, bank: FilterBank, seconds: dict[str, float]) -> Looks:
    """Stages 2 to 4 where the edges are those of a detection, by a bank with the same bins.

    Args:
        found: The detection.
        bank: The filter bank.
        seconds: Seconds of the stages, to which is added.
    """
    tensor, scores = Tensor(found.strength, found.coherence, found.orientation), found.scores
    if bank is not found.bank:
        pixels = found.edge_rows, found.edge_columns
        with timed(seconds, "score"):
            scores = score_at(to_grey(found.photo), *pixels, found.bins, bank.filters)
    return Looks(tensor, found.bins, scores)


def _joined(known: Values, made: Values, places: Places, new: Places) -> Values:
    """Values ``(n,)`` of all pixels: those that are known in their places, and the new ones."""
    values: Values = known[places]
    values[new] = made
    return values


def places_among(pixels: tuple[Int, Int], known: tuple[Int, Int]) -> Places:
    """Place of each pixel among others, ``(n,)``; -1 where it is none of them.

    Args:
        pixels: ``(n,)`` int32 rows and columns, row by row.
        known: ``(m,)`` those of the others, likewise.

    Examples:
        >>> some, others = np.divmod(np.int32([3, 5, 12]), 10), np.divmod(np.int32([3, 12, 20]), 10)
        >>> places_among(some, others)
        array([ 0, -1,  1])
    """
    places = np.empty(len(pixels[0]), np.int64)
    _find_places(*pixels, *known, places)
    return places


@numba.njit(cache=True, nogil=True)
def _find_places(rows: Int, columns: Int, known_rows: Int, known_columns: Int, places: Int) -> None:
    """Fill in `places_among`: both lists are walked through side by side."""
    at, count = 0, len(known_rows)
    for pixel in range(len(rows)):
        row, column = rows[pixel], columns[pixel]
        while at < count and (
            known_rows[at] < row or (known_rows[at] == row and known_columns[at] < column)
        ):
            at += 1
        there = at < count and known_rows[at] == row and known_columns[at] == column
        places[pixel] = at if there else -1


def edges_alike(
    config: DetectorConfig, frame: Frame, sky: F32 | None, found: FilterDetection
) -> bool:
    """Whether all that edges depend on is that of a detection.

    Args:
        config: The settings.
        frame: The frame of the photo.
        sky: The map of the sky model, if it was asked.
        found: The detection.
    """
    ours = 1.0 if sky is None else config.sky_edges
    theirs = 1.0 if found.sky is None else found.config.sky_edges
    sought = ours == theirs and (ours == 1 or sky is found.sky)
    return sought and frame == found.frame and not _differing(config, found) & _CANNY


def cost_alike(
    config: DetectorConfig, sky: F32 | None, looks: Looks, found: FilterDetection
) -> bool:
    """Whether all that nodal costs depend on is that of a detection."""
    seen = looks.scores is found.scores and sky is found.sky
    return seen and _differing(config, found) <= _EDGES | _PATH


def path_alike(config: DetectorConfig, found: FilterDetection) -> bool:
    """Whether the path through the same costs is that of a detection."""
    return not _differing(config, found) & _PATH


def full_strengths(
    config: DetectorConfig, looks: Looks, found: FilterDetection | None
) -> F32 | None:
    """``(n,)`` strengths as `cost.normalised` makes them, if a detection has them; else None."""
    if found is None or looks.tensor.strength is not found.strength:
        return None
    term = found.cost_model["strength"]
    same = config.strength_percentile == found.config.strength_percentile
    return term.good if same and isinstance(term, EdgeTerm) else None


def _differing(config: DetectorConfig, found: FilterDetection) -> set[str]:
    """Names of the settings that are not those of a detection."""
    theirs = found.config
    if type(config) is not type(theirs):
        return {one.name for one in fields(config)}
    names = [one.name for one in fields(config)]
    return {name for name in names if getattr(config, name) != getattr(theirs, name)}
