"""The detector: a photo through all stages, and everything that they saw on the way."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from time import perf_counter

import numpy as np

from skyline_viz.arrays import F32, F64, U8, Bool, Int, check_photo, read_only
from skyline_viz.config import DetectorConfig
from skyline_viz.cost import add_blocks, edge_cost, nodal_cost, normalised
from skyline_viz.edges import edge_pixels, find_edges, to_grey
from skyline_viz.filter_bank import FilterBank
from skyline_viz.path import shortest_path
from skyline_viz.score import score_at
from skyline_viz.skyline import Skyline
from skyline_viz.tensor import tensor_at
from skyline_viz.terrain import BLOCK, terrain_above
from skyline_viz.uncertainty import Uncertainty, uncertainty

FRAME_SHARE = 0.5
"""A row at the rim of a photo is a picture frame when edges fill more than this share of it."""


@dataclass(frozen=True, eq=False)
class Detection:
    """A skyline and every stage that led to it. Arrays ``(n,)`` run over the edge pixels."""

    photo: U8
    """``(H, W, 3)`` uint8 RGB."""

    skyline: Skyline
    """The detected line."""

    edges: Bool
    """``(H, W)`` edge map."""

    edge_rows: Int
    """``(n,)`` int32 row of each edge pixel."""

    edge_columns: Int
    """``(n,)`` int32 column of each edge pixel."""

    strength: F32
    """``(n,)`` gradient strength, in grey levels a pixel."""

    coherence: F32
    """``(n,)`` coherence, in [0, 1]."""

    orientation: F32
    """``(n,)`` orientation of the gradient, in degrees, in [0, 180)."""

    bins: Int
    """``(n,)`` int32 bin, which is the index of the filter."""

    scores: F32
    """``(n,)`` score, in [0, 1]."""

    cost: F32
    """``(H, W)`` float32 nodal cost."""

    path_cost: float
    """Nodal and link costs along the path."""

    forward: F64
    """``(H, W)`` float64 cost of the cheapest path from the first column to each pixel."""

    thresholds: tuple[float, float]
    """Canny thresholds that were used."""

    seconds: dict[str, float]
    """Seconds of each stage: edges, tensor, bins, score, cost, path."""

    config: DetectorConfig
    """The configuration that was used."""

    bank: FilterBank
    """The filter bank that was used."""

    def __post_init__(self) -> None:
        """Freeze the arrays, all but the caller's own photo."""
        for value in vars(self).values():
            if isinstance(value, np.ndarray) and value is not self.photo:
                read_only(value)

    def uncertainty(self) -> Uncertainty:
        """How sure the path is: margins and detours. Takes one more path search."""
        return uncertainty(self.cost, self.forward, self.config.delta, self.config.link_weight)

    def margins(self) -> F64:
        """How sure each column is, ``(W,)``: see `uncertainty.Uncertainty.margins`."""
        return self.uncertainty().margins

    @property
    def total_seconds(self) -> float:
        """Seconds of all stages."""
        return sum(self.seconds.values())


