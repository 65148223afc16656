"""A table of labels as a data set: a row a photo, in Parquet, for photos that fit no folder.

============  ==============  ====================================================================
column        type            meaning
============  ==============  ====================================================================
photo         text            address, or path: from the folder of the table, or else from here
rows          list of number  row of the first terrain pixel of each column, null for no label
visible       list of bool    whether the line can be seen there; may be missing
height        integer         of the photo, in pixels; may be missing
width         integer         as that
sha256        text            digest of the photo's file, in hexadecimal digits; may be missing
============  ==============  ====================================================================

Other columns do not matter, so what ``skyline-viz detect --out FILE.parquet`` writes is such a
table, of detections; the data set says so. A table is one file, or a folder of several, whose name
ends in ``.parquet``; at a path or an address. Each photo is downloaded when its turn comes, and
nothing of it is kept.

Opening a table passes over it once, and keeps names and sizes. A truth is read again with the row
group that it lies in, and travels with its photo, so that other machines need no table. A table in
a storage, or with large groups, is kept in small ones on this machine, see `small_groups`.
"""

from __future__ import annotations

import os
import posixpath
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import takewhile
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from skyline_viz.datasets.dataset import Dataset, DatasetError
from skyline_viz.datasets.tables.parquet_files import files_of, parquet
from skyline_viz.datasets.tables.small_groups import columns_of, in_small_groups
from skyline_viz.datasets.tables.table_item import RowPlace, TableItem, row_group
from skyline_viz.storage.addresses import is_address
from skyline_viz.storage.parts import file_part
from skyline_viz.storage.stored_photo import StoredPhoto
from skyline_viz.system.names import listed

_SIDES, _LONGEST = ("height", "width"), 10**6  # pixels
_DETECTED = b"skyline"  # metadata of what a detector has written


def open_label_table(where: str) -> Dataset:
    """Open a table of labels. Photos are not looked at.

    Args:
        where: Path or address of the table.

    Raises:
        DatasetError: It is missing, damaged or no table of labels.
        StorageError: Its address leads nowhere, or pyarrow is not installed.
    """
    where = where.rstrip("/\\")
    row_group.cache_clear()  # the table may be another one than it was
    problems: list[str] = []
    found: dict[str, tuple[RowPlace | None, dict[str, Any]]] = {}
    twice: dict[str, None] = {}
    for row, named, labelled, about in _rows(where, problems):
        photo = place_of_photo(where, named)
        if photo in found:
            twice[photo] = None
        else:
            found[photo] = row if labelled else None, about
    if twice:
        problems.append(f"of several rows of a photo the first counts: {listed([*twice])}.")
    if not found:
        raise DatasetError(f"{where} names no photo.")
    items, unsized = [], []
    for name, (photo, (place, about)) in zip(names_of([*found]), found.items(), strict=True):
        try:
            size = _size(about)
        except ValueError:
            size = None
            unsized.append(photo)
        items.append(
            TableItem(
                name,
                Path(photo),
                stored=StoredPhoto(photo),
                pixels=size,
                sha256=about.get("sha256") or "",
                place=place,
            )
        )
    if unsized:
        problems.append(f"heights or widths that are no size are not looked at: {listed(unsized)}.")
    return Dataset(PurePosixPath(where).stem, "table", tuple(items), tuple(problems))


def _rows(where: str, problems: list[str]) -> Iterator[tuple[RowPlace, str, bool, dict[str, Any]]]:
    """Where each row of a table is, its photo, whether it has a line, and what else it says."""
    detected: list[str] = []
    for file in files_of(where):
        near, version = in_small_groups(file)
        with parquet(near) as table:
            columns = columns_of(table, file)
            if _DETECTED in (table.schema_arrow.metadata or {}):
                detected.append(PurePosixPath(file).name)
            for group in range(table.num_row_groups):
                part = table.read_row_group(group, columns=columns)
                labelled = part.column("rows").is_valid().to_pylist()
                told = part.select([one for one in columns if one not in ("rows", "visible")])
                for row, about in enumerate(told.to_pylist()):
                    if photo := about.pop("photo"):
                        yield RowPlace(near, version, group, row), photo, labelled[row], about
                    else:
                        problems.append(f"row {row + 1} of group {group + 1} names no photo.")
    if detected:
        problems.append(f"lines that a detector found are taken for truths: {listed(detected)}.")


def names_of(photos: Sequence[str]) -> list[str]:
    """A name for each photo: what tells it from the others."""
    plain = [StoredPhoto(photo).stem for photo in photos]
    if max(Counter(plain).values()) == 1:
        return plain
    homes = [photo[: photo.rfind("/") + 1] for photo in photos]
    first, last = min(homes), max(homes)  # what these share is shared by all between
    same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(first, last)))  # noqa: B905
    below = first.rfind("/", 0, same) + 1
    names = [home[below:] + stem for home, stem in zip(homes, plain, strict=True)]
    if max(Counter(names).values()) == 1:
        return names
    return [photo[below:] for photo in photos]


def place_of_photo(where: str, photo: str) -> str:
    """Path or address of a photo that a table names."""
    if is_address(photo) or Path(photo).is_absolute():
        return photo
    if is_address(where):
        _, chain, around = where.partition("::")
        scheme, _, path = file_part(where).partition("://")
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), photo))
        return f"{scheme}://{beside}{chain}{around}"
    beside = os.path.normpath(Path(where).parent / photo)
    return photo if not os.path.exists(beside) and os.path.exists(photo) else beside  # noqa: PTH110


def _size(about: dict[str, Any]) -> tuple[int, int] | None:
    """Height and width that a row tells; None where one is missing.

    Raises:
        ValueError: They are none.
    """
    height, width = (np.nan if (one := about.get(side)) is None else one for side in _SIDES)
    if np.isnan(height) or np.isnan(width):
        return None
    if not all(one == int(one) and 0 < one <= _LONGEST for one in (height, width)):
        raise ValueError
    return int(height), int(width)
