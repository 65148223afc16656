"""The JSON files of a gallery: a version, and a list of objects."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from skyline_viz.files import write_text


class GalleryError(ValueError):
    """A gallery's file is damaged, or does not take a change; the message names it and says why."""


def read_list(path: Path, key: str, version: int) -> list[dict[str, Any]]:
    """What a file holds; nothing where there is none, or an earlier version wrote it.

    Raises:
        GalleryError: The file is damaged.
    """
    if not path.exists():
        return []
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        found = document[key]
        if document["version"] in range(1, version):
            return []
        if document["version"] != version or not all(isinstance(one, dict) for one in found):
            raise ValueError
    except (ValueError, LookupError, TypeError) as error:
        raise GalleryError(
            f"{path} is damaged or of another version; move it away to start afresh."
        ) from error
    return list(found)


def made(kind: Any, path: Path, values: dict[str, Any]) -> Any:  # noqa: ANN401
    """A dataclass from one of the objects.

    Raises:
        GalleryError: It has other fields.
    """
    try:
        return kind(**values)
    except TypeError as error:
        raise GalleryError(f"{path} is damaged: {error}.") from error


def write_list(
    path: Path,
    key: str,
    values: list[dict[str, Any]],
    version: int,
    more: Mapping[str, Any] | None = None,
) -> None:
    """Write a file whole, an entry of the list in a line; it is on the disk then.

    Args:
        path: The file.
        key: What the list is called in it.
        values: The list.
        version: Of the file.
        more: What else is in it, for others to read.

    Raises:
        OSError: It cannot be written; what was there is untouched.
    """
    head = json.dumps({"version": version, **(more or {})}, ensure_ascii=False)
    # to indent everything takes ten times as long
    lines = ",\n".join(json.dumps(one, ensure_ascii=False) for one in values)
    write_text(path, f"{head[:-1]}, {json.dumps(key)}: [\n{lines}\n]}}\n")
