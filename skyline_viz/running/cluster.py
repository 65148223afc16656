"""Running a function over many photos on a cluster, as `batch.run` does in processes.

The scheduler is dask's. Photos travel as their names, eight at the most in a task of dask's; what
comes back is what the function gives. The function itself is the result of a task, so that it is
sent to a worker once, and a worker that comes later gets it, too. A few tasks a thread are under
way at a time. The photos of a worker that is lost are done by others.
"""

from __future__ import annotations

import contextlib
import itertools
import platform
import re
import secrets
import socket
import tempfile
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from multiprocessing import resource_tracker
from pathlib import Path
from time import monotonic
from typing import Any, TypeVar

from skyline_viz._version import __version__
from skyline_viz.running.batch import BatchError, Failure, Named, attempt
from skyline_viz.running.progress import ProgressBar
from skyline_viz.running.resume import digest_of
from skyline_viz.running.sending import Unsendable, packed, unpacked
from skyline_viz.storage.addresses import needed
from skyline_viz.system.aftermath import passing_folder
from skyline_viz.system.endings import held_back
from skyline_viz.system.memory import keep_freed, limit_photos, photo_limit
from skyline_viz.system.notes import heard_by, note

LOCAL = re.compile(r"local:([1-9]\d{0,2})")
"""A cluster of so many processes on this machine, for a try."""

_ADDRESS = re.compile(r"(tcp|tls|ws|wss|ucx)://\S+:\d+")
_A_THREAD = 3  # tasks under way for each thread of a worker
_MOST_A_TASK = 8  # photos: a task costs the scheduler and its client some milliseconds
_COUNT_EVERY = 10.0  # seconds between two looks at how many threads there are
_FIRST_WORKER = 600.0  # seconds to wait for one
_PATIENCE = "10s"  # of connecting
_ASKED, _REACHING = (
    3,
    2.0,
)  # workers that are connected to, to see whether one can; seconds for each

_SETTINGS = {
    "distributed.worker.profile.enabled": False,  # of photos it says nothing, and takes time
    "distributed.admin.low-level-log-length": 1000,  # else it grows with the photos
    "distributed.admin.system-monitor.interval": "5s",
    "distributed.admin.tick.interval": "1s",  # 50 a second take a thirtieth of a processor
    "distributed.comm.timeouts.connect": "10s",
    "distributed.scheduler.work-stealing": False,  # photos cost alike, and wait for no data
}
"""What differs from dask's own on a cluster of ours."""

Task = TypeVar("Task", bound=Named)
Value = TypeVar("Value")