@dataclass(frozen=True)
class Detector:
    """Finds skylines.

    >>> photo = np.full((40, 60, 3), 200, np.uint8)
    >>> photo[25:] = 60
    >>> set(Detector().detect(photo).skyline.rows.tolist())
    {25.0}
    """

    bank: FilterBank = field(default_factory=FilterBank.default)
    """The filter bank; the shipped one unless given."""

    config: DetectorConfig = field(default_factory=DetectorConfig)
    """The configuration."""

    def detect(self, photo: U8) -> Detection:
        """Find the skyline of a photo.

        A photo without a single edge gets a level line in the middle; its margins are 0.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.

        Raises:
            TypeError: Not a uint8 array.
            ValueError: Another shape.
        """
        check_photo(photo)
        photo = np.ascontiguousarray(photo)
        config, bank = self.config, self.bank
        seconds: dict[str, float] = {}
        with _timed(seconds, "edges"):
            edges, thresholds = candidate_edges(photo, config)
            rows, columns = edge_pixels(edges)
        with _timed(seconds, "tensor"):
            tensor = tensor_at(photo, rows, columns)
        with _timed(seconds, "bins"):
            bins = bank.bins.of(tensor)
        with _timed(seconds, "score"):
            scores = score_at(to_grey(photo), rows, columns, bins, bank.filters)
        with _timed(seconds, "cost"):
            cost = self._cost(photo, edges, tensor.strength, scores)
        with _timed(seconds, "path"):
            path = shortest_path(cost, config.delta, config.link_weight)
        return Detection(
            photo=photo,
            skyline=Skyline(rows=path.rows.astype(np.float32)),
            edges=edges,
            edge_rows=rows,
            edge_columns=columns,
            strength=tensor.strength,
            coherence=tensor.coherence,
            orientation=tensor.orientation,
            bins=bins,
            scores=scores,
            cost=cost,
            path_cost=path.cost,
            forward=path.forward,
            thresholds=thresholds,
            seconds=seconds,
            config=config,
            bank=bank,
        )

    def again(self, found: Detection) -> Detection:
        """Find the skyline of a detection's photo, as `detect` does.

        The stages on which this detector and that of the detection agree are not computed anew:
        their arrays are the very ones of the detection, and take no time.

        Args:
            found: What another detector, or this one, found.
        """
        config, bank = self.config, self.bank
        bins_agree = bank.bins == found.bank.bins
        if not bins_agree or _edge_settings(config) != _edge_settings(found.config):
            return self.detect(found.photo)
        seconds = dict.fromkeys(found.seconds, 0.0)
        scores, cost = found.scores, found.cost
        if bank is not found.bank:
            with _timed(seconds, "score"):
                grey = to_grey(found.photo)
                rows, columns = found.edge_rows, found.edge_columns
                scores = score_at(grey, rows, columns, found.bins, bank.filters)
        alike = replace(config, delta=found.config.delta, link_weight=found.config.link_weight)
        if bank is not found.bank or alike != found.config:
            with _timed(seconds, "cost"):
                cost = self._cost(found.photo, found.edges, found.strength, scores)
        with _timed(seconds, "path"):
            path = shortest_path(cost, config.delta, config.link_weight)
        return replace(
            found,
            skyline=Skyline(rows=path.rows.astype(np.float32)),
            scores=scores,
            cost=cost,
            path_cost=path.cost,
            forward=path.forward,
            seconds=seconds,
            config=config,
            bank=bank,
        )

    def _cost(self, photo: U8, edges: Bool, strength: F32, scores: F32) -> F32:
        """Nodal cost ``(H, W)`` from the gradient strengths and scores ``(n,)`` of the edges."""
        config = self.config
        strength = normalised(strength, config.strength_percentile)
        at_edges = edge_cost(scores, strength, config.v)
        cost = nodal_cost(edges, at_edges, config.non_edge_cost, config.clear_sky)
        if config.terrain_weight and len(scores):  # without edges, every line is a guess
            above = terrain_above(photo, edges, self.bank.terrain)
            add_blocks(cost, above, config.terrain_weight, BLOCK)
        return cost


def candidate_edges(photo: U8, config: DetectorConfig) -> tuple[Bool, tuple[float, float]]:
    """Edge map ``(H, W)`` of a photo without its frame, and the Canny thresholds that made it."""
    edges, thresholds = find_edges(
        photo,
        config.edge_source,
        config.low_threshold,
        config.high_threshold,
        fit=config.fit_thresholds,
    )
    height = len(edges)
    for row in {*range(config.frame), *range(height - config.frame, height)} & set(range(height)):
        if edges[row].mean() > FRAME_SHARE:
            edges[row] = False
    return edges, thresholds


def _edge_settings(config: DetectorConfig) -> tuple[object, ...]:
    """What `candidate_edges` depends on."""
    thresholds = (config.low_threshold, config.high_threshold, config.fit_thresholds)
    return (config.edge_source, *thresholds, config.frame)


@contextmanager
def _timed(seconds: dict[str, float], stage: str) -> Iterator[None]:
    start = perf_counter()
    yield
    seconds[stage] = perf_counter() - start
