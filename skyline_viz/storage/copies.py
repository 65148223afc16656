"""Data sets of a storage as folders of this machine: copies, which are brought up to date.

A data set is told by the names and headers of all its files, photos and truths alike, so that they
have to be at hand. A copy lies in the folder of caches, ``SKYLINE_VIZ_CACHE`` or the user's. What a
storage says is as it was is not downloaded again, and what is gone there goes here. Where the disk
would not hold it nothing is copied. Copies that nobody has used for a month go.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path, PurePosixPath

from skyline_viz.files import make_folder, replacing, write_text
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.fetching import fetch
from skyline_viz.storage.listing import Listed, files_at, is_photo

CACHE = "SKYLINE_VIZ_CACHE"
"""Variable of the environment that names the folder of caches."""

_STATE = ".copied.json"  # hidden, so that no data set holds it
_THREADS = 8  # downloads at a time
_KEPT = 30 * 86400.0  # seconds that an unused copy stays
_MOST_OF_DISK = 0.9  # of what is free


def copied(address: str) -> Path:
    """The folder of this machine that holds what is below an address; or the file of one photo.

    Args:
        address: A folder, a prefix, an archive or a photo.

    Raises:
        StorageError: It is missing or empty, one of its files cannot be had, or the disk is small.
        OSError: It cannot be written.
    """
    inner, _, around = address.partition("::")
    name = PurePosixPath(inner.partition("?")[0]).name
    name = name if inner.partition("//")[2] else PurePosixPath(around).stem
    home = caches() / hashlib.sha256(address.encode()).hexdigest()[:16]
    target = home / (name or "photos")
    if is_photo(inner):
        _write(target, Listed(address))
        return target
    files = dict(files_at(address))
    if not files:
        raise StorageError(f"{address} holds no file.")
    if odd := [one for one in files if _leads_out(one)]:
        raise StorageError(f"{address} holds {odd[0]}, which is no name of a file here.")
    _forget_old(home)
    _bring_up_to_date(target, files, address)
    return target


def _bring_up_to_date(target: Path, files: dict[str, Listed], address: str) -> None:
    known = _read_state(target)
    news = [
        (target / own, one)
        for own, one in files.items()
        if not one.stamp or known.get(own) != one.stamp or not (target / own).is_file()
    ]
    make_folder(target)
    check_room(sum(one.size or 0 for _, one in news), address)
    _write_state(target, {own: one for own, one in known.items() if own in files})
    with ThreadPoolExecutor(_THREADS) as threads:
        for _ in threads.map(_write, *zip(*news, strict=True)) if news else ():
            pass
    for path in target.rglob("*"):
        own = path.relative_to(target).as_posix()
        if path.is_file() and own not in files and own != _STATE:
            path.unlink(missing_ok=True)
    _write_state(target, {own: one.stamp for own, one in files.items()})


def _write(path: Path, one: Listed) -> None:
    data = fetch(one.address, one.size)
    with replacing(path) as temporary:
        temporary.write_bytes(data)


def _leads_out(own: str) -> bool:
    parts = PurePosixPath(own).parts
    return not parts or ".." in parts or "\\" in own or ":" in own or "\0" in own


def caches() -> Path:
    """The folder of caches."""
    if named := os.environ.get(CACHE):
        return Path(named)
    usual = "LOCALAPPDATA" if sys.platform == "win32" else "XDG_CACHE_HOME"
    return Path(os.environ.get(usual) or Path.home() / ".cache", "skyline-viz")


def check_room(size: int, what: str) -> None:
    """Make sure that the folder of caches, which is made where it is missing, has room.

    Args:
        size: Bytes that are to be written.
        what: What they are, for the sentence.

    Raises:
        StorageError: The disk would not hold them.
        OSError: The folder cannot be made.
    """
    make_folder(caches())
    free = shutil.disk_usage(caches()).free
    if size > _MOST_OF_DISK * free:
        raise StorageError(
            f"{what} needs {size / 1e9:.1f} GB in {caches()}, where {free / 1e9:.1f} GB are "
            f"free; {CACHE} names another folder."
        )


def _read_state(target: Path) -> dict[str, str]:
    try:
        told = json.loads((target / _STATE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return told if isinstance(told, dict) else {}


def _write_state(target: Path, stamps: dict[str, str]) -> None:
    write_text(target / _STATE, json.dumps(stamps))


def _forget_old(home: Path) -> None:
    """Remove copies that nobody has asked for in a month, but for one."""
    for state in home.parent.glob(f"{'[0-9a-f]' * 16}/*/{_STATE}"):
        if state.parent.parent != home and time.time() - state.stat().st_mtime > _KEPT:
            shutil.rmtree(state.parent.parent, ignore_errors=True)
