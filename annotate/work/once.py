"""What several people ask for at the same time is made once, and shared while anybody has it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable
from concurrent.futures import Future
from typing import Generic, TypeVar
from weakref import WeakValueDictionary

Value = TypeVar("Value")


class Once(Generic[Value]):
    """Values by all that they depend on. None is kept: it is gone when the last one lets it go."""

    def __init__(self) -> None:
        """Begin with none."""
        self._shared: WeakValueDictionary[Hashable, Value] = WeakValueDictionary()
        self._made: dict[Hashable, Future[Value]] = {}  # those that somebody is making
        self._lock = threading.Lock()

    def get(self, key: Hashable, make: Callable[[], Value]) -> Value:
        """A value, which is made unless somebody has it or is just making it.

        Args:
            key: All that it depends on.
            make: Makes it. What it raises is raised, also to those who wait.
        """
        with self._lock:
            shared = self._shared.get(key)
            if shared is not None:
                return shared
            future = self._made.get(key)
            if mine := future is None:
                future = self._made[key] = Future()
        if mine:
            self._make(key, make, future)
        return future.result()

    def _make(self, key: Hashable, make: Callable[[], Value], future: Future[Value]) -> None:
        try:
            value = make()
        except BaseException as error:
            with self._lock:
                del self._made[key]
            future.set_exception(error)
            return
        with self._lock:
            del self._made[key]
            self._shared[key] = value
        future.set_result(value)
