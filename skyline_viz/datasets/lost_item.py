"""Photos, truths and lines that a storage did not give: they fail when their turn comes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path

from skyline_viz.arrays import U8
from skyline_viz.datasets.dataset import Dataset, DatasetItem
from skyline_viz.datasets.predictions import LineFile, Predictions
from skyline_viz.photo import PHOTO_SUFFIXES, PhotoError
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.copies import lost_in

_TELLING = (".csv", ".json", ".jsonl", ".parquet", ".xml")  # what may hold truths of many photos


@dataclass(frozen=True)
class LostItem(DatasetItem):
    """A photo that is not there, or whose truth is not."""

    lost: tuple[tuple[Path, str], ...] = ()
    """Files that are lost, and why, in a sentence."""

    def size(self) -> tuple[int, int] | None:
        """Height and width of the photo.

        Raises:
            PhotoError: It is lost, or cannot be read.
        """
        self._require_photo()
        return super().size()

    def photo(self) -> U8:
        """Read the photo.

        Raises:
            PhotoError: It is lost, or cannot be read.
        """
        self._require_photo()
        return super().photo()

    def _require_photo(self) -> None:
        if reason := dict(self.lost).get(self.photo_path):
            raise PhotoError(reason)

    def truth(self) -> Skyline | None:
        """Read the truth.

        Raises:
            SkylineError: It is lost, damaged, or is no truth.
        """
        if self.truth_path and (reason := dict(self.lost).get(self.truth_path)):
            raise SkylineError(reason)
        return super().truth()


def with_lost(datasets: Iterable[Dataset], folder: str | Path) -> list[Dataset]:
    """Data sets of a folder, in which files that could not be copied are said to be lost.

    What belongs to a photo fails with it. Of the rest the first data set has a sentence in its
    `problems`.

    Args:
        datasets: All data sets of the folder.
        folder: The folder, a copy or any other.

    Raises:
        StorageError: A text is lost that may have told the truths of many photos.
    """
    folder = Path(folder)
    lost = lost_in(folder)
    if not lost:
        return [*datasets]
    claimed: set[Path] = set()
    found = []
    for dataset in datasets:
        items = [_marked(one, lost) for one in dataset]
        claimed |= {path for one in items if isinstance(one, LostItem) for path, _ in one.lost}
        found.append(replace(dataset, items=tuple(items)))
    others = {path: reason for path, reason in lost.items() if path not in claimed}
    _refuse_telling(others)
    pictures = {f"{path.relative_to(folder)}" for path in others if _is_picture(path)}
    told = [one for one in found[0].problems if one.removesuffix(" has no photo.") not in pictures]
    return [replace(found[0], problems=(*told, *others.values())), *found[1:]]


@dataclass(frozen=True)
class LostLine(LineFile):
    """The file of a line that is not there."""

    reason: str = ""
    """Why, in a sentence."""

    def read(self, size: tuple[int, int]) -> Skyline:  # noqa: ARG002 - of whatever size
        """Refuse.

        Raises:
            SkylineError: Always.
        """
        raise SkylineError(self.reason)


def lines_with_lost(lines: Predictions, folder: Path) -> Predictions:
    """Lines of a folder, in which files that could not be copied are said to be lost.

    Args:
        lines: What was found there.
        folder: The folder, a copy or any other.

    Raises:
        StorageError: A text is lost that may have held the lines of many photos.
    """
    lost = lost_in(folder)
    if not lost:
        return lines
    found = dict(lines.lines)
    for photo, line in lines.lines.items():
        if isinstance(line, LineFile) and line.path in lost:
            found[photo] = LostLine(line.path, reason=lost.pop(line.path))
    _refuse_telling(lost)
    return replace(lines, lines=found, notes=(*lines.notes, *lost.values()))


def _refuse_telling(lost: Mapping[Path, str]) -> None:
    for path, reason in lost.items():
        if path.suffix.lower() in _TELLING:
            raise StorageError(reason)


def _marked(item: DatasetItem, lost: Mapping[Path, str]) -> DatasetItem:
    paths = (path for path in (item.photo_path, item.truth_path) if path is not None)
    own = tuple((path, lost[path]) for path in paths if path in lost)
    if not own:
        return item
    values = {one.name: getattr(item, one.name) for one in fields(item)}
    return LostItem(**values, lost=own)


def _is_picture(path: Path) -> bool:
    return path.suffix.lower() in PHOTO_SUFFIXES
