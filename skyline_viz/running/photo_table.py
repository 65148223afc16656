"""What a run found in each photo of a folder, as a table: how sure it is, or why it failed."""

from __future__ import annotations

import csv
import hashlib
import io
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from skyline_viz.files import write_text

TABLE = "skylines.csv"
"""Name of the table in the folder of outputs."""

HEADER = (
    "name", "file", "sha256", "width", "height", "confidence", "case", "least_sure", "seconds",
    "error",
)  # fmt: skip
"""Columns of the table."""

FIRST_SHARE, MOST_FIRST = 0.2, 5
"""Share of the photos to look at first, and how many these are at the most."""


@dataclass(frozen=True)
class PhotoRow:
    """A photo of a run. What is not known of one that failed is empty."""

    name: str
    """Name of its outputs."""

    file: Path | str
    """The photo's path or address."""

    sha256: str = ""
    """Digest of the content of its file, in hexadecimal digits."""

    size: tuple[int, int] | None = None
    """Height and width, in pixels."""

    confidence: float | None = None
    """Probability that the line is no gross miss, in [0, 1]."""

    case: str = ""
    """What the photo shows, see `visibility.Case`; empty where the method cannot tell."""

    least_sure: tuple[tuple[int, int], ...] = ()
    """First and last column of the stretches where the line is least sure."""

    seconds: float | None = None
    """Seconds of the detection."""

    error: str = ""
    """Why it failed, in a sentence; empty where it did not."""

    @property
    def stretches(self) -> str:
        """The least sure columns in words: ``40 to 52; 7``."""
        return "; ".join(
            str(first) if first == last else f"{first} to {last}" for first, last in self.least_sure
        )

    def cells(self) -> list[str]:
        """Its line of the table."""
        height, width = self.size or ("", "")
        sure = "" if self.confidence is None else f"{self.confidence:.4f}"
        seconds = "" if self.seconds is None else f"{self.seconds:.4f}"
        about = [self.name, str(self.file), self.sha256, str(width), str(height)]
        return [*about, sure, self.case, self.stretches, seconds, self.error]

    def kept(self) -> dict[str, Any]:
        """All of it in numbers, strings and lists, see `row_from`."""
        return {**asdict(self), "file": str(self.file)}


def row_from(kept: Mapping[str, Any]) -> PhotoRow:
    """A row as it was, of what `PhotoRow.kept` gave.

    Raises:
        LookupError: It is of another shape, or so are the errors below.
        TypeError: As that.
        ValueError: As that.
    """
    height, width = kept["size"]
    least_sure = tuple((int(first), int(last)) for first, last in kept["least_sure"])
    return PhotoRow(**{**kept, "size": (int(height), int(width)), "least_sure": least_sure})


def write_table(path: Path, rows: Sequence[PhotoRow]) -> None:
    """Write the table as CSV, a line a photo, whole or not at all."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADER)
    writer.writerows(row.cells() for row in rows)
    write_text(path, text.getvalue())


def is_table(path: Path) -> bool:
    """Whether a file is such a table, and not the skyline of a photo that is called so."""
    if path.name != TABLE:
        return False
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            return file.readline(200).rstrip() == ",".join(HEADER)
    except OSError:
        return False


def look_first(rows: Sequence[PhotoRow]) -> list[PhotoRow]:
    """The photos to look at first: the least sure fifth, one at least and five at the most.

    Examples:
        >>> rows = [PhotoRow(name, Path(name), confidence=sure) for name, sure in [("a", 0.9),
        ... ("b", 0.4), ("c", 0.7)]]
        >>> [row.name for row in look_first(rows)]
        ['b']
    """
    known = [row for row in rows if row.confidence is not None]
    number = min(max(round(FIRST_SHARE * len(known)), 1), MOST_FIRST)
    return sorted(known, key=lambda row: row.confidence or 0.0)[:number]


def sure(confidence: float) -> str:
    """A confidence in words; nobody is quite sure.

    >>> sure(0.276), sure(0.999)
    ('28 % sure', '99 % sure')
    """
    return f"{min(round(100 * confidence), 99)} % sure"


def digest_of_content(path: Path) -> str:
    """SHA-256 of a file in hexadecimal digits; empty where it cannot be read, or is no file."""
    try:
        if not path.is_file():
            return ""
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return ""
