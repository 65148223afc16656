"""Charts of a data set: the histogram of A_err, and how many photos are within each tolerance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from skyline_viz.evaluation.distribution import TOP, cumulative, shares
from skyline_viz.evaluation.metrics import TOLERANCE
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.reports.lines import path_of

SIZE = (360, 160)
"""Width and height of what is plotted, without the axes, in units of the chart."""

LARGEST = 20.0
"""Largest tolerance of the curve, in pixels."""

_GAP = 0.12  # of a bin of the histogram that is left free


@dataclass(frozen=True)
class Tick:
    """A mark of an axis."""

    at: float
    """Where it is, in units of the chart."""

    label: str
    """Its words."""


@dataclass(frozen=True)
class Bar:
    """A bar of the histogram, from the bottom up."""

    method: int
    """Place of the method that it belongs to."""

    x: float
    """Its left side."""

    width: float
    """How wide it is."""

    height: float
    """How high it is."""

    label: str
    """What stands over it: the share, where one method is shown and the share is not 0."""

    far: bool
    """Whether it is the last bin."""


@dataclass(frozen=True)
class Curve:
    """What share of the photos is within each tolerance, of one method."""

    method: int
    """Its place among the methods."""

    name: str
    """Its name."""

    path: str
    """The curve as a path of SVG."""

    said: str
    """Its shares at a few tolerances, in words."""


@dataclass(frozen=True)
class Charts:
    """Both charts."""

    bars: tuple[Bar, ...]
    """The histogram."""

    curves: tuple[Curve, ...]
    """The cumulative curves."""

    bins: tuple[Tick, ...]
    """Marks below the histogram."""

    tolerances: tuple[Tick, ...]
    """Marks below the curves."""

    percent: tuple[Tick, ...]
    """Marks left of the curves."""


def charts(results: Mapping[str, Sequence[PhotoResult]]) -> Charts:
    """Draw the errors of methods on the same photos.

    Args:
        results: The results by the name of the method.
    """
    errors = {name: [one.a_err for one in found] for name, found in results.items()}
    width, height = SIZE
    step = width / (TOP + 1)
    bins = [Tick((at + 0.5) * step, str(at) if at < TOP else f"{TOP}+") for at in range(TOP + 1)]
    marks = [Tick(width * px / LARGEST, f"{px}") for px in range(0, round(LARGEST) + 1, 4)]
    percent = [Tick(height * (1 - share), f"{share:.0%}") for share in (0, 0.25, 0.5, 0.75, 1)]
    curves = [_curve(place, name, found) for place, (name, found) in enumerate(errors.items())]
    return Charts(_bars(errors), tuple(curves), tuple(bins), tuple(marks), tuple(percent))


def _bars(errors: Mapping[str, Sequence[float]]) -> tuple[Bar, ...]:
    width, height = SIZE
    step = width / (TOP + 1)
    found = [shares(one) for one in errors.values()]
    highest = max((float(one.max()) for one in found), default=0.0) or 1.0
    wide = step * (1 - _GAP) / max(len(found), 1)
    return tuple(
        Bar(
            place,
            round(at * step + step * _GAP / 2 + place * wide, 2),
            round(wide, 2),
            round(height * share / highest, 2),
            f"{share:.0%}" if share and len(found) == 1 else "",
            at == TOP,
        )
        for place, one in enumerate(found)
        for at, share in enumerate(one.tolist())
        if share
    )


def _curve(place: int, name: str, errors: Sequence[float]) -> Curve:
    """A staircase: it climbs where a photo's error is."""
    width, height = SIZE
    within = sorted(error for error in errors if error <= LARGEST)
    steps = np.unique([0.0, *within, LARGEST])
    reached = cumulative(errors, steps)
    points = [(0.0, float(height))]
    for tolerance, share in zip(steps.tolist(), reached.tolist(), strict=True):
        x = width * tolerance / LARGEST
        points += [(x, points[-1][1]), (x, height * (1 - share))]
    told = [1.0, TOLERANCE, LARGEST]
    words = [
        f"{share:.0%} within {px:g} px"
        for px, share in zip(told, cumulative(errors, told).tolist(), strict=True)
    ]
    return Curve(place, name, path_of(points), ", ".join(words))