class ClusterError(ValueError):
    """There is no such cluster, or it cannot be worked with; the message is one sentence."""


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
        """The sum of ``function(task)`` over all tasks, see `cluster_sums.summed`."""
        from skyline_viz.running.cluster_sums import summed  # noqa: PLC0415 - which imports this

        return summed(self, function, tasks, title=title)

    def check_shared(self, folder: Path, how: str = "name") -> None:
        """Make sure that workers see the very folder that this program sees.

        Args:
            folder: The folder; this program may write into it.
            how: How another one is named, for the sentence.

        Raises:
            ClusterError: One of them sees another one, or none.
        """
        with tempfile.NamedTemporaryFile(dir=folder, prefix=".shared-") as mark:
            seen = self.client.run(_exists_there, str(folder / Path(mark.name).name))
        for worker, there in seen.items():
            if not there:
                raise ClusterError(
                    f"the worker {worker} does not see the folder {folder}; {how} one that all "
                    f"machines share, by its whole path."
                )

    def _outcomes(
        self, function: Callable[[Task], Value], tasks: Sequence[Task]
    ) -> Generator[Value | Failure, None, None]:
        waiting: deque[tuple[Sequence[Task], Any]] = deque()
        threads = _Threads(self.client)
        size = max(1, min(_MOST_A_TASK, len(tasks) // threads.most()))
        coming = (tasks[first : first + size] for first in range(0, len(tasks), size))
        try:
            send = self._sender(function)
            while True:
                room = threads.most() - len(waiting)  # under 0 where workers have gone
                for part in itertools.islice(coming, max(0, room)):
                    waiting.append((part, send(part)))
                if not waiting:
                    return
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
    """How many tasks may be under way, as workers come and go."""

    def __init__(self, client: Any) -> None:  # noqa: ANN401
        self._client = client
        self._seen = -_COUNT_EVERY
        self._number = 1

    def most(self) -> int:
        if monotonic() - self._seen > _COUNT_EVERY:
            with contextlib.suppress(OSError, TimeoutError):  # of a scheduler that is busy
                self._number = max(1, sum(self._client.nthreads().values()))
            self._seen = monotonic()
        return _A_THREAD * self._number


@contextlib.contextmanager
def cluster_at(where: str) -> Iterator[Cluster]:
    """Connect to a cluster, or start one on this machine that lasts as long as the block.

    Args:
        where: Address of a scheduler, ``tcp://host:port``; or ``local:N`` for N processes here.

    Raises:
        ClusterError: Nobody answers there, or workers have other versions than this program.
        StorageError: Dask is not installed.
    """
    local = LOCAL.fullmatch(where)
    if not local and not _ADDRESS.fullmatch(where):
        raise ClusterError(
            f"a cluster is tcp://HOST:PORT, the address of its scheduler, or local:N for N "
            f"processes on this machine, not {where}."
        )
    distributed = dask("distributed")
    with contextlib.ExitStack() as until_done:
        until_done.enter_context(dask("dask").config.set(_SETTINGS))
        if local:
            where = until_done.enter_context(_started(int(local[1]))).scheduler_address
        try:
            client = until_done.enter_context(
                distributed.Client(where, set_as_default=False, timeout=_PATIENCE)
            )
        except (OSError, TimeoutError) as error:
            raise ClusterError(f"no cluster answers at {where}.") from error
        try:
            client.wait_for_workers(1, timeout=_FIRST_WORKER)
        except TimeoutError as error:
            raise ClusterError(f"the cluster at {where} has no worker.") from error
        _check(client.run(versions, on_error="return"))
        client.direct_to_workers = reaches([*client.scheduler_info(-1)["workers"]])
        yield Cluster(client)


def reaches(workers: Sequence[str]) -> bool:
    """Whether this machine reaches workers, so that what they find need not pass the scheduler."""
    for worker in workers[:_ASKED]:
        host, _, port = worker.rpartition("://")[2].rpartition(":")
        try:
            socket.create_connection((host.strip("[]"), int(port)), _REACHING).close()
        except (OSError, ValueError):
            return False
    return True


@contextlib.contextmanager
def _started(number: int) -> Iterator[Any]:
    """A cluster on this machine, which only this machine reaches."""
    resource_tracker.ensure_running()  # which lets SIGINT through again in the thread it starts in
    with (
        passing_folder() as scratch,
        dask("dask").config.set({"temporary-directory": str(scratch)}),  # of the scheduler
    ):
        with held_back("SIGINT", "SIGHUP"):  # both reach all processes of a terminal
            cluster = dask("distributed").LocalCluster(
                n_workers=number,
                threads_per_worker=1,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
                local_directory=str(scratch),
                memory_limit=0,
                silence_logs=50,
            )
        with cluster:
            yield cluster


def dask(module: str) -> Any:  # noqa: ANN401
    """A module of dask, imported where a cluster is needed.

    Raises:
        StorageError: It is not installed.
    """
    return needed(module, "a cluster")


@lru_cache(maxsize=1)
def _versions() -> dict[str, str]:
    import cv2  # noqa: PLC0415 - only a cluster asks
    import numpy as np  # noqa: PLC0415

    return {
        "skyline-viz": f"{__version__} ({digest_of()[:8]})",
        "Python": ".".join(platform.python_version_tuple()[:2]),
        "numpy": np.__version__,
        "OpenCV": cv2.__version__,
    }


def versions() -> dict[str, str]:
    """Of all that lines depend on; of our code a digest, too."""
    return _versions()


def _check(told: dict[str, Any]) -> None:
    """Compare what workers have with what this program has.

    Raises:
        ClusterError: A worker has something else.
    """
    ours = versions()
    for worker, theirs in told.items():
        if isinstance(theirs, Exception):
            raise ClusterError(f"the worker {worker} {_lacking(theirs)}.")
        for name, version in ours.items():
            if theirs.get(name) != version:
                raise ClusterError(
                    f"the worker {worker} has {name} {theirs.get(name)}, and this program "
                    f"{version}; install the same versions on both."
                )


def _lacking(error: Exception) -> str:
    if isinstance(error, ImportError):
        return f"has no {error.name or 'skyline-viz'}; install skyline-viz[cluster] there"
    return f"cannot be worked with: {error}"


def _said(error: Exception) -> str:
    return f"a worker {_lacking(error)}." if isinstance(error, ImportError) else str(error)


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
    try:
        yield
    except (ClusterError, Unsendable, ImportError) as error:
        raise BatchError(_said(error)) from error
    except (OSError, dask("distributed").client.FutureCancelledError) as error:
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
    _check_here(theirs)
    import cv2  # noqa: PLC0415 - only processes that work on photos pay for it

    cv2.setNumThreads(1)
    keep_freed()
    limit_photos(megapixels)
    found: Callable[[Any], Any] = function
    return found


def _check_here(theirs: dict[str, str]) -> None:
    for name, version in versions().items():
        if theirs.get(name) != version:
            raise ClusterError(
                f"a worker has {name} {version}, and this program {theirs.get(name)}; "
                f"install the same versions on both."
            )
