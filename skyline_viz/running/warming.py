"""Compiled loops are loaded before the first photo, lest its time include that.

The first run ever compiles them, which takes some seconds, and says so; they are kept beside the
code. Of several processes that come to it at once, one compiles and the others wait.
"""

import contextlib
from collections.abc import Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from numba.core import event
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import cpu_target
from numba.core.runtime import rtsys

from skyline_viz.detector import Detector
from skyline_viz.system.memory import loading
from skyline_viz.system.notes import note
from skyline_viz.system.stand_ins import without

COMPILING = (
    "The detector's loops are compiled, which takes some seconds; later runs find them done."
)
"""What is noted when that is so."""

_LONGEST = 120.0  # seconds to wait for another process that compiles
_BLAS = "scipy.linalg.cython_blas"
"""Numba looks whether there is one, which takes five times as long as detecting. Our loops hold no
matrix products."""


@cache
def warm_up() -> None:
    """Load the compiled loops of this process, or compile and keep them.

    Other threads compile nothing meanwhile: numba would not be whole for them.
    """
    photo = np.full((32, 32, 3), 200, np.uint8)
    photo[16:] = 50
    with (
        global_compiler_lock,
        loading(),
        without(_BLAS),
        _without_compiler(),
        contextlib.ExitStack() as until_done,
        event.install_listener("numba:compile", _Compiling(until_done)),
    ):
        found = Detector().detect(photo)
        found.margins()
        _ = found.confidence  # what searches other lines


class _Compiling(event.Listener):  # type: ignore[misc]  # numba has no types
    """Hears that something is compiled, and not found done."""

    def __init__(self, until_done: contextlib.ExitStack) -> None:
        self.until_done = until_done
        self.begun = False

    def on_start(self, event: Any) -> None:  # noqa: ANN401
        """Say so, and wait until no other process compiles; what it has done is found then."""
        _restore_compiler()
        if self.begun:
            return
        self.begun = True
        from filelock import FileLock  # noqa: PLC0415  # once ever

        note(COMPILING)
        folder = event.data["dispatcher"].stats.cache_path
        with contextlib.suppress(OSError, NotImplementedError):  # then each compiles for itself
            Path(folder).mkdir(parents=True, exist_ok=True)
            self.until_done.enter_context(FileLock(Path(folder, "compiling.lock"), _LONGEST))

    def on_end(self, event: Any) -> None:  # noqa: ANN401
        """Nothing is to be done."""


@contextlib.contextmanager
def _without_compiler() -> Iterator[None]:
    """Keep numba from loading what only its compiler needs, which takes as long as four detections.

    It loads that whenever it looks for a kept loop, and again when it compiles one. A kept loop
    needs no more of it than what hands out memory.
    """
    context = cpu_target.target_context
    context.refresh = partial(rtsys.initialize, context)  # hides the method of its class
    try:
        yield
    finally:
        _restore_compiler()


def _restore_compiler() -> None:
    """Let numba load all of its compiler the next time that it wants to."""
    vars(cpu_target.target_context).pop("refresh", None)
