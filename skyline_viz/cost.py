"""Stage 5, cost: what stage 1 to 4 have seen, fused into the nodal cost of every pixel.

The cost is a sum of terms, each with a weight. `TERMS` lists them: a new term is an entry there,
and is then shown, explained, swept and tried as a remedy like the others. ``docs/extend.md`` says
how.

==========  ===========================  ==========================================================
term        who pays                     what
==========  ===========================  ==========================================================
score       edge pixels                  ``v (1 - score)``
strength    edge pixels                  ``(1 - v) (1 - strength)``
no edge     all other pixels             a constant
clear sky   pixels below edges (ours)    for each edge above, see `terms.ClearSky`
sky         all pixels (ours)            for what the sky model finds improbable, see `terms.Sky`
link        a line                       for each change of row, see `terms.Link`
==========  ===========================  ==========================================================
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, U8, Bool, Int, read_only
from skyline_viz.config import DetectorConfig
from skyline_viz.edges import edge_pixels
from skyline_viz.filter_bank import FilterBank
from skyline_viz.kernels.nodal import Own, nodal_costs
from skyline_viz.kernels.percentiles import upper_percentile
from skyline_viz.terms import (
    ClearSky,
    EdgeTerm,
    GivenEdges,
    GivenOthers,
    Link,
    NoEdge,
    Places,
    Sky,
    Term,
)

UNKNOWN = np.full((1, 1), 0.5, np.float32)
"""The map of a sky model that was not asked: one region, of which nothing is known."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Seen:
    """What the stages before have seen of a photo: what terms are made from."""

    photo: U8
    """``(H, W, 3)`` uint8 RGB."""

    edges: Bool
    """``(H, W)`` edge map."""

    strength: F32
    """``(n,)`` gradient strength of the edge pixels, row by row, in grey levels a pixel."""

    scores: F32
    """``(n,)`` their scores, in [0, 1]."""

    full: F32 | None = None
    """``(n,)`` their strengths as `normalised` has them, where that is known already."""

    pixels: tuple[Int, Int] | None = None
    """``(n,)`` rows and columns of the edge pixels, where they have been listed already."""

    sky: F32 | None = None
    """``(h, w)`` probability of sky of each region; None where no model was asked."""

    config: DetectorConfig
    """The settings, which hold the weights."""

    bank: FilterBank
    """The filter bank that gave the scores."""


def score(seen: Seen) -> EdgeTerm:
    """What edge pixels pay for looking unlike a skyline."""
    weight = seen.config.v
    return EdgeTerm(
        name="score",
        weight=weight,
        setting="v",
        colour="#56B4E9",
        edges=seen.edges,
        good=seen.scores,
    )


def strength(seen: Seen) -> EdgeTerm:
    """What edge pixels pay for a weak gradient."""
    config = seen.config
    good = seen.full
    if good is None:
        good = normalised(seen.strength, config.strength_percentile)
    read_only(good)
    return EdgeTerm(
        name="strength",
        weight=1 - config.v,
        setting="v",
        colour="#0072B2",
        edges=seen.edges,
        good=good,
    )


def no_edge(seen: Seen) -> NoEdge:
    """What pixels without an edge pay."""
    return NoEdge(
        name="no edge",
        weight=seen.config.non_edge_cost,
        setting="non_edge_cost",
        colour="#E69F00",
        edges=seen.edges,
    )


def clear_sky(seen: Seen) -> ClearSky:
    """What pixels pay for the edges above them."""
    return ClearSky(
        name="clear sky",
        weight=seen.config.clear_sky,
        setting="clear_sky",
        colour="#CC79A7",
        edges=seen.edges,
    )


def sky(seen: Seen) -> Sky:
    """What pixels pay for what the sky model finds improbable."""
    return Sky(
        name="sky",
        weight=0.0 if seen.sky is None else seen.config.sky_weight,
        setting="sky_weight",
        colour="#D55E00",
        edges=seen.edges,
        sky=UNKNOWN if seen.sky is None else seen.sky,
        cap=seen.config.sky_cap,
    )


