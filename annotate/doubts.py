"""Truths that a diagnosis doubts: which photos to look at, and where."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from annotate.store import Photo

CAUSE = "truth doubtful"
"""The cause of segments whose annotation is to be checked."""


class DoubtsError(ValueError):
    """A file holds no diagnosis; the message is one sentence that says why."""


def read_doubts(path: Path) -> dict[str, int]:
    """The column to look at for each doubtful photo, in the middle of its longest segment.

    Args:
        path: ``diagnosis.json``, as ``skyline-viz diagnose --out`` writes it.

    Raises:
        DoubtsError: It cannot be read, or is something else.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        if document["format"] != "skyline-diagnosis":
            raise DoubtsError(f"{path} is no diagnosis.")
        found = {}
        for photo in document["photos"]:
            runs = [one["columns"] for one in photo["segments"] if one["cause"] == CAUSE]
            if runs:
                first, last = max(runs, key=lambda run: run[1] - run[0])
                found[str(photo["name"])] = (int(first) + int(last)) // 2
    except DoubtsError:
        raise
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise DoubtsError(f"{path} holds no diagnosis: {error}.") from error
    return found


def columns_of(doubts: dict[str, int], photos: Iterable[Photo]) -> dict[int, int]:
    """The column to look at for each photo of a folder that is doubtful, by the photo's id.

    Diagnoses name photos as data sets do, by their stem.
    """
    found = {}
    for photo in photos:
        name = PurePosixPath(photo.name)
        for known in (photo.name, name.name, name.stem):
            if known in doubts:
                found[photo.id] = min(doubts[known], photo.width - 1)
                break
    return found
