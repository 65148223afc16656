"""What path and truth pay along the columns, term by term, as small plots."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F64
from skyline_viz.detection import Detection
from skyline_viz.diagnosis.cost_split import split_cost
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.reports.lines import curve_path
from skyline_viz.skyline import Skyline

PLOT = (1000, 100)
"""Width and height of a plot, in its own units: it is as wide as the photo that it stands below."""

_LEAST = 0.1  # value at the top of a plot, at the least
_POINTS = 320  # of a curve: means of neighbouring columns


@dataclass(frozen=True)
class Plot:
    """One quantity along the columns."""

    name: str
    """The term, or *error*."""

    said: str
    """What both lines pay in all where the truth is visible, in words."""

    path: str
    """Path of SVG of the path's curve; empty for none."""

    truth: str
    """The same of the truth."""

    high: str
    """Value at the top."""


def cost_plots(detection: Detection, truth: Skyline | None, tolerance: float) -> tuple[Plot, ...]:
    """A plot of the error where there is a truth, and one of each term that anybody pays for.

    Args:
        detection: The detection.
        truth: The true line; one that is visible nowhere counts as none.
        tolerance: Error up to which a column is right, in pixels.
    """
    if truth is None or not truth.visible.any():
        rows = detection.skyline.rows.astype(np.int32)
        return _of_terms(split_cost(detection, rows).terms, {})
    case = Case(detection, truth, tolerance)
    hidden = np.where(truth.visible, 0.0, np.nan)
    due = {name: costs + hidden for name, costs in case.due.terms.items()}
    return (_of_errors(case.errors), *_of_terms(case.paid(case.path_rows).terms, due))


def _of_errors(errors: F64) -> Plot:
    high = float(np.nanmax(errors))
    mean = float(np.nanmean(errors))
    curve = curve_path(averaged(errors), 0.0, max(high, 1.0), PLOT)
    said = f"{mean:.1f} px in the mean, {high:.0f} at worst"
    return Plot("error", said, curve, "", f"{max(high, 1.0):.3g} px")


def _of_terms(paid: Mapping[str, F64], due: Mapping[str, F64]) -> tuple[Plot, ...]:
    found = (_of_term(name, costs, due.get(name)) for name, costs in paid.items())
    return tuple(one for one in found if one is not None)


def _of_term(name: str, paid: F64, due: F64 | None) -> Plot | None:
    """A plot with a scale of its own; None where neither line pays anything."""
    lines = [averaged(one) for one in (paid, due) if one is not None]
    known = np.concatenate([one[~np.isnan(one)] for one in lines])
    if not known.any():
        return None
    low, high = min(float(known.min()), 0.0), max(float(known.max()), _LEAST)
    curves = [curve_path(one, low, high, PLOT) for one in lines]
    if due is None:
        return Plot(name, f"path {paid.sum():.1f}", curves[0], "", f"{high:.2g}")
    pays = float(paid[~np.isnan(due)].sum())
    said = f"path {pays:.1f}, truth {np.nansum(due):.1f}"
    return Plot(name, said, curves[0], curves[1], f"{high:.2g}")


def averaged(values: F64) -> F64:
    """Means of neighbouring columns, so that a curve has no more than a few hundred points.

    >>> averaged(np.arange(640.0))[:2]
    array([0.5, 2.5])
    """
    if len(values) <= _POINTS:
        return values
    starts = np.arange(_POINTS) * len(values) // _POINTS
    known = ~np.isnan(values)
    sums = np.add.reduceat(np.where(known, values, 0.0), starts)
    counts = np.add.reduceat(known.astype(np.float64), starts)
    means: F64 = np.divide(sums, counts, out=np.full(_POINTS, np.nan), where=counts > 0)
    return means
