"""The skyline: one row a column, and the forms in which data sets store it."""

import csv
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import (
    F32,
    U8,
    Bool,
    check_photo,
    column_counts,
    column_ends,
    in_colour,
    in_colours,
    read_only,
)
from skyline_viz.files import write_text

Paint = Literal["red", "blue"]
"""Colour of a painted skyline: pure ``(255, 0, 0)`` or pure ``(0, 0, 255)``."""

PAINTS: dict[Paint, tuple[int, int, int]] = {"red": (255, 0, 0), "blue": (0, 0, 255)}
"""Red, green and blue of each paint."""

_CSV_HEADER = ["column", "row", "visible"]
_MARGIN = "margin"
WHY = "why"
"""Header of what hides a column, where a CSV file says it as a fourth value."""
CSV_HEADERS = (_CSV_HEADER, [*_CSV_HEADER, _MARGIN], [*_CSV_HEADER, WHY])
"""Headers of the CSV files that hold a skyline."""


class SkylineError(ValueError):
    """A skyline, or a file that should hold one, is not valid; the message says why."""


@dataclass(frozen=True, eq=False)
class Skyline:
    """For each column the row of the first terrain pixel; the rows above it are sky.

    Examples:
        >>> skyline = Skyline(rows=[2, 3, 3])
        >>> skyline.to_mask(height=5).astype(int)[:, 0]
        array([1, 1, 0, 0, 0])
        >>> Skyline.from_mask(skyline.to_mask(height=5)) == skyline
        True
    """

    rows: F32
    """``(W,)`` row of the first terrain pixel of each column, in pixels from the top; finite."""

    visible: Bool = None  # type: ignore[assignment]
    """``(W,)`` False where the line cannot be seen or is not labelled; all True unless given."""

    def __repr__(self) -> str:
        """One line, as a console shows it."""
        rows = f"rows {self.rows.min():g} to {self.rows.max():g}" if self.width else "no rows"
        hidden = self.width - int(np.count_nonzero(self.visible))
        return f"Skyline({self.width} columns, {rows}{f', {hidden} not visible' if hidden else ''})"

    def __post_init__(self) -> None:
        """Convert, check and freeze the arrays."""
        try:
            with np.errstate(over="ignore"):  # what is too large becomes infinite: see below
                rows = np.array(self.rows, dtype=np.float32)
            visible = np.ones(rows.shape, bool) if self.visible is None else np.array(self.visible)
        except (TypeError, ValueError, OverflowError) as error:
            raise SkylineError(
                f"the rows of a skyline are numbers, one a column: {error}"
            ) from None
        if rows.ndim != 1 or len(rows) == 0:
            raise SkylineError(f"the rows of a skyline have the shape (W,), not {rows.shape}")
        if not np.isfinite(rows).all():
            column = int(np.flatnonzero(~np.isfinite(rows))[0])
            raise SkylineError(f"the row of column {column} is {rows[column]}, not a finite number")
        if visible.dtype != np.bool_:
            raise SkylineError(f"visible is a bool array, not {visible.dtype}")
        if visible.shape != rows.shape:
            raise SkylineError(f"{len(rows)} rows, but visible has the shape {visible.shape}")
        read_only(rows)
        read_only(visible)
        object.__setattr__(self, "rows", rows)
        object.__setattr__(self, "visible", visible)

    def __eq__(self, other: object) -> bool:
        """Equal rows and equal visibility in every column."""
        if not isinstance(other, Skyline):
            return NotImplemented
        return np.array_equal(self.rows, other.rows) and np.array_equal(self.visible, other.visible)

    __hash__ = None  # type: ignore[assignment]

    @property
    def width(self) -> int:
        """Number of columns."""
        return len(self.rows)

    def pixel_rows(self, height: int) -> npt.NDArray[np.intp]:
        """Rows rounded to whole pixels, ``(W,)``, each in ``[0, height]``; `height` means all sky.

        Those of invisible columns are guesses, and are moved to the nearest row inside.

        Raises:
            SkylineError: The row of a visible column lies outside the image.

        Examples:
            >>> Skyline(rows=[2.4, 2.5]).pixel_rows(height=5)
            array([2, 3])
        """
        rows = np.floor(self.rows.astype(np.float64) + 0.5)
        outside = np.flatnonzero(self.visible & ((rows < 0) | (rows > height)))
        if len(outside):
            column = int(outside[0])
            raise SkylineError(
                f"row {self.rows[column]:g} of column {column} lies outside a height of {height}"
            )
        return rows.clip(0, height).astype(np.intp)

    def to_mask(self, height: int) -> Bool:
        """Sky mask ``(height, W)``, True = sky; it does not say which columns are visible.

        Raises:
            SkylineError: The row of a visible column lies outside the image.
        """
        return np.arange(height)[:, None] < self.pixel_rows(height)[None, :]

    @classmethod
    def from_mask(cls, sky_mask: npt.NDArray[np.bool_]) -> "Skyline":
        """Skyline of a sky mask ``(H, W)``, True = sky: the first terrain row of each column.

        Sky below terrain (a hole, an overhang) does not count; a column that is all sky gets the
        row ``H``.
        """
        mask = np.asarray(sky_mask)
        if mask.ndim != 2 or mask.dtype != np.bool_ or mask.size == 0:
            raise SkylineError(f"a sky mask is a bool array (H, W), not {mask.dtype} {mask.shape}")
        if (mask[1:] > mask[:-1]).any():  # sky below terrain: the first terrain must be looked for
            rows = np.where(mask.all(axis=0), mask.shape[0], np.argmin(mask, axis=0))
        else:
            rows = column_counts(mask)
        return cls(rows=rows.astype(np.float32))

    def to_painted(self, photo: U8, paint: Paint = "red") -> U8:
        """Copy of `photo` with the first terrain pixel of each visible column painted.

        Pixels of the photo that happen to have a paint's exact colour are changed by one level,
        so that `from_painted` gives back this very line.

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.
            paint: The colour of the line.

        Raises:
            SkylineError: The width differs, or a visible row lies outside the photo.

        Examples:
            >>> photo = np.zeros((4, 3, 3), np.uint8)
            >>> line = Skyline(rows=[1, 2, 2])
            >>> Skyline.from_painted(line.to_painted(photo)) == line
            True
        """
        check_photo(photo)
        if paint not in PAINTS:
            raise SkylineError(f"a skyline is painted in red or blue, not in {paint}")
        height, width = photo.shape[:2]
        if width != self.width:
            raise SkylineError(f"the photo is {width} columns wide, the skyline {self.width}")
        rows = self.pixel_rows(height)
        columns = np.flatnonzero(self.visible)
        below = columns[rows[columns] == height]
        if len(below):
            raise SkylineError(f"column {below[0]} is all sky, so there is no pixel to paint")
        painted = photo.copy()
        for colour in PAINTS.values():
            painted[in_colour(photo, colour)] = [max(level, 1) - 1 for level in colour]
        painted[rows[columns], columns] = PAINTS[paint]
        return painted

    @classmethod
    def from_painted(cls, painted: U8, paint: Paint | None = None) -> "Skyline":
        """Skyline painted on a photo, pure red or pure blue, as the authors' data sets have it.

        The topmost painted pixel of a column counts. A column without one is not visible and gets
        a row interpolated from its neighbours.

        Args:
            painted: ``(H, W, 3)`` uint8 RGB.
            paint: The colour; without it, the one that is found in more columns.

        Raises:
            SkylineError: No pixel has the colour.
        """
        check_photo(painted)
        colours = PAINTS.values() if paint is None else [PAINTS[paint]]
        found = in_colours(painted, colours)
        return cls.along_top(max(found, key=lambda pixels: int(pixels.any(axis=0).sum())))

    @classmethod
    def along_top(cls, painted: Bool) -> "Skyline":
        """Skyline along the topmost painted pixels of a mask ``(H, W)``, see `from_painted`.

        Raises:
            SkylineError: No pixel is painted.
        """
        visible = column_counts(painted) > 0
        if not visible.any():
            raise SkylineError("no pixel is painted in pure red or pure blue")
        return cls(rows=fill(column_ends(painted)[0], visible), visible=visible)

    def write_csv(
        self, path: str | os.PathLike[str], margins: npt.NDArray[np.floating] | None = None
    ) -> None:
        """Write ``column,row,visible``, a line a column; `visible` is 1 or 0.

        Args:
            path: Where to.
            margins: ``(W,)`` how sure each column is, as a fourth value ``margin``; ``inf`` where
                no other line is possible.

        Raises:
            SkylineError: There is another number of margins.
        """
        columns = map(str, range(self.width))
        visible = map("01".__getitem__, self.visible.tolist())
        header, parts = [*_CSV_HEADER], [columns, _in_digits(self.rows), visible]
        if margins is not None:
            header.append(_MARGIN)
            parts.append(f"{margin:.6g}" for margin in self._checked(margins))
        lines = map(",".join, zip(*parts, strict=True))
        write_text(path, "\n".join([",".join(header), *lines, ""]))

    def _checked(self, margins: npt.NDArray[np.floating]) -> list[float]:
        """Margins as numbers of Python, one a column."""
        if np.shape(margins) != (self.width,):
            raise SkylineError(f"{self.width} rows, but margins of the shape {np.shape(margins)}")
        told: list[float] = np.asarray(margins, np.float64).tolist()
        return told

    @classmethod
    def read_csv(cls, path: str | os.PathLike[str]) -> "Skyline":
        """Read what `write_csv` wrote, with or without a fourth value, which is passed over.

        Raises:
            SkylineError: Another header, a missing column, or a value that is no number.
        """
        with _naming(path), Path(path).open(newline="", encoding="utf-8-sig") as file:
            lines = [line for line in csv.reader(file) if line]
            if not lines or lines[0] not in CSV_HEADERS:
                raise SkylineError("the first line is not column,row,visible")
            header, *lines = lines
            for number, line in enumerate(lines):
                well = len(line) == len(header) and line[0] == str(number)
                if not well or line[2] not in ("0", "1"):
                    raise SkylineError(f"the line of column {number} is {','.join(line)!r}")
            return cls(
                rows=[float(line[1]) for line in lines],  # type: ignore[arg-type]
                visible=np.array([line[2] == "1" for line in lines], bool),
            )

    def write_json(
        self, path: str | os.PathLike[str], margins: npt.NDArray[np.floating] | None = None
    ) -> None:
        """Write ``{"format": "skyline", "version": 1, "rows": [...], "visible": [...]}``.

        Args:
            path: Where to.
            margins: ``(W,)`` how sure each column is, as a list ``margins``; null where no other
                line is possible.

        Raises:
            SkylineError: There is another number of margins.
        """
        document: dict[str, object] = {
            "format": "skyline",
            "version": 1,
            "rows": self.rows.tolist(),
            "visible": self.visible.tolist(),
        }
        if margins is not None:
            told = self._checked(margins)
            document["margins"] = [float(f"{one:.6g}") if isfinite(one) else None for one in told]
        write_text(path, json.dumps(document) + "\n")

    @classmethod
    def read_json(cls, path: str | os.PathLike[str]) -> "Skyline":
        """Read what `write_json` wrote.

        Raises:
            SkylineError: Not JSON, another format or version, or not a valid skyline.
        """
        with _naming(path):
            document = json.loads(Path(path).read_text(encoding="utf-8-sig"))
            if not isinstance(document, dict) or document.get("format") != "skyline":
                raise SkylineError('there is no "format": "skyline" in it')
            if document.get("version") != 1:
                raise SkylineError(f"it has version {document.get('version')!r}, and 1 is known")
            rows, visible = document.get("rows"), document.get("visible")
            if not isinstance(rows, list) or not all(type(row) in (int, float) for row in rows):
                raise SkylineError('"rows" is not a list of numbers')
            if not isinstance(visible, list) or not all(type(one) is bool for one in visible):
                raise SkylineError('"visible" is not a list of true and false')
            return cls(rows=rows, visible=np.array(visible, bool))  # type: ignore[arg-type]


