"""Running a function over many photos: in order, in bounded memory, past the bad ones."""

import contextlib
import multiprocessing
import os
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextvars import ContextVar
from dataclasses import dataclass
from itertools import chain, islice
from multiprocessing.synchronize import Event
from typing import Protocol, TypeVar

from skyline_viz.files import FULL
from skyline_viz.running.progress import ProgressBar
from skyline_viz.running.sending import Unsendable, packed, unpacked
from skyline_viz.system import aftermath
from skyline_viz.system.endings import held_back
from skyline_viz.system.memory import keep_freed, limit_photos, photo_limit
from skyline_viz.system.notes import heard_by, note

_HANDFUL = 24
"""Photos below which starting processes costs more than it saves."""

_MOST_WORKERS = 4
"""Processes at most, unless asked for more: each holds a photo and all its stages."""


class Named(Protocol):
    """Something to work on."""

    @property
    def name(self) -> str:
        """What to call it when it fails."""


@dataclass(frozen=True)
class Failure:
    """A photo that could not be worked on."""

    name: str
    """Name of the photo."""

    reason: str
    """Why, in one sentence."""

    def __str__(self) -> str:
        first = self.reason.replace(os.sep, "/").split(" ", 1)[0]
        named = first.rsplit("/", 1)[-1] in (self.name, self.name.rsplit("/", 1)[-1]) or (
            f"/{self.name}." in f"/{self.reason}".replace(os.sep, "/")
        )
        text = self.reason if named else f"{self.name}: {self.reason}"
        return text if text.endswith(".") else f"{text}."


class BatchError(Exception):
    """No photo can be worked on any more; the message says why."""


Task = TypeVar("Task", bound=Named)
Value = TypeVar("Value")


class Executor(Protocol):
    """Something else than this machine's processes that works on photos, as a cluster is."""

    def run(
        self, function: Callable[[Task], Value], tasks: Sequence[Task], *, title: str = "photos"
    ) -> Iterator[Value | Failure]:
        """What `run` does."""

    def summed(
        self, function: Callable[[Task], Value], tasks: Sequence[Task], *, title: str = "photos"
    ) -> tuple[Value | None, list[Failure]]:
        """The sum of what `run` gives, None where that is nothing, and what failed."""


_elsewhere: ContextVar[Executor | None] = ContextVar("elsewhere", default=None)


@contextlib.contextmanager
def working_on(executor: Executor) -> Iterator[None]:
    """Let an executor do all that `run` is asked for in the block, whatever the workers."""
    before = _elsewhere.set(executor)
    try:
        yield
    finally:
        _elsewhere.reset(before)


def elsewhere() -> Executor | None:
    """What works in place of this machine's processes; None where nothing does."""
    return _elsewhere.get()


def run(
    function: Callable[[Task], Value],
    tasks: Sequence[Task],
    *,
    workers: int = 1,
    title: str = "photos",
) -> Iterator[Value | Failure]:
    """Yield ``function(task)`` for each task, in order, or the `Failure` that it ended in.

    With several workers the tasks, the values and the function are sent between processes, so all
    of them must be picklable; a few tasks a worker are under way at a time. On a terminal a
    progress bar appears on stderr when the work takes longer than a second. In a block of
    `working_on` all this is done there.

    Args:
        function: What to do; at the top level of a module, or a `functools.partial` of such.
        tasks: What to do it with.
        workers: Number of processes; 1 works in this one, 0 chooses by the number of tasks.
        title: What is counted, for the progress bar.

    Raises:
        ValueError: A negative number of workers.
        BatchError: A worker process died, or the work cannot be sent to one.
        OSError: The disk is full or read-only.
    """
    if (executor := elsewhere()) is not None:
        yield from executor.run(function, tasks, title=title)
        return
    workers = chosen_workers(workers, len(tasks))
    if workers == 1:
        outcomes = _one_by_one(function, tasks)
    else:
        outcomes = _in_processes(function, tasks, workers)
    with ProgressBar(len(tasks), title) as bar, contextlib.closing(outcomes):
        for number, outcome in enumerate(outcomes):
            bar.advance(tasks[number].name)
            yield outcome


def chosen_workers(workers: int, tasks: int) -> int:
    """Number of processes for a number of tasks; `workers` unless it is 0.

    >>> chosen_workers(0, tasks=3), chosen_workers(3, tasks=2)
    (1, 2)
    """
    if workers < 0:
        raise ValueError(f"workers is 0 or more, not {workers}")
    if workers == 0:
        workers = 1 if tasks < _HANDFUL else min(os.cpu_count() or 1, _MOST_WORKERS)
    return max(1, min(workers, tasks))


