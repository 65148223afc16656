"""Sums over many photos: in processes of this machine, or where `batch.working_on` says."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import add
from typing import TypeVar

from skyline_viz.running.batch import Failure, Named, elsewhere, run

Task = TypeVar("Task", bound=Named)
Value = TypeVar("Value")


def sums_of(
    function: Callable[[Task], Value],
    parts: Sequence[Sequence[Task]],
    *,
    workers: int = 1,
    title: str = "photos",
) -> tuple[list[Value | None], list[Failure]]:
    """Sums of ``function(task)`` over the tasks of each part, and the tasks that failed.

    A cluster adds up in its workers, so that no more than sums travel.

    Args:
        function: What to do; its values add up, in any order.
        parts: Tasks whose values are added up.
        workers: Number of processes, see `batch.run`.
        title: What is counted, for the progress bar.

    Returns:
        A sum for each part, None where it has none, and what failed, part by part.
    """
    if (cluster := elsewhere()) is not None:
        found: list[Value | None] = []
        failures: list[Failure] = []
        for part in parts:
            total, failed = cluster.summed(function, part, title=title)
            found.append(total)
            failures += failed
        return found, failures
    sums: list[Value | None] = []
    failures = []
    outcomes = run(function, [one for part in parts for one in part], workers=workers, title=title)
    for part in parts:
        total = None
        for _, outcome in zip(part, outcomes, strict=False):
            if isinstance(outcome, Failure):
                failures.append(outcome)
            else:
                total = outcome if total is None else add(total, outcome)
        sums.append(total)
    return sums, failures
