"""Under which address a folder is served, so that an open page finds its server again.

A page proves with a token that it was opened by whoever started the server. Token and port are
kept, so that a server that is started again on the same folder has the same ones. They lie in the
user's own state folder and not beside the photos: a folder of photos is shared, copied and
published, and its file system may not know whose a file is. The file is the user's alone, and is
not believed when anybody else could have written or read it.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import secrets
import stat
import tempfile
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import time

from annotate.store.store import Store

_TOKEN = re.compile(r"[A-Za-z0-9_-]{32}")
_FORGOTTEN = 180 * 86_400.0  # seconds after which the address of a folder is not kept any more


@dataclass(frozen=True)
class Address:
    """A port, and what a page has to know."""

    token: str
    """What the page has to know."""

    port: int = 0
    """Where the server listens; 0 where that is not known yet."""


def new_address() -> Address:
    """An address that nobody knows."""
    return Address(secrets.token_urlsafe(24))


def folder_id(store: Store) -> str:
    """What tells a folder from every other one, its copies included: 32 hexadecimal digits."""
    return _digest(store.id, str(store.folder.resolve()))


def pass_id(store: Store, annotator: str, number: int) -> str:
    """What tells one annotator's labels of a folder from all others: 32 hexadecimal digits."""
    return _digest(folder_id(store), annotator, str(number))


def kept_address(folder: str) -> Address | None:
    """The address that a folder had last; None where none is kept, or it cannot be trusted.

    Args:
        folder: The folder's id.
    """
    try:
        file = os.open(_file(folder), os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0))
    except OSError:
        return None
    with os.fdopen(file, "rb") as opened:
        if not _ours_alone(os.fstat(opened.fileno())):
            return None
        try:
            said = json.loads(opened.read(1000))
            token, port = said["token"], said["port"]
        except (ValueError, KeyError, TypeError):
            return None
    fits = isinstance(token, str) and _TOKEN.fullmatch(token) and type(port) is int
    return Address(token, port) if fits and 0 < port < 2**16 else None


def keep_address(folder: str, address: Address) -> None:
    """Keep the address of a folder for the next time, for this user alone.

    Args:
        folder: The folder's id.
        address: Its address.

    Raises:
        OSError: It cannot be written.
    """
    path = _file(folder)
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    file, temporary = tempfile.mkstemp(dir=path.parent, suffix=".tmp")  # readable by nobody else
    try:
        with os.fdopen(file, "w", encoding="utf-8") as opened:
            json.dump({"token": address.token, "port": address.port}, opened)
            opened.flush()
            os.fsync(opened.fileno())
        Path(temporary).replace(path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
    for old in path.parent.glob("*.json"):
        with suppress(OSError):
            if old.stat().st_mtime < time() - _FORGOTTEN:
                old.unlink()


def _file(folder: str) -> Path:
    state = Path(os.environ.get("XDG_STATE_HOME", ""))
    if not state.is_absolute():
        try:
            state = Path.home() / ".local" / "state"
        except RuntimeError as error:
            raise FileNotFoundError("this user has no home") from error
    return state / "skyline-annotate" / f"{folder}.json"


def _ours_alone(status: os.stat_result) -> bool:
    """Whether nobody but this user can have written or read a file, as far as the system tells."""
    if not stat.S_ISREG(status.st_mode):
        return False
    return not hasattr(os, "getuid") or (
        status.st_uid == os.getuid() and not status.st_mode & (stat.S_IRWXG | stat.S_IRWXO)
    )


def _digest(*parts: str) -> str:
    text = "\0".join(parts).encode("utf-8", "surrogateescape")
    return hashlib.sha256(text).hexdigest()[:32]
