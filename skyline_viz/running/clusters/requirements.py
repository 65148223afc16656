"""What a cluster needs: dask, and workers of the same versions as this program."""

from __future__ import annotations

import platform
from functools import lru_cache
from typing import Any

from skyline_viz._version import __version__
from skyline_viz.running.resume import digest_of
from skyline_viz.storage.addresses import needed


class ClusterError(ValueError):
    """There is no such cluster, or it cannot be worked with; the message is one sentence."""


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


def check(told: dict[str, Any]) -> None:
    """Compare what workers have with what this program has.

    Raises:
        ClusterError: A worker has something else.
    """
    ours = versions()
    for worker, theirs in told.items():
        if isinstance(theirs, Exception):
            raise ClusterError(f"the worker {worker} {lacking(theirs)}.")
        for name, version in ours.items():
            if theirs.get(name) != version:
                raise ClusterError(
                    f"the worker {worker} has {name} {theirs.get(name)}, and this program "
                    f"{version}; install the same versions on both."
                )


def lacking(error: Exception) -> str:
    """What a worker lacks, to go on a sentence that names it."""
    if isinstance(error, ImportError):
        return f"has no {error.name or 'skyline-viz'}; install skyline-viz[cluster] there"
    return f"cannot be worked with: {error}"


def said(error: Exception) -> str:
    """What went wrong in a worker, in a sentence."""
    return f"a worker {lacking(error)}." if isinstance(error, ImportError) else str(error)


def check_here(theirs: dict[str, str]) -> None:
    """Compare what a program has with what this worker has.

    Raises:
        ClusterError: It has something else.
    """
    for name, version in versions().items():
        if theirs.get(name) != version:
            raise ClusterError(
                f"a worker has {name} {version}, and this program {theirs.get(name)}; "
                f"install the same versions on both."
            )
