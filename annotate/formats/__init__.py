"""Formats in which labels leave and come back. An export appears whole or not at all.

========  ========================================  ==========================================
format    files                                     carries, besides the rows
========  ========================================  ==========================================
mask      ``masks/NAME.png``: 0 sky, 255 terrain    nothing
painted   the Web layout: photos, and photos with   which columns are visible
          the line in pure red
ch1       the CH1 layout: photos, ``-mask`` files   nothing
csv       ``NAME.csv``: column, row, visible        which columns are visible, why not
json      ``labels.json``                           everything
coco      ``annotations-polygon.json``,             nothing
          ``annotations-rle.json``
labelme   ``NAME.json``                             which columns are visible, tags, comment
cvat      ``annotations.xml``                       which columns are visible, tags
parquet   ``labels.parquet``, a table of labels     which columns are visible, tags
========  ========================================  ==========================================

Rows of columns that are not visible are guesses, and come back as interpolated ones from painted
photos, LabelMe and CVAT.
"""

from __future__ import annotations

import io
import shutil
import zipfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from annotate.formats import coco, cvat, labelme, masks, parquet, tables, whole
from annotate.formats.common import (
    Entry,
    Imported,
    Writer,
    entries_of,
    names_below,
    one_each,
    orphans_of,
    with_a_line,
)
from annotate.formats.copies import unite_copies
from annotate.formats.documents import unpacked
from annotate.formats.drawings import Wanted
from annotate.formats.importing import Found, Imports, Reader, Task
from annotate.formats.interpretation import interpret
from annotate.formats.photo_names import PhotoNames
from annotate.formats.sources import drawings_in, files_below, format_of
from annotate.store.contents import Contents
from annotate.store.labels import Label
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.files import make_folder, move_folder
from skyline_viz.system.aftermath import passing_folder
from skyline_viz.system.names import listed


def _drawn(format: str) -> Reader:  # noqa: A002
    """Reader of the files of a drawing program."""

    def read(task: Task) -> None:
        drawings = list(drawings_in(list(task.files), format, task.found))
        interpret(drawings, task.wanted, task.names, task.photos, task.found)

    return read


FORMATS: dict[str, tuple[Writer, Reader]] = {
    "mask": (masks.write_masks, masks.read_masks),
    "painted": (masks.write_painted, masks.read_painted),
    "ch1": (masks.write_ch1, masks.read_ch1),
    "csv": (tables.write_csv, tables.read_csv),
    "json": (whole.write_json, whole.read_json),
    "coco": (coco.write_coco, _drawn("coco")),
    "labelme": (labelme.write_labelme, _drawn("labelme")),
    "cvat": (cvat.write_cvat, _drawn("cvat")),
    "parquet": (parquet.write_parquet, parquet.read_parquet),
}
"""How each format is written and read."""

TITLES = {
    "csv": "CSV: column, row, visible",
    "json": "JSON with everything",
    "mask": "Masks",
    "painted": "Painted photos, Web layout",
    "ch1": "CH1 layout",
    "coco": "COCO",
    "labelme": "LabelMe",
    "cvat": "CVAT",
    "parquet": "Parquet: a table of labels",
}
"""What each format is called where people choose one."""

WITHOUT_PHOTOS = ("csv", "json")
"""Formats that say nothing of a photo's file but its name."""

_LOSES_VISIBILITY = ("mask", "ch1", "coco")
_CARRIES_COMMENTS = ("json", "labelme")
_NEEDS_A_LINE = (*_LOSES_VISIBILITY, "painted")


@dataclass(frozen=True)
class Export:
    """What an export came to."""

    written: int
    """Number of labels."""

    notes: tuple[str, ...]
    """A sentence for each label that was left out, and for what the format cannot carry."""


def export_labels(
    labels: Iterable[Label],
    photos: Path,
    out: Path,
    format: str,  # noqa: A002
    contents: Contents | None = None,
    *,
    orphans: bool = False,
) -> Export:
    """Write labels into a new folder. A label is written for the photo that it was made for.

    Args:
        labels: The labels.
        photos: Folder of the photos.
        out: Where to; it does not exist yet, or is empty.
        format: One of `FORMATS`.
        contents: What is in the files of the photos; they are read unless it is given.
        orphans: Whether the labels are of photos that are not in the folder any more.

    Raises:
        FormatError: There is nothing to export, the folder holds something, the format is none, or
            needs photos that are not there.
    """
    if format not in FORMATS:
        raise FormatError(f"{format!r} is no format; there are {', '.join(FORMATS)}.")
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise FormatError(f"{out} exists already; name a folder that does not.")
    if orphans and format not in WITHOUT_PHOTOS:
        formats = " and ".join(WITHOUT_PHOTOS)
        raise FormatError(f"labels without their photos leave as {formats} only, not as {format}.")
    if orphans:
        entries, notes = orphans_of(labels, photos)
    else:
        entries, notes = entries_of(labels, photos, contents)
    if format != "json":
        entries, more = one_each(entries)
        notes += more
    if not entries:
        reasons = f" {notes[0]}" if notes else ""
        raise FormatError(f"there is nothing to export: no photo has been accepted.{reasons}")
    if format in _NEEDS_A_LINE:
        entries, more = with_a_line(entries, format)
        notes += more
    if not entries:
        raise FormatError(
            f"there is nothing to export: {format} cannot say that nothing is visible."
        )
    notes += _lost(entries, format)
    make_folder(out.parent)
    with passing_folder(".export-", out.parent) as folder:
        inside = folder / "whole"
        inside.mkdir()
        FORMATS[format][0](entries, inside)
        if out.exists():
            out.rmdir()  # it is empty
        move_folder(inside, out)
    return Export(len(entries), tuple(notes))


