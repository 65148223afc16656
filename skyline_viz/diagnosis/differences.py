"""How the maps of two detections of a photo differ, pixel by pixel: the second less the first.

The maps come in the order in which they are made: the stages up to the score, then what each pixel
pays for each term, where both add up the same terms, then the nodal cost. So the first one that is
not alike is where two detectors part.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from skyline_viz.arrays import F32, Bool, read_only
from skyline_viz.detection import Detection
from skyline_viz.stage import COST, EDGES, FUSED, ORIENTATION, OURS, PATH, Stage
from skyline_viz.terms import GivenEdges, GivenOthers, Term

Kind: TypeAlias = Literal["stage", "term"]
"""Whether a map shows a stage, or what pixels pay for a term of the nodal cost."""

ALIKE = 1e-5
"""Difference up to which two values are alike: what is added in another order rounds otherwise."""

_HALF_TURN = 180.0  # degrees after which an orientation is the same again


@dataclass(frozen=True, eq=False)
class Difference:
    """How much two detections differ in one map."""

    name: str
    """Name of the stage or of the term."""

    kind: Kind
    """Which of both it is."""

    unit: str
    """Unit of the values; nothing for plain numbers."""

    values: F32 | None
    """``(H, W)`` the second less the first: of edges 1 where only the second has one and -1 where
    only the first has, of bins 1 where they are not the same. NaN where one of both has no value.
    None where only one of both has the stage."""

    only: str = ""
    """Name of the detection that alone has the stage; nothing where both have it."""

    def __post_init__(self) -> None:
        """Freeze the map."""
        if self.values is not None:
            read_only(self.values)

    @property
    def apart(self) -> Bool | None:
        """``(H, W)`` the pixels that differ; None where only one of both has the stage."""
        if self.values is None:
            return None
        apart: Bool = np.abs(self.values) > ALIKE  # NaN is not greater
        return apart

    @property
    def title(self) -> str:
        """What it is, in words.

        >>> Difference("sky", "term", "", None).title, Difference("sky", "stage", "", None).title
        ('sky cost', 'sky')
        """
        return f"{self.name} cost" if self.kind == "term" else self.name


def differences(first: Detection, second: Detection) -> Iterator[Difference]:
    """How each map differs, in the order in which they are made, also those that are alike.

    Each is made when it is asked for.

    Args:
        first: A detection.
        second: Another one, of the same photo.

    Raises:
        ValueError: The photos have different sizes.
    """
    if first.edges.shape != second.edges.shape:
        raise ValueError("two detections are compared on one photo, and these have two sizes.")
    both = dict(first.stages), dict(second.stages)
    for name in _in_order(*both):
        there = [stages[name] for stages in both if name in stages]
        if len(there) < 2:
            only = first.method if name in both[0] else second.method
            yield Difference(name, "stage", there[0].unit, None, only)
        else:
            yield _of_stage(first, second, there[0], there[1])
    for one, other in same_terms(first, second):
        paid = other.map()
        paid -= one.map()
        yield Difference(one.name, "term", "", paid)
    yield cost_difference(first, second)


def same_terms(first: Detection, second: Detection) -> list[tuple[Term, Term]]:
    """The terms of both, of two detectors of ours; costs of other methods have units of their own.

    Args:
        first: A detection.
        second: Another one.
    """
    terms = first.cost_model.nodal, second.cost_model.nodal
    names = [[term.name for term in one] for one in terms]
    given = any(isinstance(term, GivenEdges | GivenOthers) for one in terms for term in one)
    return [] if given or names[0] != names[1] else list(zip(*terms, strict=True))


def edge_difference(first: Detection, second: Detection) -> Difference:
    """Which pixels are edges of one of both detections alone."""
    values = second.edges.astype(np.float32) - first.edges.astype(np.float32)
    return Difference(EDGES.name, "stage", "", values)


def cost_difference(first: Detection, second: Detection) -> Difference:
    """How the nodal costs differ; NaN where one of both rules pixels out."""
    costs = [one.cost_model.shown(one.cost) for one in (first, second)]
    return Difference(COST.name, "stage", "", _less(costs[1], costs[0]))


def _in_order(*both: dict[str, Stage]) -> list[str]:
    """Names of stages before the terms: those of other methods come after ours."""
    late = {FUSED.name, COST.name, PATH.name}
    ours = [one.name for one in OURS]
    names = [name for stages in both for name in stages if name not in late]
    return sorted(
        dict.fromkeys(names), key=lambda name: ours.index(name) if name in ours else len(ours)
    )


def _of_stage(first: Detection, second: Detection, one: Stage, other: Stage) -> Difference:
    name, unit = one.name, one.unit
    if one.where == "mask":
        return edge_difference(first, second)
    if one.where == "photo":
        return Difference(name, "stage", unit, _less(other.values, one.values))
    values = _at_edges(second, other) - _at_edges(first, one)
    if one.legend:
        values = np.where(np.isnan(values), values, np.float32(values != 0))
    elif name == ORIENTATION.name:
        values = (values + _HALF_TURN / 2) % _HALF_TURN - _HALF_TURN / 2
    return Difference(name, "stage", unit, values.astype(np.float32, copy=False))


def _at_edges(detection: Detection, stage: Stage) -> F32:
    """``(H, W)`` the values of a stage at the edge pixels; NaN elsewhere."""
    values = np.full(detection.edges.shape, np.nan, np.float32)
    values[detection.edge_rows, detection.edge_columns] = stage.values
    return values


def _less(second: F32, first: F32) -> F32:
    """The second less the first; values that are both infinite are alike."""
    with np.errstate(invalid="ignore"):
        values: F32 = np.subtract(second, first, dtype=np.float32)
    values[np.isinf(second) & (second == first)] = 0
    return values
