"""How much memory work on photos takes, and how much there is: counted in bytes, not in photos."""

from __future__ import annotations

import atexit
import contextlib
import ctypes
import gc
import os
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

BASE = 200_000_000
"""Bytes of a process before it has seen a photo: the program and its compiled loops."""

DETECTING = 32
"""Bytes a pixel at the worst moment of a detection: measured up to 32, on noise, where every third
pixel is an edge; 13 to 19 on photographs."""

RECORDING = 57
"""Bytes a pixel at the worst moment of recording a detection lean, measured in the same way."""

RECORDING_FULL = 160
"""Bytes a pixel at the worst moment of recording a detection in full."""

FULL_RECORDING = 36
"""Bytes a pixel that a full recording takes on the disk."""

FULL_MEGAPIXELS = 4.0
"""Million pixels in one recording that are kept in full unless more are asked for: 140 MB."""

SHARE = 0.8
"""Share of the free memory that work may count on."""

MAX_MEGAPIXELS = 150.0
"""Limit on a photo's size, in million pixels, unless this process has another one."""

_TRIM, _LARGEST = -1, -3
"""Options of glibc's allocator: free bytes at the end of its heap from which on they go back to the
system, and bytes of an array that is no part of that heap."""

_KEPT = {_TRIM: 256_000_000, _LARGEST: 64_000_000}
"""What they are where memory is kept."""

_ARRAY = 1_000_000
"""Bytes of arrays that are no part of the heap where it is not."""

_MEMINFO = Path("/proc/meminfo")
_GROUP = Path("/sys/fs/cgroup")


class _Limit:
    """The limit of this process, which commands set once, before they read the first photo."""

    megapixels = MAX_MEGAPIXELS


def photo_limit() -> float:
    """Largest photo that is read unless a reader says otherwise, in million pixels."""
    return _Limit.megapixels


def limit_photos(megapixels: float) -> None:
    """Set the limit of this process, and of the workers that it starts."""
    _Limit.megapixels = megapixels


def keep_freed() -> None:
    """Let this process keep memory that it frees, for the next array.

    By itself glibc gives arrays of some size back to the system at once. For the next one the
    system clears every page anew, which takes a tenth of the time that a photo takes, and half of
    that of a large one. A program decides on that, not a library; elsewhere nothing is done.
    """
    if allocator := _of_glibc("mallopt"):
        for option, value in _KEPT.items():
            allocator(option, value)


def give_back() -> None:
    """Give memory that this process has freed back to the system, and keep no arrays from now on.

    Rerun has an allocator of its own, which cannot use what is kept here. Where glibc is not,
    nothing is done.
    """
    allocator, trim = _of_glibc("mallopt"), _of_glibc("malloc_trim")
    if allocator and trim:
        allocator(_LARGEST, _ARRAY)
        trim(0)


def _of_glibc(name: str) -> Callable[..., int] | None:
    """A function of glibc; None where there is another library of C."""
    try:
        found: Callable[..., int] = getattr(ctypes.CDLL(None), name)
    except (OSError, TypeError, AttributeError):
        return None
    return found


@contextlib.contextmanager
def loading() -> Iterator[None]:
    """Look for no garbage in the block, in which much is loaded that is there to stay.

    Python would look through all of it again and again, which takes an eighth of the time.

    >>> with loading():
    ...     gc.isenabled()
    False
    """
    looked = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if looked:
            gc.enable()


@cache
def end_quickly() -> None:
    """Let this process end without a look for garbage among all that it has loaded.

    Python looks once more at the end, and takes as long for it as for ten detections. What is to
    be done at the end is done all the same.
    """
    atexit.register(gc.freeze)


def available() -> int | None:
    """Bytes of memory that are free on this machine, or left to this container; None if unknown."""
    known = [free for free in (_free_in_machine(), _free_in_container()) if free is not None]
    return min(known, default=None)


def fitting_workers(workers: int, largest: int, bytes_a_pixel: float, free: int | None) -> int:
    """How many of some workers fit into memory, at least one.

    Args:
        workers: How many there would be.
        largest: Pixels of the largest photo.
        bytes_a_pixel: What work on it takes.
        free: Bytes that are free; None if unknown, and all of them fit.

    >>> fitting_workers(4, 48_000_000, 32, free=5_000_000_000), fitting_workers(4, 10**9, 32, 10**9)
    (2, 1)
    """
    if free is None:
        return workers
    return max(min(workers, int(SHARE * free / needed(largest, bytes_a_pixel))), 1)


def needed(pixels: int, bytes_a_pixel: float) -> int:
    """Bytes that a process needs for a photo of so many pixels."""
    return BASE + int(pixels * bytes_a_pixel)


def in_words(count: float) -> str:
    """A number of bytes, for people.

    >>> in_words(4_830_000_000), in_words(36_400_000)
    ('4.8 GB', '36 MB')
    """
    return f"{count / 1e9:.1f} GB" if count >= 1e9 else f"{count / 1e6:.0f} MB"


def _free_in_machine() -> int | None:
    try:
        for line in _MEMINFO.read_text().splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) * 1024
        return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError, AttributeError):
        return None


def _free_in_container() -> int | None:
    try:
        most = (_GROUP / "memory.max").read_text().strip()
        used = int((_GROUP / "memory.current").read_text())
        return max(int(most) - used, 0) if most != "max" else None
    except (OSError, ValueError):
        return None
