"""Formats in which labels leave and come back. An export appears whole or not at all.

========  ========================================  ==========================================
format    files                                     carries, besides the rows
========  ========================================  ==========================================
mask      ``masks/NAME.png``: 0 sky, 255 terrain    nothing
painted   the Web layout: photos, and photos with   which columns are visible
          the line in pure red
ch1       the CH1 layout: photos, ``-mask`` files   nothing
csv       ``NAME.csv``: column, row, visible        which columns are visible
json      ``labels.json``                           everything
coco      ``annotations-polygon.json``,             nothing
          ``annotations-rle.json``
labelme   ``NAME.json``                             which columns are visible, tags
cvat      ``annotations.xml``                       which columns are visible, tags
========  ========================================  ==========================================

Rows of columns that are not visible are guesses, and come back as interpolated ones from painted
photos, LabelMe and CVAT.
"""

from __future__ import annotations

import io
import shutil
import zipfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from annotate.formats import interchange, masks, tables
from annotate.formats.common import (
    Entry,
    FormatError,
    Imported,
    Reader,
    Writer,
    entries_of,
    names_of,
    one_each,
)
from annotate.labels import Label
from skyline_viz.aftermath import passing_folder

FORMATS: dict[str, tuple[Writer, Reader]] = {
    "mask": (masks.write_masks, masks.read_masks),
    "painted": (masks.write_painted, masks.read_painted),
    "ch1": (masks.write_ch1, masks.read_ch1),
    "csv": (tables.write_csv, tables.read_csv),
    "json": (tables.write_json, tables.read_json),
    "coco": (interchange.write_coco, interchange.read_coco),
    "labelme": (interchange.write_labelme, interchange.read_labelme),
    "cvat": (interchange.write_cvat, interchange.read_cvat),
}
"""How each format is written and read."""

_LOSES_VISIBILITY = ("mask", "ch1", "coco")


@dataclass(frozen=True)
class Export:
    """What an export came to."""

    written: int
    """Number of labels."""

    notes: tuple[str, ...]
    """A sentence for each label that was left out, and for what the format cannot carry."""


def export_labels(labels: Iterable[Label], photos: Path, out: Path, format: str) -> Export:  # noqa: A002
    """Write labels into a new folder.

    Args:
        labels: The labels.
        photos: Folder of the photos.
        out: Where to; it does not exist yet, or is empty.
        format: One of `FORMATS`.

    Raises:
        FormatError: There is nothing to export, the folder holds something, or the format is none.
    """
    if format not in FORMATS:
        raise FormatError(f"{format!r} is no format; there are {', '.join(FORMATS)}.")
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise FormatError(f"{out} exists already; name a folder that does not.")
    entries, notes = entries_of(labels, photos)
    if format != "json":
        entries, more = one_each(entries)
        notes += more
    if not entries:
        reasons = f" {notes[0]}" if notes else ""
        raise FormatError(f"there is nothing to export: no photo has been accepted.{reasons}")
    if format in _LOSES_VISIBILITY:
        for entry in entries:
            if not entry.skyline.visible.all():
                notes.append(
                    f"{entry.label.name}: {format} cannot say which columns are not visible."
                )
    out.parent.mkdir(parents=True, exist_ok=True)
    with passing_folder(".export-", out.parent) as folder:
        whole = folder / "whole"
        whole.mkdir()
        FORMATS[format][0](entries, whole)
        if out.exists():
            out.rmdir()  # it is empty
        whole.rename(out)
    return Export(len(entries), tuple(notes))


def archive(labels: Iterable[Label], photos: Path, format: str) -> bytes:  # noqa: A002
    """Export labels into a ZIP file; what was left out is told in its ``notes.txt``."""
    packed = io.BytesIO()
    with passing_folder() as folder, zipfile.ZipFile(packed, "w") as file:
        out = folder / "export"
        export = export_labels(labels, photos, out, format)
        for path in sorted(out.rglob("*")):
            if path.is_file():
                file.write(path, path.relative_to(out).as_posix(), zipfile.ZIP_DEFLATED)
        if export.notes:
            file.writestr("notes.txt", "\n".join(export.notes) + "\n")
        shutil.rmtree(out)
    return packed.getvalue()


def import_labels(
    source: Path,
    photos: Path,
    names: Iterable[str],
    format: str | None = None,  # noqa: A002
) -> list[Imported]:
    """Read labels.

    Args:
        source: File or folder, as `export_labels` or another tool wrote it.
        photos: Folder of the photos.
        names: Names of the photos below the folder, with ``/`` between folders.
        format: One of `FORMATS`; told by the content unless given.

    Raises:
        FormatError: Damaged, of no known format, or about no photo of the folder.
    """
    if not source.exists():
        raise FormatError(f"{source} does not exist.")
    chosen = format or _format_of(source)
    if chosen not in FORMATS:
        raise FormatError(f"{chosen!r} is no format; there are {', '.join(FORMATS)}.")
    found = FORMATS[chosen][1](source, photos, names_of(names, photos))
    if not found:
        raise FormatError(f"{source} holds no label of a photo in {photos}.")
    return found


def _format_of(source: Path) -> str:
    """The format of a file or folder, by what is in it."""
    if source.suffix == ".json":
        return tables.kind_of_json(source)
    if source.suffix == ".xml":
        return "cvat"
    inside = {path.name for path in source.iterdir()} if source.is_dir() else set()
    for name, format in _MARKS.items():  # noqa: A001
        if name in inside:
            return format
    for format, ending in {"mask": ".png", "labelme": ".json", "csv": ".csv"}.items():  # noqa: A001
        if any(name.endswith(ending) for name in {*inside, source.name}):
            return format
    raise FormatError(f"{source} is of no known format; say which with --format.")


_MARKS = {
    "annotations.xml": "cvat",
    "labels.json": "json",
    "annotations-rle.json": "coco",
    "annotations-polygon.json": "coco",
    "names.csv": "painted",
    masks.CH1_PART: "ch1",
    "masks": "mask",
}
"""Files and folders by which a folder's format is told."""

__all__ = [
    "FORMATS",
    "Entry",
    "Export",
    "FormatError",
    "Imported",
    "archive",
    "export_labels",
    "import_labels",
]
