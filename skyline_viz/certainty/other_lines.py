"""Other lines: whole lines along other ridges than the cheapest path, the k best of them.

The second best path is the best one but for a pixel. To find another ridge, what lies along the
lines that are known is made dearer, and the cheapest path is searched again (as in Batra et al.,
*Diverse M-Best Solutions in Markov Random Fields*, ECCV 2012). A low price moves a line in a few
columns, a high one across the whole photo: several are tried, and the lines are compared after it.

Two lines are as far apart as the share of columns in which they follow different ridges. Of all
that were found, one after the other is taken that is cheap and far from those before it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, Bool, Int, read_only
from skyline_viz.constraints import Constraints, PathError
from skyline_viz.cost import CostModel
from skyline_viz.path import APART, shortest_path

_PRICES = (0.3, 1.0, 3.0)  # for a pixel near a known line, in mean costs of the first one a column
_TIMES = 5  # lines that are searched at each price
_BAND = 60  # a pixel is near a line within this part of the height,
_RIDGE = 50  # and another ridge begins beyond this part
_LEAST = 0.2  # share of columns in which two lines differ at least


@dataclass(frozen=True, eq=False)
class OtherLine:
    """A line along another ridge."""

    rows: Int
    """``(W,)`` its row in each column."""

    detour: float
    """How much dearer than the first line it is."""

    apart: float
    """Share of columns in which it follows another ridge than the first line."""

    def __post_init__(self) -> None:
        """Freeze the rows."""
        read_only(self.rows)

    def paid(self, model: CostModel) -> dict[str, float]:
        """What the line pays in all, term by term; their sum is what it costs."""
        return {name: float(costs.sum()) for name, costs in model.split(self.rows).items()}


def other_lines(
    cost: npt.NDArray[np.floating],
    delta: int,
    link_weight: float,
    rows: Int,
    constraints: Constraints | None = None,
    most: int = 4,
) -> list[OtherLine]:
    """Lines along other ridges, cheapest first; none where nothing else is possible.

    Args:
        cost: ``(H, W)`` nodal costs; ``inf`` forbids a pixel.
        delta: Largest change of row between neighbouring columns, in pixels.
        link_weight: Cost of one pixel of row change.
        rows: ``(W,)`` the first line: the cheapest one.
        constraints: What all of them must and must not visit.
        most: How many at the most.

    Examples:
        Two more ridges, the lower of which is the cheaper one.

        >>> cost = np.full((90, 40), 2.0, np.float32)
        >>> cost[20], cost[50], cost[80] = 1.0, 1.2, 1.1
        >>> found = other_lines(cost, 2, 0.1, np.full(40, 20))
        >>> [(int(one.rows[0]), round(one.detour), one.apart) for one in found[:2]]
        [(80, 4, 1.0), (50, 8, 1.0)]
    """
    height = len(cost)
    ridge = max(APART, height // _RIDGE)
    first = np.asarray(rows, np.int32)
    least = _price(cost, link_weight, first)
    found = []
    for one in _found(cost, delta, link_weight, first, constraints):
        apart = _distance(one, first, ridge)
        detour = max(_price(cost, link_weight, one) - least, 0.0)
        found.append(OtherLine(one, detour, apart))
    taken: list[OtherLine] = []
    while len(taken) < most:
        far = [
            min([one.apart, *(_distance(one.rows, b.rows, ridge) for b in taken)]) for one in found
        ]
        worth = [
            away - one.detour / max(least, 1e-9) if away >= _LEAST else -np.inf
            for one, away in zip(found, far, strict=True)
        ]
        best = int(np.argmax(worth)) if worth else -1
        if best < 0 or worth[best] == -np.inf:
            break
        taken.append(found[best])
    return sorted(taken, key=lambda one: one.detour)


def beside(
    cost: npt.NDArray[np.floating], link_weight: float, rows: Int, others: Iterable[Int]
) -> list[OtherLine]:
    """Lines that came from elsewhere, in the costs of the first line.

    Args:
        cost: ``(H, W)`` nodal costs; ``inf`` forbids a pixel.
        link_weight: Cost of one pixel of row change.
        rows: ``(W,)`` the first line.
        others: Rows ``(W,)`` of the others.

    Returns:
        Those of them that visit no forbidden pixel. They may be cheaper than the first line, if its
        search was not free.
    """
    ridge = max(APART, len(cost) // _RIDGE)
    least = _price(cost, link_weight, rows)
    told = []
    for one in others:
        detour = max(_price(cost, link_weight, one) - least, 0.0)
        if np.isfinite(detour):
            told.append(OtherLine(one, detour, _distance(one, rows, ridge)))
    return told


def unlike(lines: Iterable[OtherLine], height: int, most: int) -> list[OtherLine]:
    """The first lines that follow other ridges than the first line, and than each other.

    Args:
        lines: Lines, in the order of how much they are wanted.
        height: Rows of the photo.
        most: How many at the most.
    """
    ridge = max(APART, height // _RIDGE)
    taken: list[OtherLine] = []
    for one in lines:
        away = [one.apart, *(_distance(one.rows, other.rows, ridge) for other in taken)]
        if min(away) >= _LEAST and len(taken) < most:
            taken.append(one)
    return taken


def _found(
    cost: npt.NDArray[np.floating],
    delta: int,
    link_weight: float,
    first: Int,
    constraints: Constraints | None,
) -> list[Int]:
    """Lines that are cheapest when those before them are dearer, at each of the prices."""
    height, width = cost.shape
    band = max(APART, height // _BAND)
    typical = max(_price(cost, link_weight, first) / width, 0.1)
    places = np.arange(width)
    found: list[Int] = []
    dearer: F32 = np.empty((width, height), np.float32).T  # a column lies together, as in a cost
    for price in _PRICES:
        np.copyto(dearer, cost, casting="same_kind")
        known = first
        for _ in range(_TIMES):
            for away in range(-band, band + 1):
                beside = known + away
                inside: Bool = (beside >= 0) & (beside < height)
                dearer[beside[inside], places[inside]] += np.float32(price * typical)
            try:
                known = shortest_path(dearer, delta, link_weight, constraints).rows
            except PathError:
                return found
            found.append(known)
    return found


def _distance(one: Int, other: Int, ridge: int) -> float:
    """Share of columns in which two lines are further apart than a ridge is wide."""
    return float((np.abs(one - other) > ridge).mean())


def _price(cost: npt.NDArray[np.floating], link_weight: float, rows: Int) -> float:
    """Nodal and link costs of a line."""
    nodal = cost[rows, np.arange(len(rows))].sum(dtype=np.float64)
    return float(nodal + link_weight * np.abs(np.diff(rows)).sum())
