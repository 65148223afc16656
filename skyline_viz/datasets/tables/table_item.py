"""A photo of a table of labels: its truth is a row, which is read when it is asked for."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from skyline_viz.arrays import U8
from skyline_viz.datasets.dataset import DatasetError
from skyline_viz.datasets.stored_item import StoredItem
from skyline_viz.datasets.tables.parquet_files import parquet, version_of
from skyline_viz.photo import PhotoError
from skyline_viz.skyline import Skyline, SkylineError


@dataclass(frozen=True, slots=True)
class RowPlace:
    """Where a row lies."""

    file: str
    """The table's file, on this machine and in small groups."""

    version: str
    """What tells the file from another one, see `version_of`; empty where nobody changes it."""

    group: int
    """Number of its row group."""

    row: int
    """Number in the group."""


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

    fault: str = ""
    """Why its truth could not be read, once it travels, in a sentence."""

    @property
    def has_truth(self) -> bool:
        """Whether there is a truth, sound or damaged."""
        own = self.place is not None or self.line is not None or self.fault
        return bool(own) or super().has_truth

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
        """
        if self.truth_path is not None:  # another one was named
            return super().truth()
        if self.fault:
            raise SkylineError(self.fault)
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
        return replace(self, truth_path=None, place=None, line=None, fault="")

    def __getstate__(self) -> dict[str, Any]:
        """As it travels: with its truth, or what is wrong with that."""
        if self.place is None:
            return self.__dict__
        line, fault = None, ""
        try:
            line = _line(self.place, self.where)
        except SkylineError as error:
            fault = str(error)
        return {**self.__dict__, "line": line, "fault": fault, "place": None}


@lru_cache(maxsize=2)
def row_group(file: str, version: str, number: int) -> Any:  # noqa: ANN401
    """The lines of a row group.

    Raises:
        DatasetError: The file cannot be read, or has changed.
    """
    with parquet(file) as table:
        if version and version_of(file) != version:
            raise DatasetError("it has changed since the table was opened.")
        names = [one for one in ("rows", "visible") if one in table.schema_arrow.names]
        return table.read_row_group(number, columns=names)


def _line(place: RowPlace, photo: str) -> Skyline:
    """The line of a row.

    Raises:
        SkylineError: It is damaged, or the table has changed.
    """
    try:
        group = row_group(place.file, place.version, place.group)
        rows = group.column("rows")[place.row].values.to_numpy(zero_copy_only=False)
        visible = np.isfinite(rows)
        if "visible" in group.column_names and group.column("visible")[place.row].is_valid:
            told = group.column("visible")[place.row].values.fill_null(False)
            if len(told) != len(rows):
                raise SkylineError(f"it has {len(rows)} rows, and visible {len(told)} values.")
            visible = visible & told.to_numpy(zero_copy_only=False)
        return Skyline(np.where(np.isfinite(rows), rows, 0), visible)
    except (DatasetError, IndexError, TypeError, ValueError) as error:
        raise SkylineError(f"{photo}: its row of the table cannot be read: {error}") from error
