"""JSON documents that hold the lines of many photos: COCO, and ``labels.json`` of the annotator."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from skyline_viz.datasets.coco import POLYGON, RLE, Annotated, Reports, is_coco, photos_of_coco
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.skyline import Skyline, SkylineError

LABELS = "skyline-labels"
"""What ``labels.json`` says that its format is."""


@dataclass(frozen=True, eq=False)
class LineInCoco:
    """The line of a photo in a COCO document."""

    path: Path
    """The document."""

    drawn: Annotated
    """What it says of the photo."""

    sky: str | None = None
    """Category of sky; ``sky`` unless given."""

    terrain: str | None = None
    """Category of terrain, instead of `sky`."""

    def read(self, size: tuple[int, int]) -> Skyline:
        """The line on a photo of a size ``(height, width)``.

        Raises:
            SkylineError: There is no such region, or it is of another size.
        """
        try:
            return self.drawn.line(size, self.sky, self.terrain)
        except SkylineError as error:
            raise SkylineError(f"{self.path}, {self.drawn.names[0]}: {error}") from error


def documents_in(files: Sequence[Path]) -> list[tuple[Path, dict[str, Any]]]:
    """The documents among JSON files; of the two COCO files of an export the exact one.

    Raises:
        OSError: One cannot be read.
    """
    found = []
    for file in files:
        if file.suffix.lower() != ".json" or not file.is_file():
            continue
        try:
            document = json.loads(file.read_bytes())
        except (ValueError, RecursionError):
            continue  # it is something else
        if is_coco(document) or _is_labels(document):
            found.append((file, document))
    exact = {file.parent for file, _ in found if file.name == RLE}
    return [one for one in found if one[0].name != POLYGON or one[0].parent not in exact]


def lines_in(
    file: Path,
    document: dict[str, Any],
    reports: Reports,
    sky: str | None = None,
    terrain: str | None = None,
) -> Iterator[tuple[Sequence[str], Skyline | LineInCoco]]:
    """What photos may be called, and their lines.

    Args:
        file: The document's file.
        document: The document.
        reports: Gets what is wrong with it.
        sky: Category of sky in COCO; ``sky`` unless given.
        terrain: Category of terrain, instead of `sky`.
    """
    if is_coco(document):
        try:
            for drawn in photos_of_coco(document, file, reports):
                yield drawn.names, LineInCoco(file, drawn, sky, terrain)
        except FormatError as error:
            reports.problem(str(error))
        return
    for place, label in enumerate(document["labels"], 1):
        try:
            line = label["skyline"]
            rows = np.array(line["rows"], np.float32)
            yield [str(label["name"])], Skyline(rows, np.array(line["visible"], np.bool_))
        except (LookupError, TypeError, ValueError):
            reports.problem(f"{file}: label {place} has no name or no line.")


def _is_labels(document: object) -> bool:
    return (
        isinstance(document, dict)
        and document.get("format") == LABELS
        and isinstance(document.get("labels"), list)
    )
