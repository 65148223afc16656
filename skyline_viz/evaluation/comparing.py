"""Several methods on the same photos: cross-validated, or as they are."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from skyline_viz.datasets.layouts import DatasetItem
from skyline_viz.evaluation.cross_validation import run_tests, tests_of
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.method import Learner, Method, MethodError
from skyline_viz.methods.registry import load_method, save_method
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.resume import Kept, digest_of, digest_of_item, digest_of_method
from skyline_viz.skyline import SkylineError


@dataclass(frozen=True)
class Compared:
    """What methods came to on the same photos."""

    results: dict[str, list[PhotoResult]]
    """For each method the results by name of the photo."""

    items: list[DatasetItem]
    """The photos that could be read."""

    fitted: dict[str, Method]
    """The methods as the first part of the photos was tested with them."""

    failures: list[Failure]
    """Photos that could not be read, methods that could not learn, photos that one failed on."""


def compare_methods(
    items: Sequence[DatasetItem],
    methods: Sequence[Method],
    *,
    folds: int = 0,
    training: Sequence[DatasetItem] = (),
    seed: int = 0,
    workers: int = 1,
    kept: Kept | None = None,
) -> Compared:
    """Test methods on photos with truth.

    With folds, photo ``i`` in the order of names is tested with what was learned from the photos
    whose number differs from it modulo `folds`. What a family of methods learns, it learns once.

    Args:
        items: Photos with truth.
        methods: The methods.
        folds: Number of folds, from 2 on; 0 tests the methods as they are.
        training: Photos to learn from instead; only without folds.
        seed: Seed of all that is drawn.
        workers: Number of processes, see `batch.run`.
        kept: Where finished photos and trained methods are kept; nowhere unless given.

    Raises:
        ValueError: There are too few photos for so many folds.
    """
    items = sorted(items, key=lambda item: item.name)
    usable, failures = _readable(items, workers)
    if folds and not 2 <= folds <= len(usable):
        raise ValueError(f"folds is a number from 2 to the {len(usable)} photos, not {folds}")
    if folds:
        parts = [usable[fold::folds] for fold in range(folds)]
        lessons = [[one for one in usable if one not in part] for part in parts]
    else:
        parts, lessons = [usable], [list(training)]
    fitted = _fitted(methods, lessons, seed, workers, failures, kept)
    results: dict[str, list[PhotoResult]] = {}
    for at, method in enumerate(methods):
        detectors = {
            item.name: ready
            for part, ready in zip(parts, fitted[at], strict=True)
            if ready is not None
            for item in part
        }
        tests = sorted(tests_of(usable, detectors, kept), key=lambda test: test.name)
        results[method.name], failed = run_tests(tests, workers, kept, title=method.name)
        failures += [replace(one, name=f"{one.name}, {method.name}") for one in failed]
    ready = {
        method.name: one[0]
        for method, one in zip(methods, fitted, strict=True)
        if one and one[0] is not None
    }
    return Compared(results, usable, ready, failures)


def fold_method(
    items: Sequence[DatasetItem],
    method: Method,
    folds: int,
    seed: int,
    workers: int,
    kept: Kept | None = None,
) -> tuple[dict[str, Method], list[Failure]]:
    """For each photo, by its name, a method as it is to be tested on it, see `compare_methods`."""
    items = sorted(items, key=lambda item: item.name)
    parts = [items[fold::folds] for fold in range(folds)] if folds else [list(items)]
    lessons = [[one for one in items if one not in part] for part in parts]
    failures: list[Failure] = []
    (fitted,) = _fitted([method], lessons, seed, workers, failures, kept)
    ready = {
        item.name: one
        for part, one in zip(parts, fitted, strict=True)
        if one is not None
        for item in part
    }
    return ready, failures


@dataclass(frozen=True)
class _Lesson:
    method: Learner
    items: list[DatasetItem]
    seed: int
    folder: Path | None
    """Where what is learned is kept; None keeps nothing."""

    @property
    def name(self) -> str:
        return self.method.name


def _fitted(
    methods: Sequence[Method],
    lessons: Sequence[list[DatasetItem]],
    seed: int,
    workers: int,
    failures: list[Failure],
    kept: Kept | None,
) -> list[list[Method | None]]:
    """Each method as it is to be tested on each part; None where it could not learn."""
    families: dict[str, list[Learner | None]] = {}
    fitted: list[list[Method | None]] = []
    for method in methods:
        if not isinstance(method, Learner) or not lessons[0]:
            fitted.append([method] * len(lessons))
            continue
        if method.family not in families:
            families[method.family] = _learned(method, lessons, seed, workers, failures, kept)
        shared = families[method.family]
        fitted.append([None if one is None else method.sharing(one) for one in shared])
    return fitted


def _learned(
    method: Learner,
    lessons: Sequence[list[DatasetItem]],
    seed: int,
    workers: int,
    failures: list[Failure],
    kept: Kept | None,
) -> list[Learner | None]:
    learned: list[Learner | None] = []
    folder = kept.folder if kept else None
    tasks = [_Lesson(method, items, seed, folder) for items in lessons]
    title = f"training {method.name}"
    for outcome in run(_learn, tasks, workers=min(workers or len(tasks), len(tasks)), title=title):
        if isinstance(outcome, Failure):
            if outcome not in failures:  # what is missing is missing in every fold
                failures.append(outcome)
            learned.append(None)
        else:
            learned.append(outcome)
    return learned


def _learn(lesson: _Lesson) -> Learner:
    """What is learned, or what an earlier run has learned from the same photos."""
    method: Any = lesson.method
    if lesson.folder is None:
        return lesson.method.fit(lesson.items, lesson.seed)
    contents = [digest_of_item("", item) for item in lesson.items]
    key = digest_of("learned", digest_of_method(method), lesson.seed, contents)
    file = lesson.folder / f"{key}.npz"
    try:
        known: Any = load_method(file)
        ready: Learner = method.sharing(known)
        return ready
    except MethodError:  # there is none, or it is damaged
        learned = lesson.method.fit(lesson.items, lesson.seed)
    with suppress(MethodError):  # what some class has learned cannot be kept
        save_method(learned, file)
    return learned


def _readable(
    items: Sequence[DatasetItem], workers: int
) -> tuple[list[DatasetItem], list[Failure]]:
    """Photos that can be read and have a truth; others must not keep methods from learning."""
    usable, failures = [], []
    for item, outcome in zip(
        items, run(_read, items, workers=workers, title="reading"), strict=True
    ):
        if isinstance(outcome, Failure):
            failures.append(outcome)
        else:
            usable.append(item)
    return usable, failures


def _read(item: DatasetItem) -> bool:
    truth = item.truth()
    if truth is None:
        raise SkylineError("there is no truth")
    width = item.photo().shape[1]
    if width != truth.width:
        raise SkylineError(f"the photo is {width} columns wide, the truth {truth.width}")
    return True
