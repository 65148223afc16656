"""Running a function over many photos on a cluster, as `batch.run` does in processes.

The scheduler is dask's. Photos travel as their names, eight at the most in a task of dask's; what
comes back is what the function gives. The function itself is the result of a task, so that it is
sent to a worker once, and a worker that comes later gets it, too. A few tasks a thread are under
way at a time; those that have ended wait on their workers for earlier ones, up to a number. The
photos of a worker that is lost are done by others.
"""

from __future__ import annotations

import contextlib
import itertools
import secrets
import tempfile
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from queue import SimpleQueue
from time import monotonic
from typing import Any, TypeVar

from skyline_viz.running.batch import BatchError, Failure, Named, attempt
from skyline_viz.running.clusters.asking import every_worker
from skyline_viz.running.clusters.requirements import ClusterError, check_here, dask, said, versions
from skyline_viz.running.progress import ProgressBar
from skyline_viz.running.sending import Unsendable, packed, unpacked
from skyline_viz.system.memory import keep_freed, limit_photos, photo_limit
from skyline_viz.system.notes import heard_by, note

_A_THREAD = 3  # tasks under way for each thread of a worker
_KEPT = 16  # tasks for each, with those that have ended and wait for an earlier one to be told
_MOST_A_TASK = 8  # photos: a task costs the scheduler and its client some milliseconds
_COUNT_EVERY = 10.0  # seconds between two looks at how many threads there are
Task = TypeVar("Task", bound=Named)
Value = TypeVar("Value")


