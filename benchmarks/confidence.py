"""How well the confidence of a photo tells gross misses, of cameras that nothing has seen.

Detector and sky model have not seen the source, and nor has the regression that makes a confidence
of what is measured: each place is left out in turn, and those that remain have the same weight.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.stats import spearmanr
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import roc_auc_score

from benchmarks.ablation import WITHOUT, WITHOUT_SKY
from benchmarks.left_out import LeftOut, Models, Variant
from benchmarks.sources import Source, sources
from benchmarks.table import markdown
from skyline_viz import Detector, DetectorConfig, a_err
from skyline_viz.arrays import F64, Bool
from skyline_viz.certainty.confidence import LEAST, Confidence
from skyline_viz.datasets.item import Item, photo_and_truth
from skyline_viz.evaluation.metrics import GROSS_MISS_SHARE
from skyline_viz.running.batch import Failure, run

BANDS = (0.0, 0.5, 0.8, 0.9, 0.95, 0.98, 1.0)
"""Confidences between which photos are counted in the table of reliability."""


@dataclass(frozen=True)
class Seen:
    """What one detector came to on a photo."""

    source: str
    place: str
    error: float
    """A_err as a share of the height."""

    told: Confidence


def measured(data: Path, models: Path | None) -> str:
    """Tables of all sources, for the default and for detectors that fail more often."""
    default, small = DetectorConfig(), Models(models)
    known = sources(data)
    left_out = LeftOut(known)
    named = {
        "**default**": default,
        WITHOUT_SKY: default.with_settings(WITHOUT[WITHOUT_SKY]),
        "`paper()`": DetectorConfig.paper(),
    }
    rows, text = [], ""
    for name, config in named.items():
        found = _looked_at(left_out, Variant(name, config, small), small)
        unseen = _left_out(found)
        rows += [_row(name, known, found, unseen)]
        if config == default:
            text = f"{_reliability(found, unseen)}\n\n{_coefficients(found)}"
    header = ["detector", "photos, gross", "all", *(one.name for one in known)]
    return (
        "## Confidence of a photo\n\nGross misses told from the rest: the area under the curve "
        "(AUROC), over all sources and in each that has gross misses; and after it the rank "
        "correlation (Spearman) of doubt and A_err. Filters, sky model and coefficients have not "
        "seen the place. "
        f"{small.missing(known)}\n\n{markdown(header, rows)}\n\n{text}"
    )


def _looked_at(left_out: LeftOut, variant: Variant, models: Models) -> list[Seen]:
    """All photos, by detectors that have not seen their place."""
    found: list[Seen] = []
    for source in left_out.sources:
        detector = left_out.detector(variant, source.place)
        judge = models(source.place)
        if detector is None or judge is None:
            continue
        asks = replace(detector, sky=judge)  # for the confidence, where it is switched off
        told = run(partial(_look, asks, source), source.items, workers=0)
        for one in told:
            assert not isinstance(one, Failure), one
            found.append(one)
    return found


def _look(detector: Detector, source: Source, item: Item) -> Seen:
    photo, truth = photo_and_truth(item)
    detection = detector.detect(photo)
    error = a_err(detection.skyline, truth) / len(photo)
    return Seen(source.name, source.place, float(error), detection.certainty)


def _features(found: Sequence[Seen]) -> F64:
    return np.log([[one.told.wrong_side + LEAST, one.told.elsewhere + LEAST] for one in found])


def _gross(found: Sequence[Seen]) -> Bool:
    return np.array([one.error > GROSS_MISS_SHARE for one in found])


def _fitted(found: Sequence[Seen]) -> LogisticRegression:
    """Learned from photos; each place has the same weight."""
    places = np.array([one.place for one in found])
    names, counts = np.unique(places, return_counts=True)
    each = dict(zip(names.tolist(), len(found) / (len(names) * counts), strict=True))
    weights = [each[place] for place in places.tolist()]
    return LogisticRegression().fit(_features(found), _gross(found), weights)


def _left_out(found: Sequence[Seen]) -> F64:
    """Confidence of each photo by coefficients that have not seen its place."""
    places = np.array([one.place for one in found])
    told = np.empty(len(found))
    for place in dict.fromkeys(places.tolist()):
        others = [one for one in found if one.place != place]
        here = places == place
        if _gross(others).any():
            told[here] = _fitted(others).predict_proba(_features(found)[here])[:, 0]
    return told


def _row(name: str, known: Sequence[Source], found: Sequence[Seen], told: F64) -> list[str]:
    gross, of = _gross(found), np.array([one.source for one in found])
    errors = np.array([one.error for one in found])
    parts = [np.ones(len(found), np.bool_), *(of == one.name for one in known)]
    told_of = [f"{_area(gross[at], told[at])}, {_rank(errors[at], told[at])}" for at in parts]
    return [name, f"{len(found)}, {gross.sum()}", *told_of]


def _area(gross: Bool, told: F64) -> str:
    """The area under the curve; a dash where there is nothing to tell apart."""
    return f"{roc_auc_score(gross, -told):.3f}" if 0 < gross.sum() < len(gross) else "-"


def _rank(errors: F64, told: F64) -> str:
    """How alike photos are ordered by their error and by what is told; a dash for too few."""
    return f"{-float(spearmanr(told, errors).statistic):.2f}" if len(errors) > 2 else "-"


def _reliability(found: Sequence[Seen], told: F64) -> str:
    gross = _gross(found)
    rows = []
    for low, high in pairwise(BANDS):
        here = (told >= low) & ((told < high) | (high == 1))
        if here.any():
            of = f"{here.sum() - gross[here].sum()} of {here.sum()}"
            share = f"{1 - gross[here].mean():.0%}"
            rows.append([f"{low:g} to {high:g}", f"{told[here].mean():.2f}", of, share])
    header = ["confidence", "mean", "no gross miss", "share"]
    return f"Reliability of the default's:\n\n{markdown(header, rows)}"


def _coefficients(found: Sequence[Seen]) -> str:
    """What `skyline_viz.certainty.confidence.GROSS` is to be."""
    model = _fitted(found)
    of_wrong, of_away = model.coef_[0]
    return (
        "Coefficients from all places, as `certainty.confidence.GROSS` has them: "
        f"{model.intercept_[0]:.2f}, {of_wrong:.2f}, {of_away:.2f}."
    )
