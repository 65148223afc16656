"""Under which address a folder is served, so that an open page finds its server again.

A page proves with a token whose it is: each person is given one by whoever started the server.
Tokens and port are kept, so that a server that is started again on the same folder has the same
ones, and with them the names of those for whom it was started. They lie in the
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
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from time import time
from typing import Any

from annotate.store.labels import check_annotator
from annotate.store.store import Store

_LONGEST = 100_000  # bytes of a file that is believed: some hundred people
_TOKEN = re.compile(r"[A-Za-z0-9_-]{32}")
_FORGOTTEN = 180 * 86_400.0  # seconds after which the address of a folder is not kept any more


@dataclass(frozen=True)
class Address:
    """A port, and what each person's page has to know."""

    tokens: Mapping[str, str] = field(default_factory=dict)
    """What the page has to know, by the name of the person; also of people of other times."""

    people: tuple[str, ...] = ()
    """For whom the folder is served."""

    port: int = 0
    """Where the server listens; 0 where that is not known yet."""

    def serving(self, people: Sequence[str]) -> Address:
        """The same address for these people; those who had no token get one that nobody knows."""
        new = {one: secrets.token_urlsafe(24) for one in people if one not in self.tokens}
        return Address({**self.tokens, **new}, tuple(people), self.port)


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
            return _believed(json.loads(opened.read(_LONGEST)))
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return None


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
            said = {"port": address.port, "people": address.people, "tokens": {**address.tokens}}
            json.dump(said, opened)
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


def _believed(said: Any) -> Address | None:  # noqa: ANN401  # whatever a file holds
    """What a file says, where it makes sense."""
    tokens, people, port = said["tokens"], tuple(said["people"]), said["port"]
    for name in (*tokens, *people):
        check_annotator(name)
    if not all(_TOKEN.fullmatch(one) for one in tokens.values()):
        return None
    fits = type(port) is int and 0 < port < 2**16 and set(people) <= set(tokens)
    return Address(tokens, people, port) if fits else None


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
