"""Options that several commands share."""

from __future__ import annotations

import getpass
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, TypeAlias

import tyro

from annotate.store.labels import CONSENSUS
from skyline_viz.command_line.local import spelt_as_address
from skyline_viz.command_line.messages import UsageError, say

if TYPE_CHECKING:
    from annotate.store.store import Store

PROGRAM = "skyline-annotate"
"""The program's name."""

_LOCK = ".skyline-labels.lock"

PhotoFolder: TypeAlias = Annotated[Path, tyro.conf.Positional, tyro.conf.arg(metavar="DIR")]
"""The folder of the photos, in which their labels are kept."""

Annotator: TypeAlias = Annotated[str, tyro.conf.arg(metavar="NAME")]
"""Who; empty for whoever runs the command."""

Annotators: TypeAlias = Annotated[
    tuple[str, ...], tyro.conf.UseAppendAction, tyro.conf.arg(metavar="NAME")
]
"""Who, given once for each of them; none for whoever runs the command."""

HostNames: TypeAlias = Annotated[
    tuple[str, ...], tyro.conf.UseAppendAction, tyro.conf.arg(metavar="NAME")
]
"""Names of a machine, given once for each of them."""

FormatName: TypeAlias = Literal[
    "mask", "painted", "ch1", "csv", "json", "coco", "labelme", "cvat", "parquet"
]
"""A format in which labels leave and come back."""


def whoever(name: str) -> str:
    """An annotator's name, or that of the user.

    Raises:
        UsageError: There is none, or it is none that can be kept.
    """
    from annotate.store.labels import check_annotator

    if name.strip():
        try:
            return check_annotator(name.strip())
        except ValueError as error:
            raise UsageError(str(error)) from None
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        raise UsageError("who are you? Say it with --annotator NAME.") from None


def check_folder(folder: Path) -> Path:
    """Return a folder.

    Raises:
        UsageError: There is none.
    """
    if not folder.is_dir():
        reason = "is a file, not a folder" if folder.exists() else "does not exist"
        raise UsageError(f"{folder} {reason}.")
    return folder


def refuse_stored(folder: Path | None) -> None:
    """Refuse an address for a folder of photos.

    Raises:
        UsageError: It is one.
    """
    if folder is not None and (address := spelt_as_address(folder)):
        raise UsageError(
            f"{address} is an address, and labels are kept beside their photos, in a folder of "
            f"this machine; copy the photos into one, with aws s3 sync or the like."
        )


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep other programs from opening a folder meanwhile.

    Raises:
        UsageError: Another one has it open.
        StoreError: It cannot be written.
    """
    from filelock import FileLock, Timeout

    from annotate.store.database import StoreError

    lock = FileLock(folder / _LOCK, timeout=0)
    try:
        lock.acquire()
    except Timeout:
        raise UsageError(f"{folder} is open in another {PROGRAM}; close that one first.") from None
    except OSError as error:
        raise StoreError(
            f"{folder} cannot be written, and labels are kept in it: "
            f"{(error.strerror or str(error)).lower()}."
        ) from error
    with lock:
        yield


@contextmanager
def opened(folder: Path) -> Iterator[Store]:
    """The labels of a folder that has some, to be read.

    Raises:
        UsageError: There is no such folder, or it has no labels.
        StoreError: They cannot be opened.
    """
    from annotate.store.database import NAME, holds_something
    from annotate.store.store import Store

    if not holds_something(check_folder(folder) / NAME):
        raise UsageError(f"{folder} has no labels yet; make some: {PROGRAM} open {folder}.")
    store = Store(folder, reading=True)
    if store.fault:
        say(store.fault, PROGRAM)
    try:
        yield store
    finally:
        store.close()


def chosen_passes(store: Store, asked: Sequence[str]) -> list[tuple[str, int]]:
    """The passes that are meant, each once: those that were named, or all.

    Args:
        store: The labels.
        asked: Names of annotators, each with ``:2`` for their second pass, and so on.

    Raises:
        UsageError: There is no such pass.
    """
    found = store.passes()
    chosen = []
    for one in asked:
        who, colon, number = one.rpartition(":")
        numbered = (who, int(number)) if colon and number.isdecimal() else None
        meant = next((each for each in found if each in (numbered, (one, 1))), None)
        if meant is None:
            names = ", ".join(f"{who}:{number}" for who, number in found) or "none"
            raise UsageError(f"there is no pass {one}; there are {names}.")
        chosen.append(meant)
    return list(dict.fromkeys(chosen)) if asked else found


def chosen_pass(store: Store, annotator: str, number: int) -> tuple[str, int]:
    """The pass that is meant: the one that was named, the consensus, or the only one.

    Args:
        store: The labels.
        annotator: A name; empty for the consensus, or the only annotator.
        number: A number; 0 for the only pass.

    Raises:
        UsageError: There is none, or there are several.
    """
    found = [
        (who, which)
        for who, which in store.passes()
        if annotator in ("", who) and number in (0, which)
    ]
    if not annotator and (CONSENSUS, number or 1) in found:
        return CONSENSUS, number or 1
    if len(found) == 1:
        return found[0]
    passes = ", ".join(f"{who} {which}" for who, which in found or store.passes())
    if not found:
        raise UsageError(f"there is no such pass; there are {passes or 'none'}.")
    raise UsageError(f"which pass? There are {passes}; choose with --annotator and --pass-number.")
