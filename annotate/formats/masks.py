"""Labels as pictures: masks, painted photographs, and the layouts in which data sets have them."""

from __future__ import annotations

import csv
import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from annotate.formats.common import Entry, FormatError, Imported, check_width
from skyline_viz.arrays import U8
from skyline_viz.photo import read_photo, write_photo
from skyline_viz.skyline import SkylineError
from skyline_viz.truths import read_truth

CH1_PART = "cvg"
"""The part of the CH1 data set whose name is used."""

_NAMES = "names.csv"


def write_masks(entries: list[Entry], folder: Path) -> None:
    """Write a mask for each photo: 0 is sky, 255 terrain."""
    for entry in entries:
        write_photo(folder / "masks" / f"{entry.stem}.png", _mask(entry))


def read_masks(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read a mask, those of a folder, or those of the folder ``masks`` in it."""
    if source.is_file():
        return _read([source], photos, names)
    folder = source / "masks" if (source / "masks").is_dir() else source
    return _read(_files(folder), photos, names)


def write_ch1(entries: list[Entry], folder: Path) -> None:
    """Write photos and masks as the CH1 data set has them."""
    images = folder / CH1_PART / "images"
    images.mkdir(parents=True)
    for entry in entries:
        shutil.copyfile(entry.photo, images / f"{entry.stem}{entry.photo.suffix}")
        truth = folder / CH1_PART / "ground_truth" / f"{entry.stem}-mask.png"
        write_photo(truth, _mask(entry))


def read_ch1(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read the masks of a data set in the CH1 layout."""
    truths = [part / "ground_truth" for part in sorted(source.iterdir())]
    files = [file for folder in truths if folder.is_dir() for file in _files(folder)]
    return _read(files, photos, names, added="-mask")


def write_painted(entries: list[Entry], folder: Path) -> None:
    """Write photos and painted photos as the Web data set has them, and which number is which."""
    with (folder / _NAMES).open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["number", "photo"])
        for number, entry in enumerate(entries, 1):
            pixels = read_photo(entry.photo)
            write_photo(folder / "images" / f"R_GImag{number:04d}.bmp", pixels)
            write_photo(_painted(folder, number), entry.skyline.to_painted(pixels))
            writer.writerow([number, entry.stem])


def read_painted(source: Path, photos: Path, names: Mapping[str, str]) -> list[Imported]:
    """Read painted photos that `write_painted` wrote."""
    try:
        with (source / _NAMES).open(newline="", encoding="utf-8") as file:
            numbered = [row for row in csv.reader(file) if row][1:]
    except (OSError, ValueError, csv.Error) as error:
        told = source / _NAMES
        raise FormatError(f"{told} says which photo is which, and cannot be read.") from error
    known = {
        _painted(source, int(row[0])): names[row[1]]
        for row in numbered
        if len(row) == 2 and row[0].isdecimal() and row[1] in names
    }
    return _read(known, photos, {file.stem: name for file, name in known.items()})


def _painted(folder: Path, number: int) -> Path:
    return folder / "ground_truth" / f"GT_GoogleImage{number:03d}_Edge.bmp"


def _mask(entry: Entry) -> U8:
    terrain = ~entry.skyline.to_mask(entry.label.height)
    return terrain.astype(np.uint8) * np.uint8(255)


def _files(folder: Path) -> list[Path]:
    return sorted(file for file in folder.glob("*.png") if not file.name.startswith("."))


def _read(
    files: Iterable[Path], photos: Path, names: Mapping[str, str], added: str = ""
) -> list[Imported]:
    found = []
    for file in files:
        stem = file.stem.removesuffix(added)
        if stem not in names:
            continue
        try:
            truth = read_truth(file)
        except SkylineError as error:
            raise FormatError(str(error)) from error
        found.append(Imported(names[stem], check_width(names[stem], truth, photos)))
    return found
