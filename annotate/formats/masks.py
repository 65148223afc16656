"""Labels as pictures: masks, photos with the line painted on, and the layout of CH1.

``names.csv`` in a painted export says which photo each number stands for.
"""

from __future__ import annotations

import csv
import re
import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from annotate.formats.common import Entry, FormatError, Imported, check_size
from skyline_viz.photo import PHOTO_SUFFIXES, PhotoError, photo_size, read_photo, write_photo
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.truths import read_truth

CH1_PART = "cvg"
"""The folder of CH1 in which an export lies; `skyline_viz.open_dataset` knows it."""

_INDEX, _HEADER = "names.csv", ["file", "photo"]
_ADDED = re.compile(r"([-_]mask|_edge)$", re.IGNORECASE)


def write_masks(entries: list[Entry], folder: Path) -> None:
    """Write a mask for each photo: 0 is sky, 255 terrain."""
    for entry in entries:
        write_photo(folder / "masks" / f"{entry.stem}.png", _mask(entry))


def read_masks(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read the masks of a folder, or one of them."""
    folder = source / "masks" if (source / "masks").is_dir() else source
    return _read(_pictures(folder), photos, names)


def write_ch1(entries: list[Entry], folder: Path) -> None:
    """Write copies of the photos, and masks beside them."""
    part = folder / CH1_PART
    for entry in entries:
        write_photo(part / "ground_truth" / f"{entry.stem}-mask.png", _mask(entry))
        (part / "images").mkdir(exist_ok=True)
        suffix = entry.photo.suffix.lower()
        shutil.copyfile(entry.photo, part / "images" / f"{entry.stem}{suffix}")


def read_ch1(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read the masks of all parts of CH1, or one of them."""
    if source.is_file():
        return _read([source], photos, names)
    found = [one for place in sorted(source.glob("*/ground_truth")) for one in _pictures(place)]
    return _read(found, photos, names)


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
    with (folder / _INDEX).open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n", quoting=csv.QUOTE_ALL).writerows(lines)


def read_painted(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read painted photos; their names are looked up in ``names.csv`` where there is one."""
    folder = source.parent if source.is_file() else source
    index = _read_index(folder if (folder / _INDEX).is_file() else folder.parent)
    if source.is_file():
        files = [source]
    else:
        files = _pictures(folder / "ground_truth" if (folder / "ground_truth").is_dir() else folder)
    known = {file: names[photo] for file, photo in index.items() if photo in names}
    if index:
        files = [file for file in files if file.name in known]
        return _read(
            files, photos, {_ADDED.sub("", Path(file).stem): known[file] for file in known}
        )
    return _read(files, photos, names)


def _read(files: Iterable[Path], photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Labels of the files that are about a photo; another size than the photo's is an error."""
    found = []
    for file in files:
        name = names.get(file.stem) or names.get(_ADDED.sub("", file.stem))
        if name is None:
            continue
        try:
            size, wanted = photo_size(file), photo_size(photos / name)
            if size != wanted:
                raise FormatError(
                    f"{file} has {size[1]}x{size[0]} pixels, and {name} {wanted[1]}x{wanted[0]}."
                )
            skyline: Skyline = read_truth(file)
        except (PhotoError, SkylineError) as error:
            raise FormatError(str(error)) from error
        found.append(Imported(name, check_size(name, skyline, photos)))
    return found


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


def _pictures(folder: Path) -> list[Path]:
    return sorted(
        file
        for file in (folder.iterdir() if folder.is_dir() else [folder])
        if file.suffix.lower() in PHOTO_SUFFIXES and not file.name.startswith(".")
    )
