"""Labels as pictures: masks, photos with the line painted on, and the layout of CH1.

``names.csv`` in an export with photos says which photo each truth is of. It also tells that the
photos are copies.
"""

from __future__ import annotations

import csv
import shutil
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from annotate.formats.common import Entry, Imported, check_size
from annotate.formats.importing import Task
from skyline_viz.datasets.label_picture import label_size
from skyline_viz.datasets.matching import TRUTH_FOLDERS
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.datasets.truths import truth_with_notes
from skyline_viz.photo import PHOTO_SUFFIXES, PhotoError, photo_size, read_photo, write_photo
from skyline_viz.skyline import Skyline, SkylineError

CH1_PART = "cvg"
"""The folder of CH1 in which an export lies; `skyline_viz.open_dataset` knows it."""

_INDEX, _HEADER = "names.csv", ["file", "photo"]


def write_masks(entries: list[Entry], folder: Path) -> None:
    """Write a mask for each photo: 0 is sky, 255 terrain."""
    for entry in entries:
        write_photo(folder / "masks" / f"{entry.stem}.png", _mask(entry))


def read_masks(task: Task) -> None:
    """Read masks: those in folders of truths, or else all pictures."""
    pictures = [file for file in task.files if file.suffix.lower() in PHOTO_SUFFIXES]
    for place in ("SegmentationClass", *TRUTH_FOLDERS):
        if inside := [one for one in pictures if one.parent.name.lower() == place.lower()]:
            pictures = inside
            break
    _read(pictures, task)


def write_ch1(entries: list[Entry], folder: Path) -> None:
    """Write copies of the photos, and masks beside them."""
    part = folder / CH1_PART
    lines = [_HEADER]
    for entry in entries:
        mask = f"{entry.stem}-mask.png"
        write_photo(part / "ground_truth" / mask, _mask(entry))
        (part / "images").mkdir(exist_ok=True)
        suffix = entry.photo.suffix.lower()
        shutil.copyfile(entry.photo, part / "images" / f"{entry.stem}{suffix}")
        lines.append([mask, entry.label.name])
    _write_index(folder, lines)


def read_ch1(task: Task) -> None:
    """Read the masks of all parts of CH1, or one of them."""
    pictures = [file for file in task.files if file.suffix.lower() in PHOTO_SUFFIXES]
    inside = [file for file in pictures if file.parent.name.lower() == "ground_truth"]
    _read(inside or pictures, task)


def write_painted(entries: list[Entry], folder: Path) -> None:
    """Write the photos and their painted copies, numbered, and which photo each number is.

    Raises:
        FormatError: A photo cannot be read, or its line cannot be painted.
    """
    lines = [_HEADER]
    for number, entry in enumerate(entries, 1):
        try:
            photo = read_photo(entry.photo)
            if not entry.skyline.visible.any():
                raise SkylineError("no column of its line is visible")
            painted = entry.skyline.to_painted(photo, "red")
        except PhotoError as error:
            raise FormatError(str(error)) from error
        except SkylineError as error:
            raise FormatError(f"{entry.label.name} cannot be painted: {error}.") from error
        truth = f"GT_GoogleImage{number:03}_Edge.bmp"
        write_photo(folder / "images" / f"R_GImag{number:04}.bmp", photo)
        write_photo(folder / "ground_truth" / truth, painted)
        lines.append([truth, entry.label.name])
    _write_index(folder, lines)


def _write_index(folder: Path, lines: list[list[str]]) -> None:
    with (folder / _INDEX).open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n", quoting=csv.QUOTE_ALL).writerows(lines)


def read_painted(task: Task) -> None:
    """Read painted photos; their names are looked up in ``names.csv`` where there is one."""
    source = task.source
    folder = source.parent if source.is_file() else source
    index = _read_index(folder if (folder / _INDEX).is_file() else folder.parent)
    pictures = [file for file in task.files if file.suffix.lower() in PHOTO_SUFFIXES]
    inside = [file for file in pictures if file.parent.name.lower() == "ground_truth"]
    if not index:
        _read(inside or pictures, task)
        return
    files = {file.name: file for file in inside or pictures}
    matched = task.names.of_references(index[name] for name in files if name in index)
    for sentence in matched.unclear:
        task.found.problem(sentence)
    for name, file in files.items():
        photo = matched.photos.get(index.get(name, ""))
        if photo is None:
            task.found.note("painted photos belong to no photo of the folder", name)
            continue
        try:
            line = _line_of(file, photo, task)
            found = Imported(photo, check_size(photo, line, task.photos))
            task.found.labels.append(found)
        except (FormatError, PhotoError, SkylineError) as error:
            task.found.problem(str(error))


def _read(files: Iterable[Path], task: Task) -> None:
    task.read_each(files, lambda file, photo: _line_of(file, photo, task))


def _line_of(file: Path, photo: str, task: Task) -> Skyline:
    """The line of a picture; another size than the photo's is an error."""
    size, wanted = label_size(file), photo_size(task.photos / photo)
    if size != wanted:
        raise FormatError(
            f"{file} has {size[1]}x{size[0]} pixels, and {photo} {wanted[1]}x{wanted[0]}."
        )
    line = truth_with_notes(file, sky=task.sky, terrain=task.terrain)
    for note in line.notes:
        task.found.note(note, photo)
    return line.skyline


def _read_index(folder: Path) -> dict[str, str]:
    """Photo of each painted file; empty where there is no index."""
    path = folder / _INDEX
    if not path.is_file():
        return {}
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            lines = list(csv.reader(file))
    except (OSError, ValueError, csv.Error) as error:
        raise FormatError(f"{path} cannot be read: {error}.") from error
    if not lines or lines[0] != _HEADER or any(len(line) != 2 for line in lines):
        raise FormatError(f"{path} is not a list of file and photo.")
    return dict(line for line in lines[1:])


def _mask(entry: Entry) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    sky = entry.skyline.to_mask(entry.label.height)
    return np.where(sky, 0, 255).astype(np.uint8)
