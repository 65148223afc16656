"""What the server answers about one pixel, as JSON."""

from __future__ import annotations

from pydantic import BaseModel

from annotate.server.messages import finite
from skyline_viz.diagnosis.explanation import Explanation, Filtered


class ShownFilter(BaseModel):
    """How a pixel's score comes about, see `explanation.Filtered`."""

    strength: float
    coherence: float
    orientation: float
    axes: tuple[float, float]
    bin: int
    why: tuple[str, str, str]
    samples: int
    starved: bool
    patch: list[list[int]]
    taps: list[list[float]]
    product: list[list[float]]
    score: float

    @classmethod
    def of(cls, filtered: Filtered) -> ShownFilter:
        """Show what a filter does at a pixel."""
        arrays = {name: getattr(filtered, name).tolist() for name in ("patch", "taps", "product")}
        return cls(**{**vars(filtered), **arrays, "axes": filtered.axes})


class Explained(BaseModel):
    """One pixel, all the way down, see `explanation.Explanation`."""

    row: int
    column: int
    colours: list[list[tuple[int, int, int]]]
    edge: bool
    why_edge: str
    gradient: float | None
    score: float | None
    filtered: ShownFilter | None
    terms: dict[str, float]
    cost: float | None

    @classmethod
    def of(cls, told: Explanation) -> Explained:
        """Show an explanation."""
        shown = {
            "colours": told.colours.tolist(),
            "filtered": ShownFilter.of(told.filtered) if told.filtered else None,
            "terms": dict(told.terms),
            "cost": finite(told.cost),
        }
        return cls(**{**vars(told), **shown})
