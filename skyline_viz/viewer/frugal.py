"""Rerun with an allocator that gives memory back at once, for recordings of large photos.

By itself it keeps what it frees, some 70 MB of a photo of 12 megapixels; so does Arrow, which Rerun
imports. They take their settings from the environment when they are loaded, so this comes before
any other module of this folder. The viewer, a process of its own, does not get them: it would draw
more slowly.

Arrow also imports pandas, where that is installed, to look whether an array is one of pandas. That
is never so here, and takes 40 MB.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_SETTING = "MIMALLOC_ARENA_RESERVE"
"""Memory that is fetched from the system ahead, and kept."""


def import_frugally() -> None:
    """Import Rerun so, unless it has been imported before, or somebody has chosen otherwise."""
    if "rerun" in sys.modules or _SETTING in os.environ:
        return
    os.environ[_SETTING] = "0"
    try:
        import rerun  # noqa: F401, PLC0415
    finally:
        del os.environ[_SETTING]
    import numpy as np  # noqa: PLC0415
    import pyarrow as pa  # noqa: PLC0415

    with _without_pandas():
        pa.array(np.zeros(1))  # it looks for pandas once for arrays,
        pa.array([""])  # and once for lists


class _Missing:
    """Finds that there is no pandas."""

    @staticmethod
    def find_spec(name: str, *_: object) -> None:
        """See `importlib.abc.MetaPathFinder`."""
        if name == "pandas":
            raise ModuleNotFoundError("left out to save memory", name=name)


@contextmanager
def _without_pandas() -> Iterator[None]:
    """Let nobody find pandas in the block."""
    sys.meta_path.insert(0, _Missing)
    try:
        yield
    finally:
        sys.meta_path.remove(_Missing)
