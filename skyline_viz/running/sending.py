"""What is sent to other processes and back; of what cannot be, a sentence names the culprit."""

from __future__ import annotations

import pickle
import re
from collections.abc import Iterable, Mapping
from functools import partial
from typing import Any

_DEEPEST = 20


class Unsendable(Exception):  # noqa: N818 - a fact about the work
    """Something cannot be sent to another process; the message says what, and what to do."""


def packed(thing: object, name: str) -> bytes:
    """A thing as bytes that another process unpacks.

    Args:
        thing: What to send.
        name: What to call it where no part of it is to blame.

    Raises:
        Unsendable: Part of it cannot be sent.
    """
    try:
        return pickle.dumps(thing)
    except MemoryError:
        raise
    except Exception as error:  # whatever the classes of others raise
        raise _unsendable(_culprit(thing) or name) from error


def unpacked(sent: bytes) -> Any:  # noqa: ANN401 - whatever was packed
    """What `packed` made bytes of, in this program or in the one that started it.

    Raises:
        Unsendable: A class is found nowhere here, as one that was typed into a session.
    """
    try:
        return pickle.loads(sent)  # noqa: S301 - made by this very program, a moment ago
    except MemoryError:
        raise
    except Exception as error:  # whatever the classes of others raise
        missing = re.search(r"'(\w[\w.]*)'", str(error))  # a module or a class
        raise _unsendable(missing[1] if missing else "the work") from error


def _unsendable(what: str) -> Unsendable:
    return Unsendable(
        f"{what} cannot be sent to other processes, because of what it holds or of where it is "
        f"defined; use --workers 1."
    )


def _culprit(thing: object, depth: int = 0) -> str:
    """The first part that is not ours on the way to what cannot be sent."""
    if depth > _DEEPEST or _goes(thing):
        return ""
    kind = type(thing)
    known = (partial, list, tuple, dict, set, frozenset)
    if kind.__module__.split(".")[0] != "skyline_viz" and kind not in known:
        named = thing if hasattr(thing, "__qualname__") else kind  # a function or a class
        return str(named.__qualname__).rsplit(".", 1)[-1]
    return next(filter(None, (_culprit(one, depth + 1) for one in _parts(thing))), "")


def _goes(thing: object) -> bool:
    try:
        pickle.dumps(thing)
    except Exception:  # whatever the classes of others raise
        return False
    return True


def _parts(thing: Any) -> Iterable[object]:  # noqa: ANN401 - anything has parts
    if isinstance(thing, partial):
        return (thing.func, *thing.args, *thing.keywords.values())
    if isinstance(thing, Mapping):
        return thing.values()
    return thing if isinstance(thing, Iterable) else vars(thing).values()
