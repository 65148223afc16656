"""The paper's Tables I to VI, measured on data sets at hand, with the published rows beside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np

from skyline_viz.bins import Bins
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.datasets.item import Item
from skyline_viz.detector import Detector
from skyline_viz.evaluation.cross_validation import cross_validate, evaluate
from skyline_viz.evaluation.evaluated import Evaluation
from skyline_viz.evaluation.paper_tables import published
from skyline_viz.evaluation.results import PhotoResult, Summary
from skyline_viz.evaluation.timing import Timing
from skyline_viz.evaluation.training_runs import train_on
from skyline_viz.filter_bank import FilterBank
from skyline_viz.method import Learner, Method
from skyline_viz.methods.finding.plugins import PluggedIn, as_method
from skyline_viz.methods.registry import make_method, model_bytes
from skyline_viz.methods.sky_network import SkyNetwork
from skyline_viz.running.resume import Kept

SIZES = (7, 9, 11, 13, 15)
"""Filter sizes of Table III, in pixels a side."""

GOOD = 4.0
"""A_err below which a photo counts in Table II's second half, in pixels."""

Cell = str | float | int | None
"""What stands in a table; None is an empty cell."""


@dataclass(frozen=True)
class Table:
    """A table, whatever it will be written as."""

    number: str
    """Roman, as in the paper."""

    title: str
    """What it shows."""

    headings: tuple[str, ...]
    """A heading for each column."""

    rows: tuple[tuple[Cell, ...], ...]
    """Measured and published rows."""

    notes: tuple[str, ...] = ()
    """What has to be known to read it."""


_ERRORS = ("mean", "st. dev.", "min", "max")


def table_1(measured: Mapping[str, Evaluation], folds: int) -> Table:
    """Methods on data sets.

    Args:
        measured: What was compared on each data set.
        folds: Folds of the cross-validation.
    """
    rows: list[tuple[Cell, ...]] = []
    for dataset, compared in measured.items():
        for name, results in compared.results.items():
            if results:
                learned = _trained(compared.methods[name], folds)
                title = _title(name, compared.methods[name])
                rows.append((title, dataset, learned, *_all_errors(results)))
    for dataset, figures in published.TABLE_1.items():
        for name, errors in figures.items():
            rows.append(
                (
                    _title(name),
                    f"{dataset}, published",
                    _published_training(name),
                    *_published(errors),
                    None,
                    None,
                )
            )
    return Table(
        "I",
        "A_err of earlier methods and ours, in pixels",
        ("method", "data set", "trained on", *_ERRORS, "median", "< 4 px"),
        tuple(rows),
        (
            "Published rows are over other photos. Those of the earlier methods are from their own "
            "papers, which trained on nine photos of Basalt Hills.",
        ),
    )


def table_2(measured: Mapping[str, Evaluation]) -> Table:
    """Our detector on all photos, and on those that it gets right."""
    rows: list[tuple[Cell, ...]] = []
    for dataset, compared in measured.items():
        for name, results in compared.results.items():
            method = compared.methods.get(name)
            if not isinstance(method, Detector):
                continue
            title = _title(name, method)
            good = [one for one in results if one.a_err < GOOD]
            both = [results] if len(good) == len(results) else [results, good]
            rows += [(title, f"{dataset} ({len(kept)})", *_errors(kept)) for kept in both if kept]
    rows += [
        (_title("paper"), f"{dataset}, published", *_published(errors))
        for dataset, errors in published.TABLE_2.items()
    ]
    return Table(
        "II",
        "A_err of ours, in pixels, also without the photos at 4 px or more",
        ("method", "data set (photos)", *_ERRORS),
        tuple(rows),
    )


def table_3(
    sets: Mapping[str, Sequence[Item]],
    folds: int,
    seed: int,
    workers: int,
    kept: Kept | None = None,
) -> Table:
    """Filter sizes, with the published settings, cross-validated."""
    config = DetectorConfig.paper()
    rows: list[tuple[Cell, ...]] = []
    for dataset, items in sets.items():
        for size in SIZES:
            detector = Detector(untrained(size), config)
            found = cross_validate(items, detector, folds, seed=seed, workers=workers, kept=kept)
            results = found.results[detector.name]
            good = [one for one in results if one.a_err < GOOD]
            rows.append((f"{size} x {size}", dataset, *_errors(results), _mean(good)))
    rows += [
        (f"{size} x {size}", f"{dataset}, published", *_published(errors), None)
        for dataset, sizes in published.TABLE_3.items()
        for size, errors in sizes.items()
    ]
    return Table(
        "III",
        "Filter size, published settings, A_err in pixels",
        ("filters", "data set", *_ERRORS, "mean under 4 px"),
        tuple(rows),
    )