TERMS: tuple[Callable[[Seen], Term], ...] = (score, strength, no_edge, clear_sky, sky)
"""The terms of our detector, in the order in which they are added up and shown."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CostModel:
    """What pixels and lines of a photo pay, and for what.

    The one place that knows the formula: it builds the nodal cost, splits what a line pays by
    term, and says what would change with more edges or better scores.
    """

    nodal: tuple[Term, ...]
    """The terms of the nodal cost; one is called ``score`` and one ``no edge``."""

    link: Link
    """The link cost."""

    edges: Bool
    """``(H, W)`` edge map."""

    pixels: tuple[Int, Int] | None = None
    """See `Seen.pixels`."""

    rules_out: bool = False
    """Whether pixels as dear as those without an edge are no nodes at all."""

    @classmethod
    def of(cls, seen: Seen) -> CostModel:
        """The model of our detector: all `TERMS`."""
        config = seen.config
        return cls(
            nodal=tuple(make(seen) for make in TERMS),
            link=Link(weight=config.link_weight, delta=config.delta),
            edges=seen.edges,
            pixels=seen.pixels,
        )

    @classmethod
    def given(
        cls,
        cost: F32,
        edges: Bool,
        scores: F32,
        *,
        score_weight: float,
        non_edge_cost: float,
        link: Link,
    ) -> CostModel:
        """The model of another method, of which the nodal costs are known as they are.

        Args:
            cost: ``(H, W)`` nodal costs.
            edges: ``(H, W)`` candidate pixels.
            scores: ``(n,)`` their scores, in [0, 1].
            score_weight: What a score of 0 costs more than one of 1.
            non_edge_cost: From which cost on a pixel is no node, unless all are candidates.
            link: The link cost.
        """
        by_score = EdgeTerm(
            name="score", weight=score_weight, colour="#56B4E9", edges=edges, good=scores
        )
        rest = GivenEdges(
            name="edge", weight=1.0, colour="#0072B2", edges=edges, cost=cost, score=by_score
        )
        others = GivenOthers(
            name="no edge", weight=non_edge_cost, colour="#E69F00", edges=edges, cost=cost
        )
        nodal = (by_score, rest, others)
        return cls(nodal=nodal, link=link, edges=edges, rules_out=not edges.all())

    @property
    def terms(self) -> tuple[Term | Link, ...]:
        """All terms, that of the link cost last."""
        return (*self.nodal, self.link)

    @property
    def settings(self) -> tuple[str, ...]:
        """The fields of `DetectorConfig` that weigh the terms, each once."""
        return tuple(dict.fromkeys(term.setting for term in self.terms if term.setting))

    def __repr__(self) -> str:
        """One line, as a console shows it."""
        terms = ", ".join(f"{term.name} {term.weight:g}" for term in self.terms)
        return f"CostModel({terms})"

    def __getitem__(self, name: str) -> Term:
        """The term of the nodal cost with a name."""
        return next(term for term in self.nodal if term.name == name)

    def total(self) -> F32:
        """Nodal cost of every pixel, ``(H, W)`` float32: a transposed view.

        The path search goes down columns, so a column lies together in memory. The terms of our
        detector are added up in one pass, those of somebody's one by one.
        """
        no_edge = self["no edge"]
        paying = [term for term in self.nodal if term.weight]
        clear = next((term for term in paying if type(term) is ClearSky), None)
        sky = next((term for term in paying if type(term) is Sky), None)
        own = Own(
            *(self.pixels or edge_pixels(self.edges)),
            self._of_edges().astype(np.float32, copy=False),
        )
        paid = clear.paid if clear else None, sky.paid if sky else None
        cost: F32 = nodal_costs(self.edges, own, no_edge.weight, *paid).T
        for term in paying:
            if term.paid_by != "edges" and term not in (no_edge, clear, sky):
                term.add(cost)
        return cost

    def split(self, rows: Int) -> dict[str, F64]:
        """What a line ``(W,)`` pays in each column, term by term; their sum is what it costs."""
        return {term.name: term.along(rows) for term in self.terms}

    def shown(self, cost: F32) -> F32:
        """``(H, W)`` nodal costs to look at: NaN where the method rules pixels out."""
        if not self.rules_out:
            return cost
        shown: F32 = np.where(cost >= self["no edge"].weight, np.float32(np.nan), cost)
        return shown

    @property
    def edge_rest(self) -> F64:
        """``(n,)`` what each edge pixel pays besides its score, wherever in the photo it is."""
        rest: F64 = self._of_edges(without="score").astype(np.float64)
        return rest

    def more_edges(self, rows: Places, columns: Places, price: float, first: int, last: int) -> F64:
        """What changes if some pixels without an edge had one.

        Args:
            rows: ``(k,)`` their rows.
            columns: ``(k,)`` their columns, not near `first` and `last` unless that is a rim.
            price: What an edge pixel pays for its score, and for all else that edge pixels pay.
            first: First column of the part of the photo that is asked for.
            last: Its last column.

        Returns:
            ``(last - first + 1, H)`` change of the nodal costs, column by column.
        """
        added = np.zeros((len(self.edges), last - first + 1), np.bool_)
        added[rows, columns - first] = True
        change = np.zeros(added.shape[::-1])
        for term in self.nodal:
            answer = term.answer(added, first) if term.weight else None
            if answer is not None:
                change += answer.T
        change[columns - first, rows] += price - self["no edge"].at(rows, columns)
        return change

    def saved(self, scores: F32, typical: float) -> F64:
        """How much less pixels with some scores ``(k,)`` would cost with a typical one."""
        saved: F64 = self["score"].weight * np.maximum(typical - scores.astype(np.float64), 0.0)
        return saved

    def searched(self, config: DetectorConfig) -> CostModel:
        """The same nodal costs, searched with the ``delta`` and link weight of a configuration."""
        return replace(self, link=Link(weight=config.link_weight, delta=config.delta))

    def _of_edges(self, *, without: str = "") -> npt.NDArray[np.floating]:
        """``(n,)`` what edge pixels alone pay."""
        paid = [
            term.of_edges()
            for term in self.nodal
            if term.paid_by == "edges" and term.name != without
        ]
        return reduce(np.add, paid)


def normalised(strength: F32, percentile: float) -> F32:
    """Gradient strength ``(n,)`` in [0, 1]; 1 is the given percentile of this photo's edges."""
    if len(strength) == 0:
        return strength
    top = upper_percentile(strength, percentile)
    if top <= 0:
        return np.zeros_like(strength)
    share: F32 = np.clip(strength, 0.0, top)
    share /= top
    return share
