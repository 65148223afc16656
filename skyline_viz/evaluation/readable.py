"""Photos that can be learned from: one that cannot must not spoil what all others teach."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from skyline_viz.datasets.item import Item, photo_and_truth
from skyline_viz.running.batch import Failure, run

AnyItem = TypeVar("AnyItem", bound=Item)


def readable(
    items: Sequence[AnyItem], *, workers: int = 1
) -> tuple[dict[int, AnyItem], list[Failure]]:
    """Read all photos and their truths.

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
