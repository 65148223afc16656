"""Labels as text of our own: CSV with a line a column, and JSON with everything."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from annotate.formats.common import Entry, FormatError, Imported, check_size
from annotate.formats.importing import Task
from annotate.labels import ORIGINS, Label
from skyline_viz.files import write_text
from skyline_viz.skyline import Skyline
from skyline_viz.truths import begins_like_a_skyline, read_truth

_FORMAT, _VERSION = "skyline-labels", 1


def write_csv(entries: list[Entry], folder: Path) -> None:
    """Write a CSV file for each photo."""
    for entry in entries:
        entry.skyline.write_csv(folder / f"{entry.stem}.csv")


def read_csv(task: Task) -> None:
    """Read the skylines of a folder, in CSV or JSON, or one of them."""
    files = [
        file
        for file in task.files
        if file.suffix.lower() == ".csv"
        or (file.suffix.lower() == ".json" and begins_like_a_skyline(file))
    ]
    files.sort(key=lambda file: file.suffix.lower())  # of both, CSV counts
    for file in task.files if files else ():
        if file not in files and file.name not in task.given:
            task.found.note("not read beside skylines in CSV or JSON", file.name)
    task.read_each(files or task.files, lambda file, _: read_truth(file))


def write_json(entries: list[Entry], folder: Path) -> None:
    """Write everything into one file."""
    labels = []
    for entry in entries:
        label = vars(entry.label) | {
            "skyline": {
                "rows": entry.skyline.rows.astype(int).tolist(),
                "visible": entry.skyline.visible.tolist(),
            },
            "origin": [ORIGINS[one] for one in entry.label.origin.tolist()],
        }
        labels.append(label)
    document = {"format": _FORMAT, "version": _VERSION, "labels": labels}
    write_text(folder / "labels.json", json.dumps(document) + "\n")


def read_json(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read what `write_json` wrote, given the photo of each name."""
    file = source / "labels.json" if source.is_dir() else source
    document = load_json(file)
    if document.get("format") != _FORMAT or not isinstance(document.get("labels"), list):
        raise FormatError(f'{file} is not of the format "{_FORMAT}".')
    if document.get("version") != _VERSION:
        raise FormatError(f"{file} has version {document.get('version')!r}, and 1 is known.")
    found = []
    for one in document["labels"]:
        try:
            label = _label(one)
        except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as error:
            raise FormatError(f"{file} holds a label that is not whole: {error}.") from error
        if label.name in names and label.skyline is not None:
            name = names[label.name]
            line = check_size(name, label.skyline, photos, label.height)
            found.append(Imported(name, line, label.tags, label))
    return found


def load_json(file: Path) -> dict[str, Any]:
    """Read a JSON object from a file.

    Raises:
        FormatError: It cannot be read, or holds something else.
    """
    try:
        document = json.loads(file.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError) as error:
        raise FormatError(f"{file} is not JSON: {error}.") from error
    if not isinstance(document, dict):
        raise FormatError(f"{file} does not hold a JSON object.")
    return document


def _label(said: dict[str, Any]) -> Label:
    skyline = Skyline(
        rows=said["skyline"]["rows"], visible=np.array(said["skyline"]["visible"], np.bool_)
    )
    operations = said["operations"]
    if not all(isinstance(one, dict) and isinstance(one.get("kind"), str) for one in operations):
        raise ValueError("an operation is no object with a kind")
    return Label(
        name=str(said["name"]),
        digest=str(said["digest"]),
        width=int(said["width"]),
        height=int(said["height"]),
        annotator=str(said["annotator"]),
        number=int(said["number"]),
        status=str(said["status"]),
        tags=tuple(map(str, said["tags"])),
        skyline=skyline,
        origin=np.array([ORIGINS.index(one) for one in said["origin"]], np.uint8),
        operations=tuple(operations),
        seconds=float(said["seconds"]),
        detector=str(said["detector"]),
        blind=bool(said["blind"]),
    )
