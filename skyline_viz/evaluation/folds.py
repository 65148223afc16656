"""What methods learn for a cross-validation: for each fold, from the photos of all others."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial, reduce
from operator import add
from pathlib import Path
from typing import Any

from skyline_viz.datasets.item import Item
from skyline_viz.evaluation.training_runs import readable
from skyline_viz.method import AddingLearner, Learner, Method, MethodError
from skyline_viz.methods.registry import load_method, save_method
from skyline_viz.running.batch import Failure, run, sentence
from skyline_viz.running.resume import Kept, digest_of, digest_of_item, digest_of_method
from skyline_viz.running.sums import sums_of


@dataclass(frozen=True)
class Learned:
    """A method as each fold is tested with it."""

    methods: tuple[Method | None, ...]
    """The method of each fold; None where it could not learn."""

    unusable: tuple[Failure, ...] = ()
    """Photos that could not be learned from, and are not tested either."""

    failures: tuple[Failure, ...] = ()
    """Why it could not learn, under the method's name."""

    def shared_by(self, method: Learner) -> Learned:
        """The same for another method of the family, which has nothing else to learn."""
        methods: Any = self.methods  # of the same family, and so learners, too
        own = tuple(None if one is None else method.sharing(one) for one in methods)
        failures = tuple(replace(one, name=method.name) for one in self.failures)
        return Learned(own, self.unusable, failures)


@dataclass(frozen=True)
class Folds:
    """Photos in folds."""

    items: tuple[Item, ...]
    """The photos, by name."""

    of: tuple[int, ...]
    """The fold of each photo, from 0 on; each fold has one."""

    seed: int = 0
    """Seed of all that is drawn."""

    workers: int = 1
    """Number of processes, see `batch.run`."""

    kept: Kept = field(default_factory=Kept)
    """Where what has been learned is kept."""

    @property
    def count(self) -> int:
        """Number of folds."""
        return max(self.of) + 1

    def learned(self, methods: Sequence[Method]) -> Iterator[Learned]:
        """Each method as the folds are tested with it; what a family learns, it learns once."""
        families: dict[str, Learned] = {}
        for method in methods:
            if not isinstance(method, Learner):
                yield Learned((method,) * self.count)
                continue
            if method.family not in families:
                families[method.family] = (
                    self._by_adding(method)
                    if isinstance(method, AddingLearner)
                    else self._one_by_one(method)
                )
            yield families[method.family].shared_by(method)

    def _by_adding(self, method: AddingLearner[Any]) -> Learned:
        """Look at each photo once: the sums of all folds but one are what that one needs."""
        key = self._key(method)
        if known := self._known(method, key):
            return known
        parts: list[list[Item]] = [[] for _ in range(self.count)]
        for item, fold in zip(self.items, self.of, strict=True):
            parts[fold].append(item)
        work, title = partial(_gather, method, self.seed), f"training {method.name}"
        sums, unusable = sums_of(work, parts, workers=self.workers, title=title)
        unusable.sort(key=lambda failure: failure.name)
        methods: list[Method | None] = []
        failures: dict[Failure, None] = {}
        for fold in range(self.count):
            others = [one for other, one in enumerate(sums) if other != fold and one is not None]
            try:
                methods.append(_from_sums(method, others, self.seed))
            except ValueError as error:
                failures[Failure(method.name, sentence(error))] = None
                methods.append(None)
        learned = Learned(tuple(methods), tuple(unusable), tuple(failures))
        self._keep(learned, key)
        return learned

    def _one_by_one(self, method: Learner) -> Learned:
        """Learn anew for each fold, in processes."""
        usable, unusable = self._readable
        key = self._key(method)
        lessons = [
            _Lesson(
                method,
                [one for index, one in usable.items() if self.of[index] != fold],
                self.seed,
                self._file(key, fold),
            )
            for fold in range(self.count)
        ]
        workers = min(self.workers or self.count, self.count)
        methods: list[Method | None] = []
        failures: dict[Failure, None] = {}
        for outcome in run(_fit, lessons, workers=workers, title=f"training {method.name}"):
            if isinstance(outcome, Failure):
                failures[outcome] = None  # what is missing is missing in every fold
                methods.append(None)
            else:
                methods.append(outcome)
        return Learned(tuple(methods), unusable, tuple(failures))

    @cached_property
    def _readable(self) -> tuple[dict[int, Item], tuple[Failure, ...]]:
        """Photos by place that can be learned from; one that cannot must not spoil a fold."""
        usable, unusable = readable(self.items, workers=self.workers)
        return usable, tuple(unusable)

    def _key(self, method: Learner) -> str:
        """Digest of all that the folds are learned from; nothing where nothing is kept."""
        if self.kept.folder is None:
            return ""
        return digest_of("folds", digest_of_method(method), self.of, self.seed, self._contents)

    @cached_property
    def _contents(self) -> list[str]:
        return [_content(item) for item in self.items]

    def _file(self, key: str, fold: int) -> Path | None:
        return self.kept.folder / f"{key}-{fold}.npz" if self.kept.folder else None

    def _known(self, method: Learner, key: str) -> Learned | None:
        """What an earlier run has learned by adding; None where a part of it is missing."""
        record = self.kept.find(key)
        if record is None:
            return None
        methods = [_read_again(method, self._file(key, fold)) for fold in range(self.count)]
        if None in methods:
            return None
        return Learned(tuple(methods), tuple(Failure(*one) for one in record["unusable"]))

    def _keep(self, learned: Learned, key: str) -> None:
        if self.kept.folder is None or learned.failures:
            return
        for fold, method in enumerate(learned.methods):
            _write(method, self._file(key, fold))
        told = [[failure.name, failure.reason] for failure in learned.unusable]
        self.kept.keep(key, {"unusable": told})


@dataclass(frozen=True)
class _Lesson:
    method: Learner
    items: list[Item]
    seed: int
    file: Path | None
    """Where what is learned is kept; None keeps nothing."""

    @property
    def name(self) -> str:
        return self.method.name


def _fit(lesson: _Lesson) -> Learner:
    """What is learned, or what an earlier run has learned from the same photos."""
    if (known := _read_again(lesson.method, lesson.file)) is not None:
        return known
    learned = lesson.method.fit(lesson.items, lesson.seed)
    _write(learned, lesson.file)
    return learned


def _gather(method: AddingLearner[Any], seed: int, item: Item) -> Any:  # noqa: ANN401
    return method.gather(item, seed)


def _from_sums(method: AddingLearner[Any], sums: list[Any], seed: int) -> Learner:
    """The method, learned from the sums of several folds.

    Raises:
        ValueError: There is nothing to learn from.
    """
    if not sums:
        raise ValueError("training needs at least one photo with a true skyline")
    return method.from_sums(reduce(add, sums), seed)


def _content(item: Item) -> str:
    """Digest of a photo; of one that cannot be read, which fails in its turn, of its name."""
    try:
        return digest_of_item("", item)
    except OSError:
        return item.name


def _write(learned: Method | None, file: Path | None) -> None:
    if file is not None and learned is not None:
        with suppress(MethodError):  # what a class of somebody's own has learned may stay its own
            save_method(learned, file)


def _read_again(method: Learner, file: Path | None) -> Learner | None:
    """A method with what is in a file; None where there is none, or it is damaged."""
    if file is None:
        return None
    try:
        known: Any = load_method(file)
    except MethodError:
        return None
    learned: Learner = method.sharing(known)
    return learned
