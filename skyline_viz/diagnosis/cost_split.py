"""What a line pays for, column by column and term by term."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from skyline_viz.arrays import F64, Int
from skyline_viz.detection import Detection


@dataclass(frozen=True, eq=False)
class CostSplit:
    """Costs of a line in each column, term by term; the path search sums all of them."""

    terms: Mapping[str, F64]
    """``(W,)`` each, by the name of the term: those of `cost.TERMS` and *link*. Of other methods,
    *edge* is what edge pixels cost besides their score."""

    def totals(self, first: int, last: int) -> dict[str, float]:
        """Sums over the columns from `first` to `last`, term by term."""
        part = slice(first, last + 1)
        return {term: float(costs[part].sum()) for term, costs in self.terms.items()}


def split_cost(detection: Detection, rows: Int) -> CostSplit:
    """Split the cost of a line.

    Args:
        detection: The detection.
        rows: ``(W,)`` row of the line in each column, inside the photo.
    """
    return CostSplit(detection.cost_model.split(rows))
