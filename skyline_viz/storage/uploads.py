"""A file that is made on this machine and goes to an address when it is whole."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath

from skyline_viz.files import make_folder, replacing
from skyline_viz.storage import fetching
from skyline_viz.storage.addresses import StorageError, file_system, naming, plain
from skyline_viz.storage.copies import caches
from skyline_viz.storage.fetching import FIRST_PAUSE, TRIES


@contextmanager
def uploaded(address: str) -> Iterator[Path]:
    """Yield a path of this machine, always the same, and upload what is there after the block.

    What is at the address already is there before the block; or what could not be uploaded.

    Raises:
        StorageError: The address cannot be read, or not written; the file stays here then.
        OSError: The disk is full or read-only.
    """
    found, path = file_system(address)
    home = caches() / "tables" / hashlib.sha256(address.encode()).hexdigest()[:16]
    local = home / PurePosixPath(path).name
    make_folder(home)
    with naming(address):
        found.invalidate_cache()
        there = bool(found.exists(path))
    if there and not local.exists():  # or it was not uploaded the last time
        with replacing(local) as temporary, naming(address):
            found.get_file(path, str(temporary))
    yield local
    last = ""
    for number in range(TRIES):
        if number:
            fetching.pause(FIRST_PAUSE * 2 ** (number - 1))
        try:
            found.put_file(str(local), path)
        except Exception as error:  # each library has classes of its own
            last = plain(error)
        else:
            local.unlink()
            return
    raise StorageError(f"{address} cannot be written: {last}; what was found is in {local}.")
