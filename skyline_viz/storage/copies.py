"""Data sets of a storage as folders of this machine: copies, which are brought up to date.

A data set is told by the names and headers of all its files, photos and truths alike, so that they
have to be at hand. A copy lies in the folder of caches, ``SKYLINE_VIZ_CACHE`` or the user's. What a
storage says is as it was is not downloaded again, and what is gone there goes here. Where the disk
would not hold it nothing is copied. Copies that nobody has used for a month go.

A file that cannot be had does not cost the others. In its place lies one that holds nothing, so
that photo and truth still find each other by their names; `lost_in` says why. Where most files are
lost, or downloads break off one after the other, there is an outage, and the copy is refused.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sys
import time
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import replace
from pathlib import Path, PurePosixPath
from typing import Any, Protocol, Self
from urllib.parse import quote

from skyline_viz.files import make_folder, replacing, write_text
from skyline_viz.storage.addresses import StorageError, scheme
from skyline_viz.storage.copy_names import name_of, remember
from skyline_viz.storage.fetching import OutageError, fetch
from skyline_viz.storage.listing import Listed, files_at, is_photo
from skyline_viz.storage.parts import WEB, file_part
from skyline_viz.system.memory import in_words

CACHE = "SKYLINE_VIZ_CACHE"
"""Variable of the environment that names the folder of caches."""

KEPT = 30 * 86400.0
"""Seconds that a copy stays that nobody uses."""

_STATE = ".copied.json"  # hidden, so that no data set holds it
_THREADS = 8  # downloads at a time
_BROKEN_OFF = 2 * _THREADS  # downloads one after the other that are an outage
_MOST_OF_DISK = 0.9  # of what is free
_WEB_FILES = (".csv", ".json", ".jsonl", ".parquet", ".xml")  # there names alone tell of files
_LONGEST = 200  # bytes of a name in a folder
_NOTHING = {".csv": "column,row,visible\n", ".json": '{"format": "skyline"}'}
"""Lines of skylines without a column: by how they begin these are told from other texts."""


class Bar(Protocol):
    """What shows how far a copy is."""

    def __enter__(self) -> Self:
        """Begin."""

    def __exit__(self, *_: object) -> None:
        """End."""

    def advance(self, what: str = "") -> None:
        """Count one more file."""


def copied(address: str, bar: Callable[[int, str], Bar] | None = None) -> Path:
    """The folder of this machine that holds what is below an address; or one file.

    Args:
        address: A folder, a prefix, an archive or a file.
        bar: Makes what shows the progress, of a number of files and a title.

    Raises:
        StorageError: It is missing or empty, a single file or most of many cannot be had, or the
            disk is small.
        OSError: It cannot be written.
    """
    home = caches() / hashlib.sha256(address.encode()).hexdigest()[:16]
    target = home / name_of(address)
    remember(target, address)
    if _is_file(file_part(address)):
        _write(target, Listed(address))
        return target
    files = dict(files_at(address))
    if not files:
        raise StorageError(f"{address} holds no file.")
    if alone := files.get(""):
        _write(target, alone)
        return target
    _forget_old(home)
    _bring_up_to_date(target, _by_names_here(files), address, bar)
    return target


def lost_in(folder: Path) -> dict[Path, str]:
    """The files of a copy that could not be had, each with the reason, in a sentence.

    Any other folder has none.
    """
    return {folder / own: reason for own, reason in _read_state(folder, "lost").items()}


def _bring_up_to_date(
    target: Path,
    files: Mapping[str, Listed],
    address: str,
    bar: Callable[[int, str], Bar] | None,
) -> None:
    known = _read_state(target, "stamps")
    news = {
        own: one
        for own, one in files.items()
        if not one.stamp or known.get(own) != one.stamp or not (target / own).is_file()
    }
    make_folder(target)
    size = sum(one.size or 0 for one in news.values())
    check_room(size, address)
    _write_state(target, {own: one for own, one in known.items() if own in files}, {})
    title = f"copying {in_words(size)}" if size else "copying"
    with (bar or _Silent)(len(news), title) as shown:
        lost = _download(target, news, len(files), address, shown)
    for own in lost:
        write_text(target / own, _NOTHING.get(PurePosixPath(own).suffix.lower(), ""))
    for path in target.rglob("*"):
        own = path.relative_to(target).as_posix()
        if path.is_file() and own not in files and own != _STATE:
            path.unlink(missing_ok=True)
    _write_state(target, {own: one.stamp for own, one in files.items() if own not in lost}, lost)


def _download(
    target: Path, news: Mapping[str, Listed], whole: int, address: str, bar: Bar
) -> dict[str, str]:
    """Download files; return those that cannot be had, with the reasons.

    Raises:
        StorageError: There is an outage, or most files are lost.
    """
    lost: dict[str, str] = {}
    broken_off = 0
    threads = ThreadPoolExecutor(_THREADS)
    try:
        waiting = {threads.submit(_write, target / own, one): own for own, one in news.items()}
        for done in as_completed(waiting):
            try:
                done.result()
                broken_off = 0
            except StorageError as error:
                lost[waiting[done]] = str(error)
                broken_off += isinstance(error, OutageError)
                if broken_off == _BROKEN_OFF or 2 * len(lost) > whole:
                    raise StorageError(
                        f"{address} cannot be copied: {len(lost)} of its {whole} files could not "
                        f"be had, the last of them because {error}"
                    ) from error
            bar.advance(waiting[done])
    finally:
        threads.shutdown(cancel_futures=True)
    return lost


class _Silent:
    """Shows nothing."""

    def __init__(self, total: int, title: str) -> None:
        pass

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def advance(self, what: str = "") -> None:
        pass


def _is_file(inner: str) -> bool:
    """Whether an address is told to be a file by its name, so that nothing is asked about it."""
    ending = PurePosixPath(inner).suffix.lower()
    return is_photo(inner) or (scheme(inner) in WEB and ending in _WEB_FILES)


def _write(path: Path, one: Listed) -> None:
    if one.fault:
        raise StorageError(one.fault)
    data = fetch(one.address, one.size)
    with replacing(path) as temporary:
        temporary.write_bytes(data)


def _by_names_here(files: Mapping[str, Listed]) -> dict[str, Listed]:
    """Files by names that they can have here; those that have another one there are lost."""
    above = {str(one) for own in files for one in PurePosixPath(own).parents}
    named: dict[str, Listed] = {}
    for own, one in files.items():
        if not _is_odd(own) and own not in above:
            named[own] = one
            continue
        here = "/".join(map(_spelt, own.split("/")))
        while here in files or here in above or here in named:
            here = f"%{here}"
        reason = f"{one.address} has a name that no file can have here."
        named[here] = replace(one, fault=one.fault or reason)
    return named


def _is_odd(own: str) -> bool:
    """Whether no file here can have a path, or none that is the same everywhere."""
    parts = own.split("/")
    outside = {"", ".", ".."} & {*parts} or any(one in own for one in "\\:\0")
    return bool(outside) or any(len(one.encode(errors="replace")) > _LONGEST for one in parts)


def _spelt(part: str) -> str:
    """A name that a file can have here, with its ending."""
    stem, dot, ending = part.rpartition(".")
    if part in ("", ".", ".."):
        return "%2E" * len(part) or "%2F"
    plain = quote(part, safe=" ")
    if len(plain) <= _LONGEST:
        return plain
    digest = hashlib.sha256(part.encode(errors="surrogatepass")).hexdigest()[:16]
    return f"{quote(stem[:20], safe=' ')}-{digest}{dot}{quote(ending[:20], safe=' ')}"


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


def _read_state(target: Path, part: str) -> dict[str, str]:
    """The stamps of the files of a copy, or what is lost."""
    try:
        told: Any = json.loads((target / _STATE).read_text(encoding="utf-8"))[part]
    except (OSError, ValueError, LookupError, TypeError):
        return {}
    return told if isinstance(told, dict) else {}


def _write_state(target: Path, stamps: Mapping[str, str], lost: Mapping[str, str]) -> None:
    write_text(target / _STATE, json.dumps({"stamps": stamps, "lost": lost}))


def _forget_old(home: Path) -> None:
    """Remove copies that nobody has asked for in a month, but for one."""
    for state in home.parent.glob(f"{'[0-9a-f]' * 16}/*/{_STATE}"):
        if state.parent.parent != home and time.time() - state.stat().st_mtime > KEPT:
            shutil.rmtree(state.parent.parent, ignore_errors=True)
