"""Rerun with an allocator that gives memory back at once, for recordings of large photos.

By itself it keeps what it frees, some 70 MB of a photo of 12 megapixels; so does Arrow, which Rerun
imports. They take their settings from the environment when they are loaded, so this comes before
any other module of this folder. The viewer, a process of its own, does not get them: it would draw
more slowly.
"""

import os
import sys

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
