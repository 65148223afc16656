"""Filter banks from whole data sets: in several processes, past photos that fail."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeVar

from skyline_viz.config import FILTER_SIZES, TrainingConfig
from skyline_viz.datasets.item import Item, photo_and_truth
from skyline_viz.filter_bank import FilterBank
from skyline_viz.running.batch import Failure, run
from skyline_viz.running.sums import sums_of
from skyline_viz.system.fingerprints import telling
from skyline_viz.training import GramMatrices, gather_item, solve, together

AnyItem = TypeVar("AnyItem", bound=Item)


def train_on(
    items: Sequence[Item],
    training: TrainingConfig,
    *,
    seed: int = 0,
    dataset: str = "",
    workers: int = 1,
) -> tuple[FilterBank, list[Failure]]:
    """Learn a filter bank from photos that have a truth, in several processes.

    Args:
        items: Photos with truth.
        training: How samples are drawn and filters are solved.
        seed: Seed of the negative samples.
        dataset: Name for the bank's provenance.
        workers: Number of processes, see `batch.run`.

    Returns:
        The bank, the very one that `training.train` gives, and the photos that failed.

    Raises:
        ValueError: Every single photo failed, or there is none.
    """
    return train_on_several({dataset: items}, training, seed=seed, workers=workers)


def train_on_several(
    datasets: Mapping[str, Sequence[Item]],
    training: TrainingConfig,
    *,
    seed: int = 0,
    workers: int = 1,
) -> tuple[FilterBank, list[Failure]]:
    """Learn a filter bank from several data sets, each of which counts as much as each other one.

    Args:
        datasets: Name of each data set, for the bank's provenance, and its photos with truth.
        training: How samples are drawn and filters are solved.
        seed: Seed of the negative samples.
        workers: Number of processes, see `batch.run`.

    Returns:
        The bank, and the photos that failed.

    Raises:
        ValueError: Every single photo of a data set failed, or there is none.
    """
    sums = {}
    failures: list[Failure] = []
    for name, items in datasets.items():
        total, failed = _gather_all(items, training, seed, workers)
        sums[name] = total
        failures += failed
    return solve_several(sums, training, seed), failures


def gather_several(
    datasets: Mapping[str, Sequence[Item]],
    training: TrainingConfig,
    *,
    seed: int = 0,
    workers: int = 1,
) -> tuple[dict[str, GramMatrices], list[Failure]]:
    """Gather what `train_on_several` solves, of a part of the photos: a data set may have none."""
    work, parts = partial(gather_item, training, seed), [*datasets.values()]
    sums, failures = sums_of(work, parts, workers=workers, title="training")
    totals = (GramMatrices.empty(training) if one is None else one for one in sums)
    return dict(zip(datasets, totals, strict=True)), failures


def solve_several(
    sums: Mapping[str, GramMatrices], training: TrainingConfig, seed: int = 0
) -> FilterBank:
    """The bank of what was gathered from several data sets, each counting alike.

    Raises:
        ValueError: One of them has no photo with a true skyline.
    """
    if empty := [name for name, one in sums.items() if one.images == 0]:
        raise ValueError(f"training needs at least one photo with a true skyline of {empty[0]}.")
    told = [replace(one, seen=telling(one.seen)) for one in sums.values()]
    return solve(together(told), seed, training, ", ".join(sums))


def train_sizes(
    items: Sequence[Item],
    training: TrainingConfig,
    *,
    seed: int = 0,
    dataset: str = "",
) -> tuple[list[FilterBank], list[Failure]]:
    """Learn a filter bank of every size, of `FILTER_SIZES`; each photo is looked at once.

    Takes what `train_on` takes. Works in this process: Gram matrices of the largest filters, 120
    MB, are dear to send.

    Returns:
        The banks that `train_on` gives with each size, smallest first, and the photos that failed.

    Raises:
        ValueError: Every single photo failed, or there is none.
    """
    total, failures = _gather_all(items, replace(training, filter_size=FILTER_SIZES[-1]), seed)
    banks = [
        solve(total.cropped(size), seed, replace(training, filter_size=size), dataset)
        for size in FILTER_SIZES
    ]
    return banks, failures


def readable(
    items: Sequence[AnyItem], *, workers: int = 1
) -> tuple[dict[int, AnyItem], list[Failure]]:
    """Read all photos and their truths: one that cannot be read must not spoil a training.

    Args:
        items: The photos.
        workers: Number of processes, see `batch.run`.

    Returns:
        Those that can be read, by their places, and the others with what is wrong with them.
    """
    good: dict[int, AnyItem] = {}
    bad: list[Failure] = []
    for index, outcome in enumerate(run(_read, items, workers=workers, title="reading")):
        if isinstance(outcome, Failure):
            bad.append(outcome)
        else:
            good[index] = items[index]
    return good, bad


def _read(item: Item) -> bool:
    photo_and_truth(item)
    return True


def _gather_all(
    items: Sequence[Item],
    training: TrainingConfig,
    seed: int,
    workers: int = 1,
) -> tuple[GramMatrices, list[Failure]]:
    """Summed Gram matrices of all photos, and the photos that failed."""
    work = partial(gather_item, training, seed)
    (total,), failures = sums_of(work, [items], workers=workers, title="training")
    if total is None:
        reason = f", and the first one failed: {failures[0]}" if failures else "."
        raise ValueError(f"training needs at least one photo with a true skyline{reason}")
    return replace(total, seen=telling(total.seen)), failures
