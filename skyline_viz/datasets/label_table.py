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
table. A table is one file, or a folder of several, whose name ends in ``.parquet``; at a path or an
address. Each photo is downloaded when its turn comes, and nothing of it is kept.

Opening a table passes over it once, and keeps names and sizes. A truth is read again with the row
group that it lies in, and travels with its photo, so that other machines need no table. Groups of
some thousand rows are good: two of them are held.
"""

from __future__ import annotations

import hashlib
import os
import posixpath
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import takewhile
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from skyline_viz.arrays import U8
from skyline_viz.datasets.dataset import Dataset, DatasetError
from skyline_viz.datasets.stored_item import StoredItem
from skyline_viz.photo import PhotoError
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.storage.addresses import address_of, file_system, is_address, naming, needed
from skyline_viz.storage.stored_photo import StoredPhoto
from skyline_viz.system.names import listed

SUFFIX = ".parquet"
"""How the name of a table ends."""

_NEEDED = ("photo", "rows")
_OTHERS = ("visible", "height", "width", "sha256")


def is_label_table(where: str | os.PathLike[str]) -> bool:
    """Whether a path or an address is that of a table.

    >>> is_label_table("s3://labels/alps.parquet"), is_label_table("photos")
    (True, False)
    """
    return os.fspath(where).rstrip("/\\").lower().endswith(SUFFIX)


@dataclass(frozen=True, slots=True)
class RowPlace:
    """Where a row lies."""

    file: str
    """Path or address of the table's file."""

    group: int
    """Number of its row group."""

    row: int
    """Number in the group."""

    photo: str
    """The photo that it names."""


@dataclass(frozen=True)
class TableItem(StoredItem):
    """A photo of a table, and its truth."""

    pixels: tuple[int, int] | None = None
    """Height and width, where the table says them."""

    sha256: str = ""
    """Digest of the photo that was labelled; empty where the table does not say it."""

    place: RowPlace | None = None
    """Where its truth is; None where it has none, or has it with it."""

    line: Skyline | None = None
    """Its truth, once it travels."""

    @property
    def has_truth(self) -> bool:
        """Whether there is a truth, sound or damaged."""
        return self.place is not None or self.line is not None or super().has_truth

    def size(self) -> tuple[int, int] | None:
        """Height and width that the table says; None where it says nothing."""
        return self.pixels

    def photo(self) -> U8:
        """Read the photo, and make sure that it is the one that was labelled.

        Raises:
            PhotoError: It cannot be read, or is another one.
            StorageError: It cannot be downloaded.
        """
        if self.sha256 and hashlib.sha256(self.file()).hexdigest() != self.sha256.lower():
            raise PhotoError(
                f"{self.where} is not the file that was labelled: its SHA-256 is another one; "
                f"leave the column sha256 out to take it all the same."
            )
        found = super().photo()
        if self.pixels is not None and found.shape[:2] != self.pixels:
            (height, width), (rows, columns) = found.shape[:2], self.pixels
            raise PhotoError(
                f"{self.where} has {width}x{height} pixels, and its label is for {columns}x{rows}."
            )
        return found

    def truth(self) -> Skyline | None:
        """The line of its row; None where there is none.

        Raises:
            SkylineError: It is damaged, or the table has changed.
            StorageError: The table cannot be downloaded.
        """
        if self.truth_path is not None:  # another one was named
            return super().truth()
        if self.place is None:
            return self.line
        return _line(self.place, self.where)

    def contents(self) -> Iterator[bytes]:
        """What tells the contents of the photo, and of its truth; see `StoredItem.contents`."""
        yield from super().contents()
        if (line := self.truth()) is not None:
            yield hashlib.sha256(line.rows.tobytes() + line.visible.tobytes()).digest()

    def without_truth(self) -> TableItem:
        """The photo alone."""
        return replace(self, truth_path=None, place=None, line=None)

    def __getstate__(self) -> dict[str, Any]:
        """As it travels: with its truth."""
        if self.place is None:
            return self.__dict__
        return {**self.__dict__, "line": self.truth(), "place": None}


def open_label_table(where: str) -> Dataset:
    """Open a table of labels. Photos are not looked at.

    Args:
        where: Path or address of the table.

    Raises:
        DatasetError: It is missing, damaged or no table of labels.
        StorageError: Its address leads nowhere, or pyarrow is not installed.
    """
    where = where.rstrip("/\\")
    _group.cache_clear()  # the table may be another one than it was
    places: list[tuple[RowPlace | None, str, dict[str, Any]]] = []
    problems: list[str] = []
    seen: Counter[str] = Counter()
    for file in _files(where):
        with _parquet(file) as table:
            columns = _columns(table, file)
            for group in range(table.num_row_groups):
                part = table.read_row_group(group, columns=[*columns])
                told = part.select([one for one in columns if one not in ("rows", "visible")])
                labelled = part.column("rows").is_valid().to_pylist()
                for row, about in enumerate(told.to_pylist()):
                    photo = about["photo"]
                    if not photo:
                        problems.append(f"row {row + 1} of group {group + 1} names no photo.")
                        continue
                    seen[photo] += 1
                    if seen[photo] == 1:
                        place = RowPlace(file, group, row, photo) if labelled[row] else None
                        places.append((place, photo, about))
    if twice := [photo for photo, count in seen.items() if count > 1]:
        problems.append(f"of several rows of a photo the first counts: {listed(twice)}.")
    if not places:
        raise DatasetError(f"{where} names no photo.")
    photos = [_named(where, photo) for _, photo, _ in places]
    items = [
        TableItem(
            name,
            Path(photo),
            stored=StoredPhoto(photo),
            pixels=_size(about),
            sha256=about.get("sha256") or "",
            place=place,
        )
        for name, photo, (place, _, about) in zip(_names(photos), photos, places, strict=True)
    ]
    return Dataset(PurePosixPath(where).stem, "table", tuple(items), tuple(problems))


