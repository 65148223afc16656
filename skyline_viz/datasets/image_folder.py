"""Image folders of Hugging Face: a table beside the photos names the truth of each.

``metadata.csv`` has a line, and ``metadata.jsonl`` an object, for each photo: its ``file_name``,
and that of its truth in another column whose name ends in ``file_name``, as ``mask_file_name``.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

_NAME = "file_name"
_MOST_BYTES = 50_000_000  # of a table


def linked_truths(folder: Path) -> dict[Path, Path]:
    """The truths that tables of a folder name, by their photos; both are files that are there.

    A table that cannot be read names none.
    """
    found: dict[Path, Path] = {}
    for name, read in (("metadata.csv", _csv), ("metadata.jsonl", _jsonl)):
        file = folder / name
        try:
            if not file.is_file() or file.stat().st_size > _MOST_BYTES:
                continue
            for row in read(file):
                files = [_inside(folder, row[key]) for key in row if key.endswith(f"_{_NAME}")]
                photo, truth = _inside(folder, row.get(_NAME)), next(filter(None, files), None)
                if photo and truth and photo != truth:
                    found[photo] = truth
        except (OSError, ValueError, csv.Error):
            continue
    return found


def _csv(file: Path) -> Iterator[dict[str, Any]]:
    with file.open(newline="", encoding="utf-8-sig") as opened:
        for row in csv.DictReader(opened):
            yield {key: value for key, value in row.items() if isinstance(key, str)}


def _jsonl(file: Path) -> Iterator[dict[str, Any]]:
    with file.open(encoding="utf-8-sig") as opened:
        for line in opened:
            row = json.loads(line) if line.strip() else None
            if isinstance(row, dict):
                yield row


def _inside(folder: Path, name: object) -> Path | None:
    """A file below a folder; None where it is none, or lies outside."""
    if not isinstance(name, str) or not name or "\0" in name:
        return None
    path = Path(name)
    if path.is_absolute() or ".." in path.parts:
        return None
    file = folder / path
    return file if file.is_file() else None
