"""What a method found: a skyline, the candidate pixels that it chose from, and what they cost."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from time import perf_counter
from types import MappingProxyType

import numpy as np

from skyline_viz.arrays import F32, F64, U8, Bool, Int, read_only
from skyline_viz.certainty.confidence import Confidence, confidence
from skyline_viz.certainty.uncertainty import Uncertainty, uncertainty
from skyline_viz.config import DetectorConfig
from skyline_viz.cost import CostModel
from skyline_viz.edges import edge_pixels
from skyline_viz.filter_bank import FilterBank
from skyline_viz.frames.visibility import Visibility
from skyline_viz.path import forward_costs, shortest_path
from skyline_viz.sky_model import SkyModel
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.stage import (
    COST,
    EDGES,
    PATH,
    SCORE,
    Quantity,
    Stage,
)
from skyline_viz.terms import Link

_STEEPEST = 1 / 12  # change of row between neighbouring columns, as a share of the height


@dataclass(frozen=True, eq=False, kw_only=True)
class Detection:
    """A skyline and what led to it, whatever the method.

    Arrays ``(n,)`` run over the edge pixels: the pixels that a method takes for candidates, which
    are all pixels of the photo where it looks for no edges. A score says how much a pixel looks
    like skyline; an edge pixel costs ``score_weight (1 - score)``, and whatever else the method
    adds: `cost_model` knows. Whoever shows a detection loops over `stages`.
    """

    method: str
    """Name of the method."""

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

    scores: F32
    """``(n,)`` score, in [0, 1]."""

    cost: F32
    """``(H, W)`` float32 nodal cost."""

    path_cost: float
    """Nodal and link costs along the path."""

    seconds: dict[str, float]
    """Seconds of each stage."""

    cost_model: CostModel
    """What pixels and lines pay, and for what."""

    config: DetectorConfig | None = None
    """The configuration that was used; None of methods that have other settings."""

    bank: FilterBank | None = None
    """The filter bank that was used; None of methods without one."""

    thresholds: tuple[float, float] | None = None
    """Canny thresholds that were used; None of methods without, or with fixed ones."""

    visibility: Visibility | None = None
    """Where the line can be seen, if it is a skyline; None of methods that cannot tell."""

    maps: Mapping[str, F32] = field(default_factory=lambda: MappingProxyType({}))
    """Further maps ``(H, W)`` that the method made, by name: its own stages."""

    def __post_init__(self) -> None:
        """Freeze the arrays, all but the caller's own photo."""
        for value in (*vars(self).values(), *self.maps.values()):
            if isinstance(value, np.ndarray) and value is not self.photo:
                read_only(value)

    @cached_property
    def starved(self) -> Bool:
        """``(n,)`` edge pixels whose score was learned from too little."""
        return np.zeros(len(self.scores), np.bool_)

    @cached_property
    def forward(self) -> F64:
        """``(H, W)`` float64 cost of the cheapest path from the first column to each pixel."""
        return forward_costs(self.cost, self.delta, self.link_weight)

    @cached_property
    def certainty(self) -> Confidence:
        """How surely the line is the skyline, and what speaks against it.

        A method without a sky model asks the small one.
        """
        link, shown = self.cost_model.link, self._shown()
        rows = self.skyline.rows
        return confidence(self._sky_asked(), rows, shown, self.cost, link.delta, link.weight)

    def _sky_asked(self) -> F32:
        """``(h, w)`` what a sky model says of the photo."""
        return SkyModel.small().sky(self.photo)

    def _shown(self) -> Bool:
        """``(W,)`` columns of the picture."""
        return np.ones(self.photo.shape[1], np.bool_)

    @property
    def confidence(self) -> float:
        """Probability that the line is no gross miss, in [0, 1], see `certainty`."""
        return self.certainty.value

    @property
    def delta(self) -> int:
        """Largest change of row between neighbouring columns, in pixels."""
        return self.cost_model.link.delta

    @property
    def link_weight(self) -> float:
        """Link cost of one pixel of row change."""
        return self.cost_model.link.weight

    @property
    def score_weight(self) -> float:
        """What a score of 0 costs more than one of 1."""
        return self.cost_model["score"].weight

    @property
    def non_edge_cost(self) -> float:
        """Nodal cost of a pixel without an edge."""
        return self.cost_model["no edge"].weight

    @property
    def stages(self) -> Mapping[str, Stage]:
        """The stages by name, in the order in which they were made; read-only."""
        return MappingProxyType({one.name: one for one in self._stages()})

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """What the stages hold, in their order, without any of their maps being made."""
        return tuple(one.quantity for one in self._stages())

    def _stages(self) -> Iterator[Stage]:
        yield Stage(EDGES, self.edges, "mask")
        yield Stage(SCORE, self.scores, "edges")
        for name, values in self.maps.items():
            yield Stage(Quantity(name, group="maps", smooth=True), values, "photo")
        yield from self._last_stages()

    def _last_stages(self) -> Iterator[Stage]:
        yield Stage(COST, self.cost, "photo", dense=partial(self.cost_model.shown, self.cost))
        yield Stage(PATH, self.skyline.rows, "columns")

    def __repr__(self) -> str:
        """One line, as a console shows it."""
        height, width = self.edges.shape
        return (
            f"{type(self).__name__}(method={self.method!r}, photo of {width} x {height} pixels, "
            f"{len(self.scores):,} edge pixels, path cost {self.path_cost:.6g})"
        )

    def again(self, config: DetectorConfig) -> Detection:
        """Find the skyline of the same photo with other settings, see `Detector.again`.

        Raises:
            ValueError: The method has other settings than ours.
        """
        raise ValueError(f"{self.method} has other settings than {type(config).__name__}.")

    def about(self) -> list[str]:
        """How it was made, in short sentences."""
        return [f"Method {self.method}."]

    def uncertainty(self) -> Uncertainty:
        """How sure the path is: margins and detours. Takes two more path searches."""
        return uncertainty(self.cost, self.delta, self.link_weight)

    def margins(self) -> F64:
        """How sure each column is, ``(W,)``: see `uncertainty.Uncertainty.margins`."""
        return self.uncertainty().margins

    @property
    def total_seconds(self) -> float:
        """Seconds of all stages."""
        return sum(self.seconds.values())

    @classmethod
    def of_line(
        cls, photo: U8, skyline: Skyline, *, method: str, seconds: dict[str, float] | None = None
    ) -> Detection:
        """A detection of which only the line is known.

        It is that of a method for which every pixel is a candidate, and costs its distance from
        the line over the height of the photo. So the line is the cheapest path, and its margins
        say nothing.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.
            skyline: The line.
            method: Name of the method.
            seconds: Seconds of the stages that led to it.

        Raises:
            SkylineError: The line has another width than the photo.
        """
        height, width = photo.shape[:2]
        if skyline.width != width:
            raise SkylineError(f"the photo is {width} columns wide, the skyline {skyline.width}")
        line = skyline.pixel_rows(height).clip(0, height - 1)
        away = np.abs(np.arange(height)[:, None] - line[None, :])
        cost = (away / height).astype(np.float32)
        found = solve_detection(
            method,
            photo,
            np.ones(cost.shape, np.bool_),
            (1 - cost).ravel(),
            cost,
            dict(seconds or {}),
            delta=max(int(np.abs(np.diff(line)).max(initial=0)), round(height * _STEEPEST), 1),
            link_weight=0.0,
            non_edge_cost=1.0,
        )
        return replace(found, skyline=skyline)