@dataclass(frozen=True)
class Cluster:
    """Workers that have the same versions as this program."""

    client: Any
    """Dask's connection to them."""

    @property
    def link(self) -> str:
        """Where a browser sees what they do."""
        return str(self.client.dashboard_link)

    def run(
        self, function: Callable[[Task], Value], tasks: Sequence[Task], *, title: str = "photos"
    ) -> Iterator[Value | Failure]:
        """Yield ``function(task)`` for each task, in order, or the `Failure` that it ended in.

        Args:
            function: What to do; at the top level of a module, or a `functools.partial` of such.
            tasks: What to do it with.
            title: What is counted, for the progress bar.

        Raises:
            BatchError: The cluster is gone, has other versions, or cannot be sent the work.
            OSError: The disk of a worker is full or read-only.
        """
        outcomes = self._outcomes(function, tasks)
        with ProgressBar(len(tasks), title) as bar, contextlib.closing(outcomes):
            for outcome in outcomes:
                bar.advance()
                yield outcome

    def summed(
        self, function: Callable[[Task], Value], tasks: Sequence[Task], *, title: str = "photos"
    ) -> tuple[Value | None, list[Failure]]:
        """The sum of ``function(task)`` over all tasks, see `clusters.sums`."""
        from skyline_viz.running.clusters.sums import summed  # noqa: PLC0415 - which imports this

        return summed(self, function, tasks, title=title)

    def check_shared(self, folder: Path, how: str = "name") -> None:
        """Make sure that workers see the very folder that this program sees.

        Args:
            folder: The folder; this program may write into it.
            how: How another one is named, for the sentence.

        Raises:
            ClusterError: One of them sees another one, or none, or does not answer.
        """
        with tempfile.NamedTemporaryFile(dir=folder, prefix=".shared-") as mark:
            seen = every_worker(self.client, _exists_there, str(folder / Path(mark.name).name))
        for worker, there in seen.items():
            if there is not True:
                raise ClusterError(
                    f"the worker {worker} does not see the folder {folder}; {how} one that all "
                    f"machines share, by its whole path."
                )

    def _outcomes(
        self, function: Callable[[Task], Value], tasks: Sequence[Task]
    ) -> Generator[Value | Failure, None, None]:
        waiting: deque[tuple[Sequence[Task], Any]] = deque()
        under_way: set[str] = set()  # names of those tasks that have not ended, as far as told
        ended: SimpleQueue[Any] = SimpleQueue()
        threads = _Threads(self.client)
        size = max(1, min(_MOST_A_TASK, len(tasks) // (_A_THREAD * threads.number())))
        coming = (tasks[first : first + size] for first in range(0, len(tasks), size))
        try:
            send = self._sender(function)
            while True:
                while not ended.empty():
                    under_way.discard(ended.get().key)
                number = threads.number()  # lower than before where workers have gone
                room = min(_A_THREAD * number - len(under_way), _KEPT * number - len(waiting))
                for part in itertools.islice(coming, max(0, room)):
                    waiting.append((part, future := send(part)))
                    under_way.add(future.key)
                    future.add_done_callback(ended.put)
                if not waiting:
                    return
                if waiting[0][1].key in under_way:  # others go on behind a slow photo
                    under_way.discard(ended.get().key)
                else:
                    yield from self._of_part(send, *waiting.popleft())
        except Unsendable as error:
            raise BatchError(str(error)) from error
        finally:
            with contextlib.suppress(Exception):  # of a cluster that is gone
                self.client.cancel([future for _, future in waiting], force=True)

    def _sender(self, function: Callable[[Task], Value]) -> Callable[[Sequence[Task]], Any]:
        """What sends photos to a worker, and gives dask's word for what they will come to."""
        run, numbers = secrets.token_hex(8), itertools.count()  # no two tasks have the same name
        work = self.client.submit(bytes, to_send(function), key=f"work-{run}")

        def send(part: Sequence[Task]) -> Any:  # noqa: ANN401
            told = packed([*part], part[0].name)
            key = f"photos-{run}-{next(numbers)}"
            with translated():
                return self.client.submit(_attempt_there, work, told, key=key, pure=False)

        return send

    def _of_part(
        self,
        send: Callable[[Sequence[Task]], Any],
        part: Sequence[Task],
        future: Any,  # noqa: ANN401
    ) -> Iterator[Value | Failure]:
        """What photos came to; where workers died of one of them, each goes alone."""
        try:
            with translated():
                outcomes, notes = unpacked(future.result())
        except dask("distributed").scheduler.KilledWorker as error:
            if len(part) > 1:
                for task in part:
                    yield from self._of_part(send, [task], send([task]))
                return
            died = f"{error.allowed_failures + 1} workers died of it, one by one"
            yield Failure(part[0].name, f"{died}, probably for want of memory")
            return
        for one in notes:
            note(one)
        for outcome in outcomes:
            if isinstance(outcome, OSError):
                raise outcome
            yield outcome


class _Threads:
    """How many threads there are, as workers come and go."""

    def __init__(self, client: Any) -> None:  # noqa: ANN401
        self._client = client
        self._seen = -_COUNT_EVERY
        self._number = 1

    def number(self) -> int:
        if monotonic() - self._seen > _COUNT_EVERY:
            with contextlib.suppress(OSError, TimeoutError):  # of a scheduler that is busy
                self._number = max(1, sum(self._client.nthreads().values()))
            self._seen = monotonic()
        return self._number


def to_send(function: Callable[..., object]) -> bytes:
    """A function for workers, with what they need to know before they run it, see `prepared`.

    Raises:
        Unsendable: Part of it cannot be sent.
    """
    named = getattr(getattr(function, "func", function), "__name__", "the work")
    return packed((function, versions(), photo_limit()), str(named))


@contextlib.contextmanager
def translated() -> Iterator[None]:
    """Turn what workers and their connection raise into `BatchError`, but for photos' own."""
    client = dask("distributed").client
    try:
        yield
    except (ClusterError, Unsendable, ImportError) as error:
        raise BatchError(said(error)) from error
    except (OSError, client.FutureCancelledError, client.ClosedClientError) as error:
        raise BatchError(
            "the cluster is gone; the same command goes on when it is back."
        ) from error


def _exists_there(file: str) -> bool:
    return Path(file).exists()


def _attempt_there(work: bytes, told: bytes) -> bytes:
    """The outcomes of photos on a worker, and what was noted on the way.

    Raises:
        ClusterError: The worker has other versions than the program that sent the work.
        Unsendable: The work cannot be unpacked here, or an outcome cannot be sent back.
    """
    function = prepared(work)
    outcomes: list[object] = []
    notes: list[str] = []
    with heard_by(notes.append):
        for task in unpacked(told):
            try:
                outcomes.append(attempt(function, task))
            except OSError as error:  # a full disk: told as what it is, not as a lost connection
                outcomes.append(error)
    return packed((outcomes, notes), "what was found")


@lru_cache(maxsize=1)
def prepared(work: bytes) -> Callable[[Any], Any]:
    """The function of `to_send`, once a worker, which is prepared as `batch` does its processes.

    Raises:
        ClusterError: This worker has other versions than the program that sent it.
        Unsendable: It cannot be unpacked here.
    """
    function, theirs, megapixels = unpacked(work)
    check_here(theirs)
    import cv2  # noqa: PLC0415 - only processes that work on photos pay for it

    cv2.setNumThreads(1)
    keep_freed()
    limit_photos(megapixels)
    found: Callable[[Any], Any] = function
    return found
