"""How good methods are on a data set: tested as they are, or cross-validated.

There is one way to do it, whatever the methods and whoever asks: `assign` says which method each
photo is tested with, having trained one for each fold; then photos are worked on one by one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from skyline_viz.datasets.item import Item, listed
from skyline_viz.datasets.predictions import Predictions
from skyline_viz.evaluation.dealing import deal, groups_for
from skyline_viz.evaluation.evaluated import Evaluation
from skyline_viz.evaluation.folds import Folds
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.evaluation.tasks import (
    PhotoTask,
    compare_lines,
    compare_photos,
    photo_tasks,
    told_once,
)
from skyline_viz.method import Configurable, LearnedMethod, Method, MethodError
from skyline_viz.methods.finding.plugins import as_method
from skyline_viz.methods.registry import find_method, has_learned
from skyline_viz.running.batch import Failure
from skyline_viz.running.resume import Kept

Tested = str | Method | Predictions
"""A method as an object or as `find_method` takes it, or the lines that somebody else found."""

Methods = Tested | Iterable[Tested]
"""One of these or several."""


def evaluate(
    items: Iterable[Item],
    methods: Methods = "default",
    *,
    workers: int = 1,
    kept: Kept | None = None,
) -> Evaluation:
    """Detect the skylines of photos that have a truth, and compare.

    Args:
        items: Photos with truth, such as ``sv.open_dataset(folder)``.
        methods: One method or several: objects, or names and files as text, or the lines that
            `open_predictions` finds, of which photos without one have failed.
        workers: Number of processes; 1 works in this one, 0 chooses by the number of photos.
        kept: Where finished photos are kept; nowhere unless given.

    Returns:
        The results in the order of `items`, and the photos that failed.

    Raises:
        MethodError: A method is unknown or has not been trained, or two have the same name.

    Examples:
        >>> from skyline_viz.datasets.item import LoadedItem
        >>> from skyline_viz.rendering import render
        >>> scenes = [render("desert", seed, 160, 120) for seed in (1, 2)]
        >>> items = [LoadedItem(one.name, one.photo, one.truth) for one in scenes]
        >>> found = evaluate(items, ["default", "paper"])
        >>> found.summaries["paper"].photos
        2
        >>> [one.name for one in found.results["default"]]
        ['desert-1', 'desert-2']
    """
    given, chosen = _given(methods), _methods(methods)
    for one in chosen:
        if isinstance(one, LearnedMethod):
            one.require_trained()
    items = listed(items)
    return _tested(items, given, assign(items, chosen, kept=kept), workers, kept)


def cross_validate(
    items: Iterable[Item],
    methods: Methods = "default",
    folds: int | Mapping[str, int] = 2,
    *,
    seed: int = 0,
    workers: int = 1,
    kept: Kept | None = None,
) -> Evaluation:
    """Test each photo with what was learned from the photos of all other folds.

    Photos are dealt one after the other in the order of their names. Those that are nearly the
    same stay in one fold, see `groups_for`; whatever else resembles each other belongs into one
    fold, too, see `deal`. Methods that learn nothing are tested as they are, and so are
    the lines of somebody else. What a family of methods learns, it learns once; a method that
    learns from sums, as our detector does, looks at each photo once, however many folds there are.

    Args:
        items: Photos with truth, such as ``sv.open_dataset(folder)``.
        methods: One method or several: objects, or names and files as text, or the lines that
            `open_predictions` finds, of which photos without one have failed.
        folds: Number of folds, from 2 to the number of photos; or the fold of each photo by its
            name, as `deal` and `read_split` give them, where photos without one are left out.
        seed: Seed of all that is drawn.
        workers: Number of processes; 1 works in this one, 0 chooses by the number of photos.
        kept: Where finished photos and trained methods are kept; nowhere unless given.

    Returns:
        The results by name, and what failed.

    Raises:
        MethodError: A method is unknown, or two have the same name.
        ValueError: There are too few photos for so many folds.

    Examples:
        >>> from skyline_viz.datasets.item import LoadedItem
        >>> from skyline_viz.rendering import render
        >>> scenes = [render("desert", seed, 160, 120) for seed in (1, 2, 3)]
        >>> items = [LoadedItem(one.name, one.photo, one.truth) for one in scenes]
        >>> found = cross_validate(items, ["default", "edges"], folds=3)
        >>> found.folds, list(found.summaries), found.failures
        (3, ['default', 'edges'], ())
    """
    given = _given(methods)
    if learned := next((one for one in given if isinstance(one, str) and has_learned(one)), None):
        raise MethodError(
            f"{learned} has learned already, and would be trained anew; name a method."
        )
    items, chosen = listed(items), _methods(given)
    assigned = assign(items, chosen, folds, seed=seed, workers=workers, kept=kept)
    return _tested(items, given, assigned, workers, kept)


@dataclass(frozen=True)
class Assigned:
    """Which photos each method is tested on, and as what it is."""

    tasks: Mapping[str, Sequence[PhotoTask]]
    """For each method by its name, the photos, each with the method as it is tested on it."""

    methods: Mapping[str, Method]
    """The methods as the first fold is tested with them, but for those that could not learn."""

    failures: Mapping[str, Sequence[Failure]]
    """For each method, photos that it cannot be tested on, and why it could not learn."""

    fold_of: Mapping[str, int]
    """The fold of each photo by its name; empty where there are none."""

    seed: int
    """Seed of all that was drawn."""


def assign(
    items: Iterable[Item],
    methods: Sequence[Method],
    folds: int | Mapping[str, int] | None = None,
    *,
    seed: int = 0,
    workers: int = 1,
    kept: Kept | None = None,
) -> Assigned:
    """Train methods for each fold, and say which photo is to be tested with which of them.

    Args:
        items: Photos with truth.
        methods: The methods, no two of one name.
        folds: Number of folds, or the fold of each photo; None takes the methods as they are.
        seed: Seed of all that is drawn.
        workers: Number of processes, see `batch.run`.
        kept: Where trained methods are kept; nowhere unless given.

    Raises:
        ValueError: There are no photos, or too few for so many folds.
    """
    items = listed(items)
    if folds is None:
        tasks = {one.name: photo_tasks([(item, one) for item in items], kept) for one in methods}
        nothing: dict[str, list[Failure]] = {one.name: [] for one in methods}
        return Assigned(tasks, {one.name: one for one in methods}, nothing, {}, seed)
    if isinstance(folds, int):
        dealt = deal(items, folds, groups_for(items, folds, workers=workers))
    else:
        dealt = dict(folds)
    by_name = tuple(sorted((one for one in items if one.name in dealt), key=lambda one: one.name))
    of = tuple(dealt[item.name] for item in by_name)
    if len(set(of)) < 2 or set(of) != set(range(max(of) + 1)):
        raise ValueError("the photos are in fewer than two folds, or one of the folds is empty")
    parts = Folds(by_name, of, seed, workers, kept or Kept())
    tasks, ready, failures = {}, {}, {}
    for method, learned in zip(methods, parts.learned(methods), strict=True):
        bad = {failure.name for failure in learned.unusable}
        pairs = [
            (item, one)
            for index, item in enumerate(by_name)
            if (one := learned.methods[of[index]]) is not None and item.name not in bad
        ]
        tasks[method.name] = photo_tasks(pairs, kept)
        failures[method.name] = [*learned.unusable, *learned.failures]
        if (first := next(iter(learned.methods), None)) is not None:
            ready[method.name] = first
    return Assigned(
        tasks, ready, failures, dict(zip([one.name for one in by_name], of, strict=True)), seed
    )


def chosen_methods(methods: object) -> list[Configurable]:
    """Methods as objects.

    Raises:
        MethodError: One is unknown or none at all, or two have the same name.
    """
    given = _given(methods)
    chosen = [find_method(one) if isinstance(one, str) else as_method(one) for one in given]
    for name in _twice(chosen):  # objects of one class that have a name without their settings
        chosen = [
            one.labelled("")
            if one.name == name and not isinstance(known, str | Configurable)
            else one
            for one, known in zip(chosen, given, strict=True)
        ]
    if twice := _twice(chosen):
        raise MethodError(f"two methods are called {twice[0]}, and results go by the name.")
    return chosen


def _methods(methods: object) -> list[Configurable]:
    """The methods among what is to be tested.

    Raises:
        MethodError: As `chosen_methods`, or somebody's lines have the name of a method.
    """
    given = _given(methods)
    lines = [one.name for one in given if isinstance(one, Predictions)]
    own = [one for one in given if not isinstance(one, Predictions)]
    chosen = chosen_methods(own) if own else []
    names = [*lines, *(one.name for one in chosen)]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise MethodError(f"two are called {twice[0]}, and results go by the name.")
    return chosen


def _given(methods: object) -> list[object]:
    alone = isinstance(methods, str | Predictions) or hasattr(methods, "detect")
    if alone or not isinstance(methods, Iterable):
        return [methods]
    if not (given := list(methods)):
        raise MethodError("there are no methods to test.")
    return given


def _twice(methods: Sequence[Method]) -> list[str]:
    names = [one.name for one in methods]
    return sorted({name for name in names if names.count(name) > 1})


def _tested(
    items: Sequence[Item],
    given: Sequence[object],
    assigned: Assigned,
    workers: int,
    kept: Kept | None,
) -> Evaluation:
    """Work on the photos, method by method, in the order in which they were given."""
    results: dict[str, Sequence[PhotoResult]] = {}
    failures: dict[str, Sequence[Failure]] = {}
    several = len(given) > 1
    fold_of = assigned.fold_of
    methods = iter(assigned.tasks.items())
    for one in given:
        if isinstance(one, Predictions):
            tested = [item for item in items if not fold_of or item.name in fold_of]
            results[one.name], failures[one.name] = compare_lines(tested, one, workers=workers)
            continue
        name, tasks = next(methods)
        title = name if several else "photos"
        results[name], failed = compare_photos(tasks, workers=workers, kept=kept, title=title)
        failures[name] = [*assigned.failures[name], *failed]
    told = tuple(told_once(failures))
    seed = assigned.seed
    return Evaluation(results, told, assigned.methods, assigned.tasks, fold_of, seed)
