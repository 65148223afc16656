"""A file that is made on this machine and goes to an address when it is whole.

Before it is begun a small file is written beside the address and removed, as a trial. What another
run has put there in the meantime is not overwritten. Beside the file lies a note of what was at the
address when it was begun. Storages have no lock, so that two runs that end within the same moment
are not told apart.
"""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any

from skyline_viz.files import make_folder, replacing, write_text
from skyline_viz.storage.addresses import StorageError, address_of, file_system, scheme
from skyline_viz.storage.copies import caches
from skyline_viz.storage.fetching import persistent
from skyline_viz.storage.listing import stamp_of
from skyline_viz.storage.parts import WEB
from skyline_viz.system.notes import note

_UNNAMEABLE = "Parameter validation failed"  # what S3 says of what no bucket can be called

_CHANGED = ("LastModified", "updated", "last_modified", "mtime", "created")
"""What storages tell of the time of a file's last change."""


@contextmanager
def uploaded(address: str) -> Iterator[Path]:
    """Yield a path of this machine, always the same, and upload what is there after the block.

    What is at the address already is there before the block; or what could not be uploaded.

    Raises:
        StorageError: The address cannot be read, or not written, or another run has written there
            in the meantime; the file stays here then.
        OSError: The disk is full or read-only.
    """
    found, path = file_system(address)
    _refuse_place(found, path, address)
    home = caches() / "tables" / hashlib.sha256(address.encode()).hexdigest()[:16]
    local = home / PurePosixPath(path).name
    note = home / "there.txt"
    make_folder(home)
    _try_to_write(found, path, address)
    there = _state(found, path, address)
    if local.exists():  # it was not uploaded the last time
        _check(there, note.read_text(encoding="utf-8") if note.exists() else "", address, local)
    elif there:
        with replacing(local) as temporary:
            persistent(partial(found.get_file, path, str(temporary)), address, "downloaded")
    write_text(note, there)
    yield local
    try:
        _check(_state(found, path, address), there, address, local)
        persistent(partial(found.put_file, str(local), path), address, "written")
    except StorageError as error:
        if str(local) in str(error):
            raise
        said = str(error).rstrip(".")
        raise StorageError(f"{said}; what was found is in {local}.") from error
    local.unlink()
    note.unlink()


def _refuse_place(found: Any, path: str, address: str) -> None:  # noqa: ANN401 - file systems have no types
    """Refuse what no file can be written to, whatever may be done there.

    Raises:
        StorageError: It is a web server, an archive, or a bucket without a file in it.
    """
    if scheme(address) in WEB:
        raise StorageError(f"{address} cannot be written: web servers give files, and take none.")
    if hasattr(found, "dir_cache"):
        raise StorageError(f"{address} cannot be written: archives are read alone.")
    if hasattr(found, "split_path") and not found.split_path(path)[1]:
        raise StorageError(f"{address} cannot be written: it names a bucket, and no file in it.")


def _try_to_write(found: Any, path: str, address: str) -> None:  # noqa: ANN401
    """Write a small file beside the one that is to come, and remove it.

    Raises:
        StorageError: Nothing can be written there.
    """
    folder, _, _ = path.rpartition("/")
    trial = f"{folder}/.{secrets.token_hex(8)}.trial"
    try:
        persistent(partial(found.pipe_file, trial, b"-"), address, "written")
    except StorageError as error:
        if isinstance(error.__cause__, FileNotFoundError) or _UNNAMEABLE in str(error):
            raise StorageError(
                f"{address} cannot be written: there is no such bucket or folder."
            ) from error
        raise
    try:
        persistent(partial(found.rm_file, trial), address, "written")
    except StorageError:
        note(f"{address_of(found, trial, address)} was written for a trial, and cannot be removed.")


def _state(found: Any, path: str, address: str) -> str:  # noqa: ANN401 - file systems have no types
    """What tells the file at an address from another one; empty where there is none."""
    found.invalidate_cache()
    if not persistent(partial(found.exists, path), address, "read"):
        return ""
    about = persistent(partial(found.info, path), address, "read")
    changed = next((about[name] for name in _CHANGED if about.get(name)), "")
    return f"{stamp_of(about)} {about.get('size')} {changed}"


def _check(there: str, before: str, address: str, local: Path) -> None:
    if there and there != before:
        raise StorageError(
            f"{address} was written by another run in the meantime and stays; what this one found "
            f"is in {local}, and one of the two has to move."
        )
