"""Labels as text of our own, a CSV file a photo; and what all formats in JSON share."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from annotate.formats.common import Entry, FormatError, Imported, check_size
from skyline_viz.files import read_at_most
from skyline_viz.skyline import Skyline, SkylineError

JSON_FORMAT = "skyline-labels"
"""What ``labels.json`` says that it is."""

_LIMIT = 2_000_000_000  # bytes of a JSON file


def write_csv(entries: list[Entry], folder: Path) -> None:
    """Write a CSV file for each photo."""
    for entry in entries:
        entry.skyline.write_csv(folder / f"{entry.stem}.csv")


def read_csv(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read the CSV files of a folder, or one of them."""
    files = [source] if source.is_file() else sorted(source.glob("*.csv"))
    found = []
    for file in files:
        if file.stem in names:
            try:
                skyline = Skyline.read_csv(file)
            except SkylineError as error:
                raise FormatError(str(error)) from error
            name = names[file.stem]
            found.append(Imported(name, check_size(name, skyline, photos)))
    return found


def load_json(file: Path) -> dict[str, Any]:
    """Read a JSON object from a file.

    Raises:
        FormatError: It cannot be read, or holds something else.
    """
    try:
        document = json.loads(read_at_most(file, _LIMIT).decode("utf-8-sig"))
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise FormatError(f"{file} cannot be read: {reason}.") from error
    except RecursionError as error:
        raise FormatError(f"{file} is not JSON: it is nested too deeply.") from error
    except MemoryError as error:
        raise FormatError(f"{file} does not fit into memory.") from error
    except ValueError as error:
        raise FormatError(f"{file} is not JSON: {error}.") from error
    if not isinstance(document, dict):
        raise FormatError(f"{file} does not hold a JSON object.")
    return document


def kind_of_json(file: Path) -> str:
    """The format of a JSON file."""
    document = load_json(file)
    if document.get("format") == JSON_FORMAT:
        return "json"
    if "annotations" in document and "images" in document:
        return "coco"
    if "shapes" in document:
        return "labelme"
    raise FormatError(f"{file} is JSON, but of no known format.")