def _in_digits(rows: F32) -> list[str]:
    """The shortest decimals that give back each row, without an exponent."""
    plain = (rows == np.rint(rows)) & (np.abs(rows) < 1 << 24)  # as all are that a path has
    plain &= (rows != 0) | ~np.signbit(rows)
    digits = [*map(str, np.where(plain, rows, 0).astype(np.int32).tolist())]
    for place in np.flatnonzero(~plain).tolist():
        digits[place] = np.format_float_positional(rows[place], trim="-")
    return digits


@contextmanager
def _naming(path: str | os.PathLike[str]) -> Iterator[None]:
    """Put the name of the file before whatever is wrong with its content."""
    try:
        yield
    except (ValueError, RecursionError, csv.Error) as error:  # a SkylineError is a ValueError
        raise SkylineError(f"{path} does not hold a skyline: {error}.") from error


def fill(rows: npt.NDArray[np.floating] | npt.NDArray[np.integer], visible: Bool) -> F32:
    """Rows ``(W,)`` with those of invisible columns interpolated from the visible ones.

    Left of the first and right of the last visible column its row is repeated.

    Raises:
        SkylineError: No column is visible.

    Examples:
        >>> fill(np.array([0, 4, 0, 6]), np.array([False, True, False, True]))
        array([4., 4., 5., 6.], dtype=float32)
    """
    if not visible.any():
        raise SkylineError("no column is visible, so there is nothing to interpolate from")
    columns = np.arange(len(rows))
    filled: F32 = np.interp(columns, columns[visible], rows[visible]).astype(np.float32)
    return filled