def solve_detection(
    method: str,
    photo: U8,
    edges: Bool,
    scores: F32,
    cost: F32,
    seconds: dict[str, float],
    *,
    delta: int,
    link_weight: float,
    non_edge_cost: float,
    score_weight: float = 1.0,
    maps: Mapping[str, F32] | None = None,
) -> Detection:
    """Search the cheapest path through nodal costs, and put a detection together.

    Args:
        method: Name of the method.
        photo: ``(H, W, 3)`` uint8 RGB.
        edges: ``(H, W)`` candidate pixels.
        scores: ``(n,)`` their scores, row by row, in [0, 1].
        cost: ``(H, W)`` nodal cost of every pixel.
        seconds: Seconds of the stages so far; that of the path is added.
        delta: Largest change of row between neighbouring columns, in pixels.
        link_weight: Link cost of one pixel of row change.
        non_edge_cost: Nodal cost of a pixel that is no candidate.
        score_weight: What a score of 0 costs more than one of 1.
        maps: Further maps ``(H, W)`` to show, by name.

    Raises:
        ValueError: A map is called like a stage that every detection has, or like another map.
    """
    _check_names(maps or {})
    with timed(seconds, "path"):
        path = shortest_path(cost, delta, link_weight)
    rows, columns = edge_pixels(edges)
    return Detection(
        method=method,
        photo=photo,
        skyline=Skyline(rows=path.rows.astype(np.float32)),
        edges=edges,
        edge_rows=rows,
        edge_columns=columns,
        scores=scores,
        cost=cost,
        path_cost=path.cost,
        seconds=seconds,
        cost_model=CostModel.given(
            cost,
            edges,
            scores,
            score_weight=score_weight,
            non_edge_cost=non_edge_cost,
            link=Link(weight=link_weight, delta=delta),
        ),
        maps=MappingProxyType(dict(maps or {})),
    )


@contextmanager
def timed(seconds: dict[str, float], stage: str) -> Iterator[None]:
    """Add how long a block took to the seconds of a stage."""
    start = perf_counter()
    yield
    seconds[stage] = seconds.get(stage, 0.0) + perf_counter() - start


def _check_names(maps: Mapping[str, F32]) -> None:
    """Refuse maps that would take the place of a stage, or of each other.

    Raises:
        ValueError: The message names the map.
    """
    taken = {one.name for one in (EDGES, SCORE, COST, PATH)}
    for name in maps:
        plain = name.replace(" ", "_")
        if plain in taken:
            raise ValueError(f"a map cannot be called {name}: there is a stage or map of that name")
        taken.add(plain)