def table_4(
    sets: Mapping[str, Sequence[Item]], seed: int, workers: int, kept: Kept | None = None
) -> Table:
    """Training sets: each data set is learned from, and tested on each other one."""
    rows: list[tuple[Cell, ...]] = []
    config = DetectorConfig.paper()
    for learned, tested in permutations(sets, 2):
        training = TrainingConfig.of(config)
        bank, _ = train_on(sets[learned], training, seed=seed, dataset=learned, workers=workers)
        found = evaluate(sets[tested], Detector(bank, config), workers=workers, kept=kept)
        (summary,) = found.summaries.values()
        rows.append((learned, tested, summary.mean, summary.standard_deviation))
    rows += [
        (f"{learned}, published", tested, errors.mean, errors.standard_deviation)
        for (learned, tested), errors in published.TABLE_4.items()
    ]
    notes = () if len(sets) > 1 else ("Measured rows need two data sets or more.",)
    return Table(
        "IV",
        "Training set, published settings, A_err in pixels",
        ("trained on", "tested on", "mean", "st. dev."),
        tuple(rows),
        notes,
    )


def table_5(measured: Mapping[str, Evaluation], folds: int) -> Table:
    """Segmentation accuracy beside A_err."""
    rows: list[tuple[Cell, ...]] = []
    for dataset, compared in measured.items():
        for name, results in compared.results.items():
            if results:
                one = Summary.of(results)
                accuracy = round(one.segmentation_accuracy, 4)
                rows.append(
                    (
                        _title(name, compared.methods[name]),
                        dataset,
                        _trained(compared.methods[name], folds),
                        f"{accuracy:.4f}",
                        one.mean,
                        one.standard_deviation,
                    )
                )
    for name, (accuracy, errors) in published.TABLE_5.items():
        learned = "CH1" if "CH1" in name or name == "Proposed" else "scene parsing"
        row = (name, "GeoPose3K (2895), published", learned, f"{accuracy:.4f}")
        rows.append((*row, errors.mean, errors.standard_deviation))
    return Table(
        "V",
        "Segmentation accuracy, and A_err in pixels",
        ("method", "data set", "trained on", "accuracy", "mean", "st. dev."),
        tuple(rows),
        ("Published rows are over other photos, with networks that were pretrained on ImageNet.",),
    )


def table_6(timings: Sequence[Timing], fitted: Mapping[str, Method]) -> Table:
    """Size of the model, and time of a photo of 519x1388 pixels, also against our detector's.

    Args:
        timings: Times of the methods in one run on one machine.
        fitted: The trained methods, by name.
    """
    known = [one for one in timings if isinstance(fitted[one.name], Detector)]
    known.sort(key=lambda one: not _is_default(fitted[one.name]))  # that one if it was timed
    ours = known[0].seconds if known else None
    rows: list[tuple[Cell, ...]] = [
        (
            _title(one.name, fitted[one.name]),
            f"{model_bytes(fitted[one.name]) / 1e6:.4f}",
            f"{one.seconds:.3f}",
            None if ours is None else f"{one.seconds / ours:.1f}",
        )
        for one in timings
    ]
    rows += [
        (f"{name}, published", f"{size:.4g}", f"{seconds:.2f}", None)
        for name, (size, seconds) in published.TABLE_6.items()
    ]
    return Table(
        "VI",
        "Size of the model, and time of one photo of 519x1388 pixels",
        ("method", "model (MB)", "time (s)", "time / ours"),
        tuple(rows),
        (
            "Measured in one run on one core of this machine. Published on a 1.8 GHz Core i5.",
            "Learned models as they lie in memory, networks as the file that is run.",
        ),
    )


def untrained(size: int) -> FilterBank:
    """A bank that says which filters are to be learned."""
    count = Bins().count
    return FilterBank(np.zeros((count, size, size), np.float32), np.zeros(count, np.int64))


def _title(name: str, method: Method | None = None) -> str:
    """What the paper calls a method; a label is its title, whatever the label is."""
    labelled = method is not None and as_method(method).own_name() != name
    return name if labelled else published.TITLES.get(name, name)


def _is_default(method: Method) -> bool:
    return isinstance(method, Detector) and method.config == DetectorConfig()


def _trained(method: Method, folds: int) -> str:
    if isinstance(method, Learner):
        return f"the other folds of {folds}"
    return "elsewhere" if isinstance(method, SkyNetwork | PluggedIn) else "nothing"


def _published_training(name: str) -> str:
    """What the published figures of a method were trained on, see `published.TABLE_1`."""
    method = make_method(name)
    if isinstance(method, Detector):
        return "CH1"
    return "Basalt Hills (9)" if isinstance(method, Learner) else "nothing"


def _errors(results: Sequence[PhotoResult]) -> tuple[Cell, ...]:
    one = Summary.of(results)
    return one.mean, one.standard_deviation, one.minimum, one.maximum


def _all_errors(results: Sequence[PhotoResult]) -> tuple[Cell, ...]:
    one = Summary.of(results)
    good = sum(result.a_err < GOOD for result in results)
    return (*_errors(results), one.median, f"{good}/{len(results)}")


def _mean(results: Sequence[PhotoResult]) -> Cell:
    return float(np.mean([one.a_err for one in results])) if results else None


def _published(errors: published.Errors) -> tuple[Cell, ...]:
    return errors.mean, errors.standard_deviation, errors.minimum, errors.maximum
