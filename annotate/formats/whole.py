"""``labels.json``: labels with everything that is known about them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError

from annotate.engine.edits import ORIGINS, Origin
from annotate.engine.hidden import Hidden
from annotate.formats.common import Entry, Imported, check_size
from annotate.formats.documents import json_of
from annotate.formats.importing import Task
from annotate.formats.orphans import gone
from annotate.store.contents import Contents
from annotate.store.labels import (
    LONGEST_COMMENT,
    LONGEST_NAME,
    MOST_PASSES,
    Comment,
    Label,
    Status,
    check_annotator,
)
from skyline_viz.datasets.line_documents import LABELS
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.files import write_text
from skyline_viz.skyline import Skyline, SkylineError

FORMAT = LABELS
"""What ``labels.json`` says that it is."""

MOST_LABELS = 100_000
"""Labels that a file may hold."""

MOST_OPERATIONS = 10_000
"""Operations that the log of a label may have."""

_VERSION = 2  # 1 had no undo of a status, and a program that knows no other would misread its log
_KNOWN = (1, 2)
_SIDE = 100_000  # pixels
_MADE = {
    "skyline",
    "origin",
    "annotator",
    "tags",
    "operations",
    "hidden",
    "comment",
}  # of what was read

Digest = Annotated[str, Field(pattern=r"^([0-9a-f]{64})?$")]
Side = Annotated[int, Field(ge=1, le=_SIDE)]


class _Part(BaseModel):
    model_config = ConfigDict(strict=True)


class _Line(_Part):
    rows: Annotated[list[FiniteFloat], Field(min_length=1, max_length=_SIDE)]
    visible: Annotated[list[bool], Field(min_length=1, max_length=_SIDE)]


class _Comment(_Part):
    text: Annotated[str, Field(max_length=LONGEST_COMMENT)]
    by: Annotated[str, Field(max_length=LONGEST_NAME)]


class _Hidden(_Part):
    first: Annotated[int, Field(ge=0, le=_SIDE)]
    last: Annotated[int, Field(ge=0, le=_SIDE)]
    why: Annotated[str, Field(max_length=80)]


class _Label(_Part):
    name: Annotated[str, Field(min_length=1, max_length=4096)]
    digest: Digest
    pixels: Digest = ""
    width: Side
    height: Side
    annotator: str
    number: Annotated[int, Field(ge=1, le=MOST_PASSES)]
    status: Status
    tags: Annotated[list[Annotated[str, Field(max_length=80)]], Field(max_length=1000)]
    skyline: _Line
    origin: Annotated[list[Origin], Field(max_length=_SIDE)]
    operations: Annotated[list[dict[str, Any]], Field(max_length=MOST_OPERATIONS)]
    seconds: Annotated[FiniteFloat, Field(ge=0)]
    detector: Annotated[str, Field(max_length=1000)]
    blind: bool
    comment: _Comment | None = None
    hidden: Annotated[list[_Hidden], Field(max_length=_SIDE)] = []  # files of before know none


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
            "comment": entry.label.comment and vars(entry.label.comment),
            "hidden": [one._asdict() for one in entry.label.hidden],
        }
        labels.append(label)
    document = {"format": FORMAT, "version": _VERSION, "labels": labels}
    write_text(folder / "labels.json", json.dumps(document) + "\n")


def read_json(task: Task) -> None:
    """Read what `write_json` wrote; labels find their photos by what is in these.

    The form of each label is checked, and its line; what was done to it is checked against the
    photo, when it is imported.

    Raises:
        FormatError: The file cannot be read.
    """
    contents = task.contents or Contents(task.photos, task.given)
    others = []
    for label in _labels(task.source, task.found.problem):
        name = contents.name_of(label)
        if name is None or label.skyline is None:
            others.append(label)
            continue
        try:
            line = check_size(name, label.skyline, task.photos, label.height)
        except FormatError as error:
            task.found.problem(str(error))
        else:
            task.found.labels.append(Imported(name, line, label.tags, label, label.hidden))
    for sentence in gone(others, f"in {task.photos}"):
        task.found.note(sentence.removesuffix("."))


def _labels(source: Path, problem: Callable[[str], None]) -> Iterator[Label]:
    """The labels of a file, or of the file in a folder, that are whole."""
    file = source / "labels.json" if source.is_dir() else source
    document = json_of(file)
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise FormatError(f'{file} is not of the format "{FORMAT}".')
    labels = document.get("labels")
    if not isinstance(labels, list):
        raise FormatError(f"{file} holds no list of labels.")
    if document.get("version") not in _KNOWN:
        known = " and ".join(map(str, _KNOWN))
        said = f"{document.get('version')!r:.40}"
        raise FormatError(f"{file} has version {said}, and {known} are known.")
    if len(labels) > MOST_LABELS:
        raise FormatError(
            f"{file} holds {len(labels):,} labels, and at most {MOST_LABELS:,} are read."
        )
    for place, said in enumerate(labels, 1):
        try:
            yield _label(said, file, place)
        except FormatError as error:
            problem(str(error))


def _label(said: object, file: Path, place: int) -> Label:
    name = said.get("name") if isinstance(said, dict) else None
    shown = f"label {place}" + (f" ({name!r:.200})" if isinstance(name, str) else "")
    try:
        told = _Label.model_validate(said)
        with np.errstate(over="ignore"):  # what is too large becomes infinite, and is refused
            rows = np.array(told.skyline.rows, np.float64).astype(np.float32)
        skyline = Skyline(rows=rows, visible=np.array(told.skyline.visible))
        told.name.encode()
        return Label(
            **told.model_dump(exclude=_MADE),
            comment=Comment(**vars(told.comment)) if told.comment else None,
            annotator=check_annotator(told.annotator),
            tags=tuple(told.tags),
            operations=tuple(told.operations),
            hidden=tuple(Hidden(**vars(one)) for one in told.hidden),
            skyline=skyline,
            origin=np.array([ORIGINS.index(one) for one in told.origin], np.uint8),
        )
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        where = ".".join(map(str, first["loc"]))
        reason = f"{where}: {first['msg'][:1].lower()}{first['msg'][1:]}" if where else "no object"
    except UnicodeError:
        reason = "its name is no text"
    except (SkylineError, ValueError, OverflowError) as error:
        reason = str(error)
    raise FormatError(f"{file}: {shown} is not whole: {reason.rstrip('.')}.")
