"""Whether a network may be opened here: it is tried in a process of its own first.

A file that is made to, or damaged by chance, makes OpenCV crash, run for ever, or take all memory,
and takes along whatever program reads it. So each network runs once in `child`, which may
do all of that. What it survived is remembered by content for as long as this process lives, and
goes to workers with the methods that use it.
"""

from __future__ import annotations

import hashlib
import subprocess
import sys
from pathlib import Path

from skyline_viz.networks.child import MEMORY
from skyline_viz.system.aftermath import ended, started
from skyline_viz.system.settings import MethodError

SECONDS = 120
"""Processor time that opening and one run may take."""

_WALL_SECONDS = 600.0  # that it may take on a machine that is busy
_MEMORY = 4 << 30  # bytes besides those of the file, eight times: weights are copied and reordered
_SIGKILL, _SIGXCPU = 9, 24
_CHILD = Path(__file__).with_name("child.py")

_survived: set[str] = set()


def digest_of(data: bytes, *, classic: bool = False) -> str:
    """What the content of a network's file, and which engine runs it, is remembered by."""
    return hashlib.sha256(data).hexdigest() + (" classic" if classic else "")


def try_network(data: bytes, shape: tuple[int, ...], name: str, *, classic: bool = False) -> str:
    """Try a network, unless one of the same content has been tried.

    Args:
        data: The content of its file.
        shape: An input that it takes.
        name: What to call it in messages.
        classic: Whether OpenCV's classic engine will run it, see `child.opened`.

    Returns:
        Its digest, for `remember`.

    Raises:
        MethodError: It crashed, did not come to an end, or took too much memory.
    """
    digest = digest_of(data, classic=classic)
    if digest in _survived:
        return digest
    limits = [_MEMORY + 8 * len(data), SECONDS, int(classic), *shape]
    process = started(
        [sys.executable, "-P", _CHILD, *map(str, limits)],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    late = False
    try:
        process.communicate(data, timeout=_WALL_SECONDS)
    except subprocess.TimeoutExpired:
        late = True
    finally:
        ended(process)
    if late or process.returncode == -_SIGXCPU:
        raise MethodError(f"{name} does not come to an end: it was stopped after {SECONDS} s.")
    if process.returncode in (MEMORY, -_SIGKILL):  # the latter by a system that ran out of it
        raise MethodError(f"{name} wants more than {limits[0] >> 30} GB of memory.")
    if process.returncode:
        raise MethodError(f"{name} is damaged: opening it crashes OpenCV.")
    _survived.add(digest)
    return digest


def survived(digest: str) -> bool:
    """Whether the network of a digest was survived, as far as this process knows."""
    return digest in _survived


def remember(digest: str) -> None:
    """Take it for granted that the network of this digest was survived."""
    _survived.add(digest)
