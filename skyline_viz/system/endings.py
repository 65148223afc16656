"""How programs are asked to end: Ctrl-C, SIGTERM, SIGHUP. All of them have the same effect."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

ASKING = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)
"""The signals: of Ctrl-C, of `kill` and whatever runs batches, and of a terminal that closes."""


class AskedToEnd(KeyboardInterrupt):
    """A signal asked the program to end; whatever cleans up after Ctrl-C does so after it, too."""

    def __init__(self, number: int) -> None:
        super().__init__(signal.Signals(number).name)
        self.number = number
        """Of the signal."""


@contextmanager
def asked_by_signals() -> Iterator[None]:
    """Have SIGTERM and SIGHUP raise `AskedToEnd` in the main thread, as Ctrl-C raises its parent.

    Signals that somebody has set to be ignored, as ``nohup`` does, stay ignored.
    """

    def ask(number: int, _: FrameType | None) -> None:
        raise AskedToEnd(number)

    with _handled(ask, [one for one in ASKING if one != signal.SIGINT]):
        yield


@contextmanager
def told_by_signals(tell: Callable[[], object]) -> Iterator[None]:
    """Have signals call a function instead of cutting the block short.

    Args:
        tell: Lets the block end soon.
    """
    with _handled(lambda *_: tell(), ASKING):
        yield


@contextmanager
def held_back(*names: str) -> Iterator[None]:
    """Let signals arrive only after the block: here it must not break off.

    Args:
        names: Of the signals; all that ask to end unless given.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    numbers = [getattr(signal, name) for name in names] or ASKING
    before = signal.pthread_sigmask(signal.SIG_BLOCK, numbers)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _handled(
    handler: Callable[[int, FrameType | None], object], numbers: list[int] | tuple[int, ...]
) -> Iterator[None]:
    if threading.current_thread() is not threading.main_thread():  # which alone may set handlers
        yield
        return
    before = {one: signal.getsignal(one) for one in numbers}
    taken = [one for one in numbers if before[one] not in (signal.SIG_IGN, None)]
    for one in taken:
        signal.signal(one, handler)
    try:
        yield
    finally:
        for one in taken:
            signal.signal(one, before[one])
