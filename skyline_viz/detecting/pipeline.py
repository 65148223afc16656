"""All stages one after the other, from the photo to the path.

Each is made anew only where nothing of another detection of the photo holds for it, see `known`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F32, U8, Bool, Int
from skyline_viz.config import DetectorConfig
from skyline_viz.cost import CostModel, Seen
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detecting.known import (
    Looks,
    cost_alike,
    edges_alike,
    full_strengths,
    looks_again,
    looks_of,
    path_alike,
)
from skyline_viz.detection import timed
from skyline_viz.edges import candidate_edges, edge_pixels, frame_of
from skyline_viz.filter_bank import FilterBank
from skyline_viz.frames.frame import Frame, around_frame
from skyline_viz.kernels.planes import padded_planes
from skyline_viz.path import Path, shortest_path
from skyline_viz.sky_model import SkyModel

STAGES = ("sky", "edges", "tensor", "bins", "score", "cost", "path")
"""The stages whose seconds are told, in their order."""


@dataclass(frozen=True, eq=False)
class Stages:
    """What the stages have made of a photo; see `FilterDetection` for each."""

    frame: Frame
    sky: F32 | None
    edges: Bool
    thresholds: tuple[float, float]
    pixels: tuple[Int, Int]
    """Rows and columns of the edge pixels."""

    looks: Looks
    """What these look like."""

    cost_model: CostModel
    cost: F32
    path: Path
    seconds: dict[str, float]


def run_stages(
    photo: U8,
    bank: FilterBank,
    config: DetectorConfig,
    model: SkyModel,
    found: FilterDetection | None = None,
) -> Stages:
    """Find the cheapest path.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        bank: The filter bank.
        config: The settings.
        model: The sky model, which is asked unless its weight is 0.
        found: Another detection of this photo, if there is one.
    """
    seconds = dict.fromkeys(STAGES if config.sky_weight else STAGES[1:], 0.0)
    if found and found.config.frame == config.frame:
        frame = found.frame
    else:
        with timed(seconds, "edges"):
            frame = frame_of(photo, config)
    sky = _sky(photo, config, model, frame, seconds, found)
    if found and bank.bins != found.bank.bins:
        found = None
    planes = None
    if found and edges_alike(config, frame, sky, found):
        edges, thresholds = found.edges, found.thresholds
    else:
        with timed(seconds, "edges"):
            planes = padded_planes(photo)
            edges, thresholds = candidate_edges(photo, config, frame, sky, planes)
    if found and (edges is found.edges or np.array_equal(edges, found.edges)):
        edges, pixels = found.edges, (found.edge_rows, found.edge_columns)
        looks = looks_again(found, bank, seconds)
    else:
        with timed(seconds, "edges"):
            pixels = edge_pixels(edges)
        looks = looks_of(photo, pixels, bank, seconds, planes, found)
    del planes  # as large as the photo
    if found and cost_alike(config, sky, looks, found):
        cost_model, cost = found.cost_model.searched(config), found.cost
    else:
        seen = Seen(
            photo=photo,
            sky=sky,
            edges=edges,
            pixels=pixels,
            strength=looks.tensor.strength,
            full=full_strengths(config, looks, found),
            scores=looks.scores,
            config=config,
            bank=bank,
        )
        with timed(seconds, "cost"):
            cost_model = CostModel.of(seen)
            cost = cost_model.total()
    if found and cost is found.cost and path_alike(config, found):
        path = Path(found.skyline.rows.astype(np.int32), found.path_cost)
    else:
        with timed(seconds, "path"):
            path = shortest_path(cost, config.delta, config.link_weight)
    return Stages(frame, sky, edges, thresholds, pixels, looks, cost_model, cost, path, seconds)


def _sky(
    photo: U8,
    config: DetectorConfig,
    model: SkyModel,
    frame: Frame,
    seconds: dict[str, float],
    found: FilterDetection | None,
) -> F32 | None:
    """The map of the sky model, that of a detection if it is the same; None if switched off."""
    if not config.sky_weight:
        return None
    same = found and found.frame == frame and found.detector.sky == model
    if found and same and found.sky is not None:
        return found.sky
    with timed(seconds, "sky"):
        return sky_inside(model, photo, frame)


def sky_inside(model: SkyModel, photo: U8, frame: Frame) -> F32:
    """``(h, w)`` the map of a sky model, which sees the picture inside a frame alone.

    Args:
        model: The model.
        photo: ``(H, W, 3)`` uint8 RGB.
        frame: Its frame.
    """
    inside = np.ascontiguousarray(photo[frame.inside(photo)])
    return around_frame(model.sky(inside), frame, *photo.shape[:2])
