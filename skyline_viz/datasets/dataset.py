"""A data set: its photos and their truths, however they were found."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from skyline_viz.arrays import U8
from skyline_viz.datasets.truths import truth_with_notes
from skyline_viz.photo import photo_size, read_photo_with_notes
from skyline_viz.skyline import Skyline
from skyline_viz.system.notes import note

Layout = Literal["Basalt", "Web", "CH1", "GeoPose3K", "plain", "table"]
"""The published layouts, the folder of photographs that follows none of them, and a table."""


class DatasetError(ValueError):
    """A folder is not a data set; the message is one sentence naming the folder and the reason."""


@dataclass(frozen=True)
class DatasetItem:
    """One photo of a data set and its truth, both read only when asked for."""

    name: str
    """Unique in the data set: the file's stem, for CH1 ``part/stem``, for GeoPose3K the folder."""

    photo_path: Path
    """The photo's file."""

    truth_path: Path | None = None
    """The truth's file: painted photo, mask, label map, CSV or JSON. None where there is none."""

    label_map: bool = False
    """Whether the truth is a GeoPose3K label map, in which black is sky."""

    sky: str | None = None
    """Which value of a mask is sky, as `read_truth` takes it; told by the mask unless given."""

    terrain: str | None = None
    """Which value of a mask is terrain, instead of `sky`."""

    @property
    def where(self) -> str:
        """Path or address of the photo."""
        return str(self.photo_path)

    @property
    def has_truth(self) -> bool:
        """Whether there is a truth, sound or damaged."""
        return self.truth_path is not None

    def size(self) -> tuple[int, int] | None:
        """Height and width of the photo, by its header; None where only its pixels would tell.

        Raises:
            PhotoError: It cannot be read.
        """
        return photo_size(self.photo_path)

    def contents(self) -> Iterator[bytes]:
        """SHA-256 of the photo, and of what its truth is read from where there is one.

        Raises:
            OSError: A file cannot be read.
        """
        for path in (self.photo_path, self.truth_path):
            if path is not None:
                with path.open("rb") as file:
                    yield hashlib.file_digest(file, "sha256").digest()

    def without_truth(self) -> DatasetItem:
        """The photo alone."""
        return replace(self, truth_path=None)

    def photo(self) -> U8:
        """Read the photo, ``(H, W, 3)`` uint8 RGB; what there is to know about it is noted.

        Raises:
            PhotoError: It cannot be read.
        """
        photo, notes = read_photo_with_notes(self.photo_path)
        for one in notes:
            note(one)
        return photo

    def truth(self) -> Skyline | None:
        """Read the truth; None where there is none. What was left out of it is noted.

        Raises:
            SkylineError: The file is damaged, or is no truth; the message names it.
        """
        if self.truth_path is None:
            return None
        path, sky, terrain = self.truth_path, self.sky, self.terrain
        line = truth_with_notes(path, self.label_map, sky=sky, terrain=terrain)
        if line.notes:
            note(f"{path}: {'; '.join(line.notes)}.")
        return line.skyline


@dataclass(frozen=True)
class Dataset:
    """The photos of a folder, sorted by name: iterate over it, or ask for its length."""

    name: str
    """The name of the folder."""

    layout: Layout
    """How photos and truths were matched."""

    items: tuple[DatasetItem, ...]
    """The photos with their truths, by name."""

    problems: tuple[str, ...] = ()
    """One sentence for each truth that was left out, naming it and the reason."""

    left_out: tuple[str, ...] = ()
    """What else lies there: a sentence about pictures that cannot be read, grouped by the reason,
    one about those that our programs have written, and one about photos beside a data set."""

    def __iter__(self) -> Iterator[DatasetItem]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)
