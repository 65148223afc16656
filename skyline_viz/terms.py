"""The terms of the nodal cost: what a pixel pays, one summand at a time.

Every term knows its weight and the setting that it comes from, adds itself to the cost of a photo,
and says what it alone comes to: at some pixels, along a line, as a map. `skyline_viz.cost` lists
the terms of our detector, and puts them together.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, Bool, Int
from skyline_viz.frames.boundary import between_centres, improbable
from skyline_viz.kernels.nodal import WINDOW, Clear, Improbable, nodal_costs

Places: TypeAlias = npt.NDArray[np.integer]
"""Rows or columns of pixels ``(k,)``."""

CLEAR_SKY_ROWS = 3
"""Edge pixels this near above a pixel, in rows, do not count against it."""

CLEAR_SKY_COLUMNS = WINDOW
"""Columns over which the edge pixels above a pixel are averaged."""

CLEAR_SKY_CAP = 1.0
"""What a pixel pays for them at the most: however full of clouds a sky is, the only edge of a
terrain costs no more than a pixel without one."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Term:
    """One summand of the nodal cost of a photo: the base of all others.

    A term of one's own says in `add` what each pixel pays; all else follows from it.
    """

    name: str
    """What it is called, wherever it is shown."""

    weight: float
    """Its weight; 0 switches it off."""

    setting: str = ""
    """The field of `DetectorConfig` that the weight comes from; nothing without one."""

    colour: str = "#F0E442"
    """Its colour where terms are stacked; people with colour-vision deficiency tell the colours of
    the terms apart."""

    edges: Bool
    """``(H, W)`` edge map of the photo."""

    paid_by: ClassVar[Literal["edges", "others", "all"]] = "all"
    """Which pixels pay: edge pixels, all the others, or all."""

    def add(self, cost: F32) -> None:
        """Add what each pixel pays to nodal costs ``(H, W)``, in place."""
        raise NotImplementedError

    def of_edges(self) -> npt.NDArray[np.floating]:
        """What each edge pixel pays, ``(n,)`` row by row, where no other pixels do."""
        return self.map()[self.edges]

    def map(self) -> F32:
        """What each pixel pays, ``(H, W)``."""
        cost = np.zeros(self.edges.shape[::-1], np.float32).T  # columns lie together, as in a cost
        if self.weight:
            self.add(cost)
        return cost

    def at(self, rows: Places, columns: Places) -> F64:
        """What pixels ``(k,)`` pay."""
        paid: F64 = self.map()[rows, columns].astype(np.float64)
        return paid

    def along(self, rows: Int) -> F64:
        """What a line ``(W,)`` pays in each column."""
        return self.at(rows, np.arange(len(rows)))

    def answer(self, added: Bool, first: int) -> F32 | None:
        """What changes where there are more edges, besides at these pixels; None for nothing.

        Args:
            added: ``(H, w)`` further edge pixels in some neighbouring columns; there are none near
                its first and last column unless the photo ends there.
            first: The first of these columns.

        Returns:
            ``(H, w)`` change of the nodal costs.
        """
        del added, first
        return None


@dataclass(frozen=True, eq=False, kw_only=True)
class EdgeTerm(Term):
    """What edge pixels pay for what they lack: ``weight (1 - good)``."""

    good: F32
    """``(n,)`` how good each edge pixel is, in [0, 1]."""

    paid_by = "edges"

    def of_edges(self) -> F32:
        """See `Term.of_edges`."""
        values: F32 = np.float32(self.weight) * (1 - self.good)
        return values

    def add(self, cost: F32) -> None:
        """See `Term.add`."""
        cost[self.edges] += self.of_edges()

    def at(self, rows: Places, columns: Places) -> F64:
        """See `Term.at`."""
        asked = self.edges[rows, columns]
        paid: F64 = np.where(asked, 1.0, 0.0)
        places = rows[asked] * np.int64(self.edges.shape[1]) + columns[asked]
        among = np.searchsorted(np.flatnonzero(self.edges), places)  # no map of all their places
        paid[asked] *= np.float32(self.weight) * (1 - self.good[among])
        return paid


@dataclass(frozen=True, eq=False, kw_only=True)
class NoEdge(Term):
    """What pixels pay that are no edge."""

    paid_by = "others"

    def add(self, cost: F32) -> None:
        """See `Term.add`."""
        np.add(cost, np.float32(self.weight), out=cost, where=~self.edges)

    def at(self, rows: Places, columns: Places) -> F64:
        """See `Term.at`."""
        return np.where(self.edges[rows, columns], 0.0, float(self.weight))


@dataclass(frozen=True, eq=False, kw_only=True)
class MapTerm(Term):
    """What pixels pay by a map: ``weight values``."""

    values: F32
    """``(H, W)``."""

    def add(self, cost: F32) -> None:
        """See `Term.add`."""
        cost += np.float32(self.weight) * self.values