def _names(photos: Sequence[str]) -> list[str]:
    """A name for each photo: what tells it from the others."""
    plain = [StoredPhoto(photo).stem for photo in photos]
    if max(Counter(plain).values()) == 1:
        return plain
    homes = [posixpath.dirname(photo.replace("\\", "/")) for photo in photos]
    first, last = min(homes) + "/", max(homes) + "/"  # what these share is shared by all between
    same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(first, last)))  # noqa: B905
    below = first.rfind("/", 0, same) + 1
    names = [f"{home}/"[below:] + stem for home, stem in zip(homes, plain, strict=True)]
    if max(Counter(names).values()) == 1:
        return names
    return [photo[below:] for photo in photos]


def _named(where: str, photo: str) -> str:
    """Path or address of a photo that a table names."""
    if is_address(photo) or Path(photo).is_absolute():
        return photo
    if is_address(where):
        inner, chain, around = where.partition("::")
        scheme, _, path = inner.partition("?")[0].partition("://")
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), photo))
        return f"{scheme}://{beside}{chain}{around}"
    beside = os.path.normpath(Path(where).parent / photo)
    return photo if not os.path.exists(beside) and os.path.exists(photo) else beside  # noqa: PTH110


def _size(about: dict[str, Any]) -> tuple[int, int] | None:
    height, width = about.get("height"), about.get("width")
    return None if height is None or width is None else (int(height), int(width))


def _files(where: str) -> list[str]:
    """The file of a table, or those of a folder of tables."""
    if is_address(where):
        found, path = file_system(where)
        with naming(where):
            if not found.isdir(path):
                return [where]
            inside = sorted(one for one in found.ls(path, detail=False) if is_label_table(one))
        files = [address_of(found, one, where) for one in inside]
    else:
        if not Path(where).is_dir():
            return [where]
        files = sorted(str(one) for one in Path(where).iterdir() if is_label_table(one))
    if not files:
        raise DatasetError(f"{where} holds no table, a file *{SUFFIX}.")
    return files


@contextmanager
def _parquet(file: str) -> Iterator[Any]:
    """An open table.

    Raises:
        DatasetError: It is missing, damaged, or no table.
        StorageError: Its address leads nowhere.
    """
    parquet = needed("pyarrow.parquet", "a table of labels")
    try:
        if is_address(file):
            found, path = file_system(file)
            with naming(file):
                opened = found.open(path, "rb")
        else:
            opened = Path(file).open("rb")  # noqa: SIM115 - closed below
        with opened, parquet.ParquetFile(opened) as table:
            yield table
    except needed("pyarrow", "a table of labels").ArrowException as error:
        raise DatasetError(f"{file} is damaged, or no Parquet table.") from error
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise DatasetError(f"{file} cannot be read: {reason}.") from error


def _columns(table: Any, file: str) -> list[str]:  # noqa: ANN401
    """Names of the columns that are read.

    Raises:
        DatasetError: One is missing, or holds something else.
    """
    arrow = needed("pyarrow", "a table of labels")
    schema = table.schema_arrow
    if missing := [one for one in _NEEDED if one not in schema.names]:
        raise DatasetError(
            f"{file} has no column {missing[0]}; a table of labels has photo and rows."
        )
    kinds, photo, rows = arrow.types, schema.field("photo").type, schema.field("rows").type
    if not (kinds.is_string(photo) or kinds.is_large_string(photo)):
        raise DatasetError(f"the column photo of {file} holds {photo}, and not text.")
    lists = kinds.is_list(rows) or kinds.is_large_list(rows) or kinds.is_fixed_size_list(rows)
    inside = rows.value_type if lists else rows
    if not lists or not (kinds.is_floating(inside) or kinds.is_integer(inside)):
        raise DatasetError(f"the column rows of {file} holds {rows}, and not lists of numbers.")
    return [one for one in (*_NEEDED, *_OTHERS) if one in schema.names]


@lru_cache(maxsize=2)
def _group(file: str, number: int) -> Any:  # noqa: ANN401
    """The lines of a row group."""
    with _parquet(file) as table:
        names = [one for one in ("photo", "rows", "visible") if one in table.schema_arrow.names]
        return table.read_row_group(number, columns=names)


def _line(place: RowPlace, photo: str) -> Skyline:
    """The line of a row.

    Raises:
        SkylineError: It is damaged, or the table has changed.
    """
    try:
        group = _group(place.file, place.group)
        if group.column("photo")[place.row].as_py() != place.photo:
            raise SkylineError("the table has changed since it was opened.")
        rows = group.column("rows")[place.row].values.to_numpy(zero_copy_only=False)
        visible = np.isfinite(rows)
        if "visible" in group.column_names and group.column("visible")[place.row].is_valid:
            told = group.column("visible")[place.row].values.fill_null(False)
            visible = visible & told.to_numpy(zero_copy_only=False)
        return Skyline(np.where(np.isfinite(rows), rows, 0), visible)
    except (DatasetError, IndexError, TypeError, ValueError) as error:
        raise SkylineError(f"{photo}: its row of {place.file} cannot be read: {error}") from error
