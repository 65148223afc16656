"""What a file or folder holds: its files, their format, and what was drawn in them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from annotate.formats.coco import drawings_of_coco
from annotate.formats.cvat import drawings_of_cvat
from annotate.formats.documents import json_of, xml_of
from annotate.formats.drawings import Drawing
from annotate.formats.importing import Found
from annotate.formats.kinds import READ, kind_of, kind_of_json, kind_of_xml, shown
from annotate.formats.labelme import drawing_of_labelme
from skyline_viz.datasets.coco import RLE
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.photo import PHOTO_SUFFIXES

_MOST_FILES = 200_000
_DEEP = 4  # folders below folders


def files_below(source: Path) -> list[Path]:
    """The file itself, or the files of a folder and of the folders in it, by name.

    Raises:
        FormatError: There are too many, or they cannot be listed.
    """
    if not source.is_dir():
        return [source]
    found: list[Path] = []
    folders = [(source, 0)]
    try:
        for folder, depth in folders:
            inside = sorted(one for one in folder.iterdir() if not one.name.startswith("."))
            found += [one for one in inside if one.is_file()]
            if depth < _DEEP:
                folders += [(one, depth + 1) for one in inside if one.is_dir()]
            if len(found) > _MOST_FILES:
                raise FormatError(f"{source} holds more than {_MOST_FILES:,} files.")
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise FormatError(f"{source} cannot be listed: {reason}.") from error
    return found


def format_of(source: Path, files: Sequence[Path]) -> str:
    """The format of a file or folder: that of its first file of a known kind, text before pictures.

    Raises:
        FormatError: It is of none that is read; the message says what was found.
    """
    names = {path.name for path in source.iterdir()} if source.is_dir() else set()
    if "labels.json" in names:
        return "json"
    if any(path.parent.name == "ground_truth" and path.parent.parent != source for path in files):
        return "ch1"
    if "names.csv" in names:
        return "painted"
    others: list[str] = []
    for file in sorted(files, key=lambda one: one.suffix.lower() in PHOTO_SUFFIXES):
        try:
            kind = kind_of(file)
        except FormatError as error:
            if len(files) == 1:
                raise
            others.append(str(error).rstrip("."))
            continue
        if kind in READ:
            return kind
        if kind:
            others.append(f"{file.name} is {kind}")
    told = f": {others[0]}" if others else ""
    if not others and files:
        told = f": it holds {', '.join(file.name for file in files[:4])}"
    raise FormatError(f"{source} is of no known format{told}.")


def drawings_in(files: Sequence[Path], asked: str, found: Found) -> Iterator[Drawing]:
    """What the files of a format hold; what is wrong with one of them is a problem, no more.

    Args:
        files: All files of the source.
        asked: coco, labelme or cvat.
        found: Gets what is wrong.
    """
    ending = ".xml" if asked == "cvat" else ".json"
    chosen = [file for file in files if file.suffix.lower() == ending or len(files) == 1]
    if any(file.name == RLE for file in chosen):  # of the two files that we write the exact one
        chosen = [file for file in chosen if file.name == RLE]
    if not chosen:
        found.problem(f"there is no {ending} file in it.")
    for file in chosen:
        try:
            yield from _drawings(file, asked, found)
        except _AnotherKindError as error:
            if len(chosen) == 1:
                found.problem(f"{file} is {error}, not {shown(asked)}.")
            else:
                found.note(f"not read, because it is {error}", file.name)
        except FormatError as error:
            found.problem(str(error))


class _AnotherKindError(FormatError):
    """A file is sound, but of another kind."""


def _drawings(file: Path, asked: str, found: Found) -> Iterable[Drawing]:
    if asked == "cvat":
        root = xml_of(file)
        if (kind := kind_of_xml(root.tag)) != asked:
            raise _AnotherKindError(kind)
        return drawings_of_cvat(root, file, found)
    document = json_of(file)
    if (kind := kind_of_json(document)) != asked:
        raise _AnotherKindError(shown(kind))
    if asked == "coco":
        return drawings_of_coco(document, file, found)
    return [_of_labelme(document, file, found)]


def _of_labelme(document: dict[str, Any], file: Path, found: Found) -> Drawing:
    try:
        one = drawing_of_labelme(document, file, found)
    except FormatError as error:
        raise FormatError(f"{file} is not sound LabelMe: {error}.") from None
    beside = tuple(f"{file.stem}{ending}" for ending in sorted(PHOTO_SUFFIXES))
    return Drawing(one.names or beside, one.size, one.shapes, one.tags)
