"""A progress bar for people who wait, and now and then a line where there is no terminal."""

import sys
import threading
from time import perf_counter
from typing import TYPE_CHECKING, Self

from skyline_viz.system.names import printable
from skyline_viz.system.telling import Telling, telling

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

PROGRESS_AFTER = 1.0
"""Seconds of work after which a progress bar appears."""

LINE_EVERY = 60.0
"""Seconds between two lines in a log: enough to see that a long run is alive."""

_COUNTED = ("photos", "scenes", "steps", "values")  # titles that say what is counted


class ProgressBar:
    """A bar on stderr, once the work has taken a while; a line a minute where that is no terminal.

    Lines that are printed meanwhile appear above it. Work behind somebody's back, in another thread
    than the first, has none. With ``--verbose`` there is a line for each photo instead, and with
    ``--quiet`` nothing.
    """

    def __init__(self, total: int, title: str) -> None:
        self._total = total
        self._title = title
        self._done = 0
        self._began = self._told = perf_counter()
        self._shown: tuple[Progress, TaskID] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._shown:
            self._shown[0].stop()

    def advance(self, what: str = "") -> None:
        """Count one more photo.

        Args:
            what: Its name.
        """
        self._done += 1
        now = perf_counter()
        much = telling() if _is_first_thread() else Telling.RESULTS
        if much == Telling.EVERYTHING:
            self._tell_one(now - self._began, what)
        elif self._shown is None and self._done < self._total and much == Telling.USUAL:
            if sys.stderr.isatty():
                if now - self._began < PROGRESS_AFTER:
                    return
                self._shown = self._show()
            elif now - self._told >= LINE_EVERY:
                self._told = now
                self._tell(now - self._began)
        if self._shown:
            progress, task = self._shown
            progress.update(task, completed=self._done)

    def _tell_one(self, seconds: float, what: str) -> None:
        """Write a line about a photo that is done."""
        named = f": {printable(what)}" if what else ""
        sys.stderr.write(f"{self._how_many()} after {seconds:.1f} s{named}\n")
        sys.stderr.flush()

    def _tell(self, seconds: float) -> None:
        """Write a line into a log."""
        minutes = seconds / 60
        left = minutes / self._done * (self._total - self._done)
        told = f"{self._how_many()} after {minutes:.0f} min, about {left:.0f} min left"
        sys.stderr.write(f"{printable(told)}\n")
        sys.stderr.flush()

    def _how_many(self) -> str:
        number = f"{self._done} of {self._total}"
        if self._title in _COUNTED:
            return f"{number} {self._title}"
        return f"{self._title}: {number}"

    def _show(self) -> "tuple[Progress, TaskID]":
        from rich.console import Console  # noqa: PLC0415  # a single photo never needs it
        from rich.progress import (  # noqa: PLC0415
            BarColumn,
            MofNCompleteColumn,
            Progress,
            TextColumn,
            TimeRemainingColumn,
        )

        progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            console=Console(stderr=True),
            transient=True,
            redirect_stdout=sys.stdout.isatty(),  # else lines meant for a pipe would end up here
        )
        progress.start()
        return progress, progress.add_task(self._title, total=self._total)


def _is_first_thread() -> bool:
    return threading.current_thread() is threading.main_thread()
