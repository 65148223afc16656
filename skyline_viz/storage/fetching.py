"""Downloads that are tried again: throttling and broken connections pass, what is missing stays so.

The pauses between tries grow twofold, and are drawn at random from half to all of that, so that
many workers that were refused at once do not come back at once.
"""

from __future__ import annotations

import random
import time

from skyline_viz.storage.addresses import StorageError, UnseenError, file_system, naming, plain

TRIES = 5
"""How often a photo is asked for."""

FIRST_PAUSE = 0.5
"""Seconds before the second try; each later pause is twice as long."""

MOST_BYTES = 1_000_000_000
"""Largest file that is downloaded: a worker holds one at a time."""

_LASTING = (FileNotFoundError, PermissionError, IsADirectoryError, NotImplementedError)


class OutageError(UnseenError):
    """Each try failed, and nothing says that the file is not there."""


pause = time.sleep
"""Waits so many seconds."""


def fetch(address: str, size: int | None = None) -> bytes:
    """Download a file: one request, and more only where one failed.

    Args:
        address: Where it is.
        size: Its bytes, where a listing has told; a download of another length is a broken one.

    Raises:
        OutageError: Each try failed.
        StorageError: It is missing, may not be read or is too large.
    """
    found, path = file_system(address)
    if size is not None and size > MOST_BYTES:
        raise StorageError(f"{address} has {size:,} bytes, and the limit is {MOST_BYTES:,}.")
    for number in range(TRIES):
        if number:
            pause(FIRST_PAUSE * 2 ** (number - 1) * random.uniform(0.5, 1))  # noqa: S311 - no secret
        try:
            data = bytes(found.cat_file(path))
            if size is None or len(data) == size:
                return data
            last = f"it broke off after {len(data):,} of {size:,} bytes"
        except _LASTING as error:
            with naming(address):
                raise error
        except Exception as error:  # each library has classes of its own
            last = plain(error)
    raise OutageError(f"{address} could not be downloaded in {TRIES} tries: {last}.")
