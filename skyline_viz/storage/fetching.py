"""What storages fail at is tried again: throttling and broken connections pass, the rest stays.

The pauses between tries grow twofold, and are drawn at random from half to all of that, so that
many workers that were refused at once do not come back at once. Where a server says how long to
wait, that is waited, up to a minute.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from email.utils import parsedate_to_datetime
from inspect import signature
from typing import Any, TypeVar

from skyline_viz.files import FULL
from skyline_viz.storage.addresses import (
    StorageError,
    UnseenError,
    file_system,
    lasts,
    naming,
    plain,
)

TRIES = 5
"""How often a storage is asked."""

FIRST_PAUSE = 0.5
"""Seconds before the second try; each later pause is twice as long."""

MOST_BYTES = 1_000_000_000
"""Largest file that is downloaded: a worker holds one at a time."""

_LONGEST_PAUSE = 60.0  # seconds, whatever a server asks for

Value = TypeVar("Value")


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

    def download() -> bytes:
        data = bytes(found.cat_file(path, **_one_request(found)))
        if size is not None and len(data) != size:
            raise ConnectionError(f"it broke off after {len(data):,} of {size:,} bytes")
        return data

    return persistent(download, address, "downloaded")


def persistent(action: Callable[[], Value], address: str, done: str) -> Value:
    """The result of an action, which is tried again where what failed may pass.

    Args:
        action: What a storage is asked for.
        address: Where.
        done: What could not be done, for the sentence: ``downloaded``.

    Raises:
        StorageError: What failed lasts, or each try failed.
        OSError: The disk of this machine is full or read-only.
    """
    last, asked = "", 0.0
    for number in range(TRIES):
        if number:
            own = FIRST_PAUSE * 2 ** (number - 1) * random.uniform(0.5, 1)  # noqa: S311 - no secret
            pause(max(own, asked))
        try:
            return action()
        except Exception as error:  # each library has classes of its own
            if isinstance(error, OSError) and error.errno in FULL:
                raise  # the disk of this machine, which no other try would empty
            if lasts(error):
                with naming(address, done):
                    raise
            last, asked = plain(error), _asked_pause(error)
    raise OutageError(f"{address} could not be {done} in {TRIES} tries: {last}.")


def _one_request(found: Any) -> dict[str, int]:  # noqa: ANN401 - file systems have no types
    """What keeps s3fs from asking for the size first, so as to download in pieces."""
    own = signature(getattr(found, "_cat_file", found.cat_file)).parameters
    return {"max_concurrency": 1} if "max_concurrency" in own else {}


def _asked_pause(error: Exception) -> float:
    """Seconds that a server asks to wait, by a number or a date; 0 where it does not."""
    told = str((getattr(error, "headers", None) or {}).get("Retry-After", "")).strip()
    if told.isdecimal():
        seconds = float(told)
    else:
        try:
            seconds = parsedate_to_datetime(told).timestamp() - time.time()
        except ValueError:
            return 0.0
    return min(max(seconds, 0.0), _LONGEST_PAUSE)