def _lost(entries: list[Entry], format: str) -> Iterator[str]:  # noqa: A002
    """A sentence for each thing that a format cannot say, with the photos of which it is lost."""
    losses: dict[str, tuple[bool, Callable[[Entry], bool]]] = {
        "which columns are not visible": (
            format in _LOSES_VISIBILITY,
            lambda entry: not bool(entry.skyline.visible.all()),
        ),
        "why columns are not visible": (
            format not in (*_LOSES_VISIBILITY, *WITHOUT_PHOTOS),
            lambda entry: any(one.why for one in entry.label.hidden),
        ),
        "what was said of a photo": (
            format not in _CARRIES_COMMENTS,
            lambda entry: entry.label.comment is not None,
        ),
    }
    for what, (loses, has) in losses.items():
        names = [entry.label.name for entry in entries if loses and has(entry)]
        if names:
            yield f"{format} cannot say {what}: {listed(names)}."


def archive(
    labels: Iterable[Label],
    photos: Path,
    format: str,  # noqa: A002
    contents: Contents | None = None,
    notes: Iterable[str] = (),
) -> bytes:
    """Export labels into a ZIP file; `notes` and what was left out are in its ``notes.txt``."""
    packed = io.BytesIO()
    with passing_folder() as folder, zipfile.ZipFile(packed, "w") as file:
        out = folder / "export"
        export = export_labels(labels, photos, out, format, contents)
        for path in sorted(out.rglob("*")):
            if path.is_file():
                file.write(path, path.relative_to(out).as_posix(), zipfile.ZIP_DEFLATED)
        if said := [*notes, *export.notes]:
            file.writestr("notes.txt", "\n".join(said) + "\n")
        shutil.rmtree(out)
    return packed.getvalue()


def import_labels(
    source: Path,
    photos: Path,
    names: Iterable[str],
    format: str | None = None,  # noqa: A002
    *,
    label: str | None = None,
    sky: str | None = None,
    terrain: str | None = None,
    contents: Contents | None = None,
) -> Imports:
    """Read labels. What is wrong with one of them is said, and the others are read.

    Args:
        source: File, folder or ZIP, as `export_labels` or another tool wrote it.
        photos: Folder of the photos.
        names: Names of the photos below the folder, with ``/`` between folders.
        format: One of `FORMATS`; told by the content unless given.
        label: Label of the lines that are skylines, or of the regions that are sky; several with
            commas between, compared without case. ``skyline``, ``horizon`` and ``sky`` unless
            given.
        sky: Label of the regions that are sky, or the value of a mask, as `read_truth` takes it.
        terrain: Label of the regions that are terrain, or the value of a mask.
        contents: What is in the files of the photos, where that is known.

    Raises:
        FormatError: Damaged, of no known format, or about no photo of the folder; the message says
            what was found instead.
    """
    if not source.exists():
        raise FormatError(f"{source} does not exist.")
    if format is not None and format not in FORMATS:
        raise FormatError(f"{format!r} is no format; there are {', '.join(FORMATS)}.")
    if sky is not None and terrain is not None:
        raise FormatError("say which label or value is sky, or which is terrain, and not both.")
    names = tuple(names)
    below = names_below(photos)
    copies = (contents or Contents(photos, names)).copies(below)
    with unpacked(source) as place:
        files = files_below(place)
        task = Task(
            source=place,
            files=tuple(files),
            photos=photos,
            given=names,
            names=PhotoNames(names, below, copies),
            found=Found(),
            contents=contents,
            wanted=Wanted.of(label, sky, terrain),
            sky=sky,
            terrain=terrain,
        )
        try:
            FORMATS[format or format_of(place, files)][1](task)
        except FormatError as error:
            raise FormatError(_unpacked_name(str(error), place, source)) from error
        except MemoryError as error:
            raise FormatError(f"{source} does not fit into memory.") from error
    found = task.found
    unite_copies(found, copies)
    found.problems[:] = [_unpacked_name(one, place, source) for one in found.problems]
    if not found.labels:
        reasons = [*found.problems, *found.notes]
        if len(reasons) == 1 and not reasons[0].startswith("found labels"):
            raise FormatError(reasons[0])
        why = f": {' '.join(reasons[:3])}" if reasons else "."
        raise FormatError(f"{source} holds no label of a photo in {photos}{why}")
    return found.outcome()


def _unpacked_name(text: str, place: Path, source: Path) -> str:
    """Text that names the ZIP, and not where it was unpacked."""
    return text if place == source else text.replace(f"{place}", f"{source}")


__all__ = [
    "FORMATS",
    "Entry",
    "Export",
    "FormatError",
    "Imported",
    "Imports",
    "archive",
    "export_labels",
    "format_of",
    "import_labels",
]
