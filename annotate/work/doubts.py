"""Photos that a diagnosis names a cause of, such as a doubtful truth: which ones, and where."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from annotate.store.store import Photo
from skyline_viz.diagnosis.causes import DOUBTFUL, Cause, Place, Preferring, filter_words

VERSION = 1
"""The version of diagnoses that is read."""


class DoubtsError(ValueError):
    """A file holds no diagnosis; the message is one sentence that says why."""


def read_doubts(path: Path, cause: Cause | Place | Preferring = DOUBTFUL) -> dict[str, int]:
    """The column to look at for each photo with a cause, in the middle of its longest segment.

    Args:
        path: ``diagnosis.json``, as ``skyline-viz diagnose --out`` writes it.
        cause: The cause, or the place, or the term of the cost that prefers another line.

    Raises:
        DoubtsError: It cannot be read, or is something else.
    """
    if not path.exists():
        raise DoubtsError(f"{path} does not exist.")
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        reason = (error.strerror or "it is broken").lower()
        raise DoubtsError(f"{path} cannot be read: {reason}.") from error
    except (ValueError, RecursionError) as error:
        raise DoubtsError(f"{path} holds no diagnosis: it is not JSON.") from error
    if not isinstance(document, dict) or document.get("format") != "skyline-diagnosis":
        raise DoubtsError(f"{path} holds no diagnosis.")
    if document.get("version") != VERSION:
        raise DoubtsError(f"{path} is not a diagnosis of version {VERSION}, the only one known.")
    try:
        return _doubted(document, filter_words(cause))
    except (ValueError, KeyError, TypeError, IndexError, OverflowError) as error:
        raise DoubtsError(f"{path} holds a diagnosis that is damaged.") from error


def _doubted(document: dict[str, Any], words: str) -> dict[str, int]:
    found = {}
    for photo in document["photos"]:
        runs = [_columns(one["columns"]) for one in photo["segments"] if words in _title(one)]
        if runs:
            first, last = max(runs, key=lambda run: run[1] - run[0])
            found[str(photo["name"])] = (first + last) // 2
    return found


def _title(segment: dict[str, Any]) -> str:
    """Cause, term and place of a segment; files of earlier versions tell the cause alone."""
    return str(segment.get("title", segment["cause"]))


def _columns(run: Sequence[float]) -> tuple[int, int]:
    first, last = run
    return int(first), int(last)


def columns_of(doubts: dict[str, int], photos: Iterable[Photo]) -> dict[int, int]:
    """The column to look at for each photo of a folder that is named, by the photo's id.

    Diagnoses name photos as data sets do, by their stem.
    """
    found = {}
    for photo in photos:
        name = PurePosixPath(photo.name)
        for known in (photo.name, name.name, name.stem):
            if known in doubts:
                found[photo.id] = min(max(doubts[known], 0), photo.width - 1)
                break
    return found
