"""Sums over many photos on a cluster: what photos give is added up where it is made.

A worker adds up the photos of a task. Such sums are added eight at a time, again by workers, and
again, until one is left of a group of photos; that one travels to the client, which adds up the
groups. A worker that is lost takes along at most what it has of the groups under way, and others
do that anew. Sums come out the same whatever the order where adding is exact, as that of Gram
matrices is.
"""

from __future__ import annotations

import contextlib
import itertools
import secrets
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, Self, TypeVar

from skyline_viz.running.batch import BatchError, Failure, Named, attempt
from skyline_viz.running.clusters.requirements import dask
from skyline_viz.running.clusters.working import Cluster, prepared, to_send, translated
from skyline_viz.running.progress import ProgressBar
from skyline_viz.running.sending import Unsendable, packed, unpacked
from skyline_viz.system.notes import heard_by, note

_MOST_A_TASK = 32  # photos: their sum takes a few megabytes
_TOGETHER = 8  # sums that one task adds up
_GROUP = _TOGETHER**2  # tasks at least whose sums make one
_GROUPS = 2  # under way at a time

Task = TypeVar("Task", bound=Named)
Value = TypeVar("Value")


@dataclass
class Sum(Generic[Value]):
    """What some photos came to."""

    total: Value | None = None
    """Their sum; None where each of them failed."""

    failures: list[Failure] = field(default_factory=list)
    """Those that failed."""

    notes: list[str] = field(default_factory=list)
    """What was noted about them."""

    def __iadd__(self, other: Sum[Value]) -> Self:
        if other.total is not None:
            adding: Any = self.total  # what can be added has no type of its own
            self.total = other.total if adding is None else adding + other.total
        self.failures += other.failures
        self.notes += other.notes
        return self


def summed(
    cluster: Cluster,
    function: Callable[[Task], Value],
    tasks: Sequence[Task],
    *,
    title: str = "photos",
) -> tuple[Value | None, list[Failure]]:
    """The sum of ``function(task)`` over all tasks, and those that failed.

    Args:
        cluster: Where to work.
        function: What to do, as `Cluster.run` takes it; what it gives can be added.
        tasks: What to do it with.
        title: What is counted, for the progress bar.

    Returns:
        The sum, or None where every task failed; and the failures, in order.

    Raises:
        BatchError: The cluster is gone, has other versions, or cannot be sent the work.
    """
    client = cluster.client
    threads = max(1, sum(client.nthreads().values()))
    size = max(1, min(_MOST_A_TASK, len(tasks) // threads))
    group = max(_GROUP, 2 * threads) * size
    coming = (tasks[first : first + group] for first in range(0, len(tasks), group))
    waiting: deque[tuple[int, Any]] = deque()
    whole: Sum[Value] = Sum()
    names = (f"sum-{secrets.token_hex(8)}-{number}" for number in itertools.count())
    with ProgressBar(len(tasks), title) as bar:
        try:
            work = client.submit(bytes, to_send(function), key=next(names))
            while True:
                for part in itertools.islice(coming, _GROUPS - len(waiting)):
                    with translated():
                        waiting.append((len(part), _tree(client, work, part, size, names)))
                if not waiting:
                    return whole.total, whole.failures
                count, future = waiting.popleft()
                found: Sum[Value] = _result(future)
                for one in found.notes:
                    note(one)
                whole += Sum(found.total, found.failures)
                for _ in range(count):
                    bar.advance()
        except Unsendable as error:
            raise BatchError(str(error)) from error
        finally:
            with contextlib.suppress(Exception):  # of a cluster that is gone
                client.cancel([future for _, future in waiting], force=True)


def _tree(
    client: Any,  # noqa: ANN401
    work: Any,  # noqa: ANN401
    tasks: Sequence[Task],
    size: int,
    names: Iterator[str],
) -> Any:  # noqa: ANN401
    """Dask's word for the sum over tasks."""
    sums = []
    for first in range(0, len(tasks), size):
        part = tasks[first : first + size]
        sent = packed([*part], part[0].name)
        sums.append(client.submit(_sum_there, work, sent, key=next(names)))
    while len(sums) > 1:
        parts = (sums[first : first + _TOGETHER] for first in range(0, len(sums), _TOGETHER))
        sums = [client.submit(_add_there, part, key=next(names)) for part in parts]
    return sums[0]


def _result(future: Any) -> Any:  # noqa: ANN401
    with translated():
        try:
            return future.result()
        except dask("distributed").scheduler.KilledWorker as error:
            raise BatchError(
                f"{error.allowed_failures + 1} workers died of the same photos, one by one, "
                f"probably for want of memory; give each of them fewer threads."
            ) from error


def _sum_there(work: bytes, sent: bytes) -> Sum[Any]:
    """The sum over the photos of a task, on a worker."""
    function = prepared(work)
    notes: list[str] = []
    whole: Sum[Any] = Sum()
    with heard_by(notes.append):
        for task in unpacked(sent):
            outcome = attempt(function, task)
            failed = isinstance(outcome, Failure)
            whole += Sum(None, [outcome]) if failed else Sum(outcome)
    whole.notes = notes
    return whole


def _add_there(sums: list[Sum[Any]]) -> Sum[Any]:
    whole: Sum[Any] = Sum()  # the others may be asked for again, and stay as they are
    for one in sums:
        whole += one
    return whole