def attempt(function: Callable[[Task], Value], task: Task) -> Value | Failure:
    """``function(task)``, or the `Failure` that it ended in.

    Raises:
        OSError: The disk is full or read-only.
    """
    try:
        return function(task)
    except OSError as error:
        if error.errno in FULL:
            raise
        return Failure(task.name, sentence(error))
    except Exception as error:  # whatever is wrong with one photo, the others are worth their turn
        return Failure(task.name, sentence(error))


def sentence(error: BaseException) -> str:
    """What went wrong, on one line, for people.

    >>> sentence(FileNotFoundError(2, "No such file or directory", "a/b.jpg"))
    'a/b.jpg: no such file or directory'
    >>> sentence(KeyError("x"))
    "unexpected KeyError: 'x'"
    """
    ours = type(error).__module__.startswith(("skyline_viz", "annotate"))
    text = str(error) if ours else " ".join(str(error).split())  # ours is one line, with names
    if isinstance(error, OSError) and error.strerror:
        reason = error.strerror[0].lower() + error.strerror[1:]
        if not error.filename:
            return reason
        path = os.fsdecode(error.filename)
        folder, name = os.path.split(path)
        return f"{folder if name.startswith('.') and folder else path}: {reason}"
    if isinstance(error, MemoryError):
        return "it does not fit into memory"
    if text and (ours or type(error) in (ValueError, OSError)):
        return text
    return f"unexpected {type(error).__name__}: {text}"


def _one_by_one(
    function: Callable[[Task], Value], tasks: Sequence[Task]
) -> Generator[Value | Failure, None, None]:
    for task in tasks:
        yield attempt(function, task)


def _in_processes(
    function: Callable[[Task], Value], tasks: Sequence[Task], workers: int
) -> Generator[Value | Failure, None, None]:
    coming: Iterator[bytes] = (packed((function, task), task.name) for task in tasks)
    try:
        first = list(islice(coming, 1))  # what cannot be sent is found before there are processes
    except Unsendable as error:
        raise BatchError(str(error)) from error
    context = multiprocessing.get_context("spawn")  # works everywhere, and inherits no threads
    stop = context.Event()
    known = (stop, aftermath.for_workers(), photo_limit())
    pool = ProcessPoolExecutor(workers, context, initializer=_prepare_worker, initargs=known)
    waiting: deque[Future[bytes]] = deque()
    coming = chain(first, coming)
    try:
        while True:
            for task in coming:
                # both reach all processes of a terminal, and workers are to finish their photos:
                # they inherit that these are held back
                with held_back("SIGINT", "SIGHUP"):
                    waiting.append(pool.submit(_attempt_in_worker, task))
                if len(waiting) >= 2 * workers:
                    break
            if not waiting:
                return
            outcome, notes = unpacked(waiting.popleft().result())
            for one in notes:  # of its photos, which nobody hears in a worker
                note(one)
            yield outcome
    except Unsendable as error:
        raise BatchError(str(error)) from error
    except BrokenProcessPool:
        raise BatchError(
            "a worker process died, probably for want of memory; try fewer workers."
        ) from None
    finally:  # photos under way are finished, so that no file is left half-written
        stop.set()
        pool.shutdown(wait=True, cancel_futures=True)


class _Worker:
    """What a worker process knows."""

    stop: Event | None = None
    """Set when nobody waits for results any more."""


def _prepare_worker(stop: Event, news: aftermath.News, megapixels: float) -> None:
    aftermath.join(news)
    import cv2  # noqa: PLC0415  # only processes that work on photos pay for it

    cv2.setNumThreads(1)
    _Worker.stop = stop
    keep_freed()
    limit_photos(megapixels)


def _attempt_in_worker(work: bytes) -> bytes:
    """The outcome, and what was noted about photos on the way.

    Raises:
        Unsendable: The work cannot be unpacked here, or the outcome cannot be sent back.
    """
    function, task = unpacked(work)
    if _Worker.stop and _Worker.stop.is_set():
        return packed((Failure(task.name, "interrupted"), []), task.name)
    notes: list[str] = []
    with heard_by(notes.append):
        return packed((attempt(function, task), notes), task.name)