@dataclass(frozen=True, eq=False, kw_only=True)
class ClearSky(Term):
    """What each edge pixel above a pixel adds to its cost: above a skyline is nothing but sky.

    Edge pixels up to `CLEAR_SKY_ROWS` above do not count, and their number is the mean over
    `CLEAR_SKY_COLUMNS` columns, as far as these are inside the photo. A pixel pays `CLEAR_SKY_CAP`
    at the most.
    """

    def add(self, cost: F32) -> None:
        """See `Term.add`."""
        cost += self.map()

    def map(self) -> F32:
        """See `Term.map`."""
        return nodal_costs(self.edges, None, 0.0, self.paid).T

    def answer(self, added: Bool, first: int) -> F32:
        """See `Term.answer`."""
        before = min(first, CLEAR_SKY_COLUMNS // 2)  # edges of columns beside those asked for
        count = added.shape[1]
        there = self.edges[:, first - before : first + count + CLEAR_SKY_COLUMNS // 2]
        all_of_them = there.copy()
        asked = slice(before, before + count)
        all_of_them[:, asked] |= added
        more, before_it = (nodal_costs(one, None, 0.0, self.paid) for one in (all_of_them, there))
        change: F32 = (more - before_it).T[:, asked]
        return change

    @property
    def paid(self) -> Clear:
        """The term as `nodal.nodal_costs` takes it."""
        return Clear(np.float32(self.weight), np.float32(CLEAR_SKY_CAP), CLEAR_SKY_ROWS)


@dataclass(frozen=True, eq=False, kw_only=True)
class Sky(Term):
    """What a pixel pays for what the sky model finds improbable if the skyline runs there.

    That is the share `boundary.improbable` of its column. A pixel pays for what that is above the
    least of its column, up to a limit: so the model decides between ridges, and never outbids the
    only edge there is.
    """

    sky: F32
    """``(h, w)`` probability of sky of each region, see `sky_model.SkyModel.sky`."""

    cap: float
    """What a pixel pays at the most."""

    def add(self, cost: F32) -> None:
        """See `Term.add`."""
        cost += self.map()

    def map(self) -> F32:
        """See `Term.map`: exact inside regions, and interpolated between their columns."""
        return nodal_costs(self.edges, None, 0.0, sky=self.paid).T

    @property
    def paid(self) -> Improbable:
        """The term as `nodal.nodal_costs` takes it."""
        borders = self.weight * improbable(self.sky)
        between = between_centres(self.edges.shape[1], len(borders))
        return Improbable(borders.astype(np.float32), *between, np.float32(self.cap))


@dataclass(frozen=True, eq=False, kw_only=True)
class GivenEdges(Term):
    """What edge pixels pay besides their score, where a method made its costs in its own way."""

    cost: F32
    """``(H, W)`` the nodal costs."""

    score: EdgeTerm
    """What they pay for their score."""

    paid_by = "edges"

    def of_edges(self) -> F64:
        """See `Term.of_edges`."""
        whole = self.cost[self.edges].astype(np.float64)
        rest: F64 = whole - self.score.weight * (1 - self.score.good.astype(np.float64))
        return rest

    def add(self, cost: F32) -> None:
        """See `Term.add`."""
        cost[self.edges] += self.of_edges()

    def at(self, rows: Places, columns: Places) -> F64:
        """See `Term.at`."""
        rest = self.cost[rows, columns].astype(np.float64) - self.score.at(rows, columns)
        return np.where(self.edges[rows, columns], rest, 0.0)


@dataclass(frozen=True, eq=False, kw_only=True)
class GivenOthers(Term):
    """What pixels pay that are no candidates, where a method made its costs in its own way."""

    cost: F32
    """``(H, W)`` the nodal costs."""

    paid_by = "others"

    def add(self, cost: F32) -> None:
        """See `Term.add`."""
        cost += np.where(self.edges, np.float32(0), self.cost)

    def at(self, rows: Places, columns: Places) -> F64:
        """See `Term.at`."""
        return np.where(self.edges[rows, columns], 0.0, self.cost[rows, columns].astype(np.float64))


@dataclass(frozen=True, kw_only=True)
class Link:
    """The link cost (equation 3): ``weight |change of row|`` between neighbouring columns."""

    name: ClassVar[str] = "link"
    setting: ClassVar[str] = "link_weight"
    colour: ClassVar[str] = "#999999"

    weight: float
    """Link cost of one pixel of row change."""

    delta: int
    """Largest change of row between neighbouring columns, in pixels."""

    def along(self, rows: Int) -> F64:
        """What a line ``(W,)`` pays to reach each column, nothing in the first."""
        change = np.diff(rows, prepend=rows[:1])
        paid: F64 = self.weight * np.abs(change).astype(np.float64)
        return paid
