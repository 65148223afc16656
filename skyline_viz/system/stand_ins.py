"""Keeping libraries from importing others that they do not need here. Imports nothing but Python.

Some import a large package to see whether it is there, or for a check that is made elsewhere.
Together that takes more time than our detector does for a photo.
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType


@contextmanager
def without(name: str, instead: ModuleType | None = None) -> Iterator[None]:
    """Let no import in the block find a module, or another one, unless it has been imported before.

    Args:
        name: The module.
        instead: What is found; unless given, Python says that there is none.

    >>> with without("this"):
    ...     import this
    Traceback (most recent call last):
    ModuleNotFoundError: import of this halted; None in sys.modules
    """
    if name in sys.modules:
        yield
        return
    sys.modules[name] = instead  # type: ignore[assignment]  # None is how Python marks what is not there
    try:
        yield
    finally:
        sys.modules.pop(name, None)
