"""Lines that somebody else has found: another method's, another network's, another person's.

They come as files, one for each photo, in whatever a truth may be in: CSV, JSON, masks of either
polarity, painted photos; or for many photos as one document. The names decide which photo a file is
for, as they do for truths.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

from skyline_viz.datasets.coco import POLYGON
from skyline_viz.datasets.dataset import DatasetError, DatasetItem
from skyline_viz.datasets.item import Item
from skyline_viz.datasets.label_picture import label_size
from skyline_viz.datasets.line_documents import LineInCoco, documents_in, lines_in
from skyline_viz.datasets.matching import TRUTH_FOLDERS, bare_stem, common_name
from skyline_viz.datasets.tables.label_table import open_label_table
from skyline_viz.datasets.tables.parquet_files import SUFFIX, is_label_table
from skyline_viz.datasets.tables.table_item import TableItem
from skyline_viz.datasets.truths import SKYLINE_SUFFIXES, begins_like_a_skyline, read_truth
from skyline_viz.photo import PHOTO_SUFFIXES
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.names import listed

_DEEP = 4  # folders below folders
_OURS = (POLYGON, "skylines.csv", "run.json")  # what we write beside lines
_OVERLAY = "-overlay"  # what we add to the name of a photo with its line drawn on it


@dataclass(frozen=True)
class LineFile:
    """The file of one line, read when it is asked for."""

    path: Path

    sky: str | None = None
    """Which value of a mask is sky, where the mask does not tell; see `read_truth`."""

    terrain: str | None = None
    """Which value is terrain, instead of `sky`."""

    def read(self, size: tuple[int, int]) -> Skyline:
        """The line on a photo of a size ``(height, width)``.

        Raises:
            SkylineError: Damaged, no line, or of another size.
        """
        if self.path.suffix.lower() not in SKYLINE_SUFFIXES:
            height, width = label_size(self.path)
            if (height, width) != size:
                raise SkylineError(
                    f"{self.path} has {width}x{height} pixels, and the photo {size[1]}x{size[0]}."
                )
        try:
            return read_truth(self.path)
        except SkylineError:  # it leaves a choice, or is none
            if self.sky is None and self.terrain is None:
                raise
            return read_truth(self.path, sky=self.sky, terrain=self.terrain)


@dataclass(frozen=True)
class LineInTable:
    """The line of a photo in a Parquet table."""

    item: TableItem
    """The row."""

    def read(self, size: tuple[int, int]) -> Skyline:
        """The line on a photo of a size ``(height, width)``.

        Raises:
            SkylineError: Damaged, or of another size.
        """
        own, line = self.item.pixels or size, self.item.truth()
        assert line is not None  # what has none is left out
        if own != size:
            raise SkylineError(
                f"its line is for {own[1]}x{own[0]} pixels, and the photo has {size[1]}x{size[0]}."
            )
        return line


Line: TypeAlias = Skyline | LineFile | LineInCoco | LineInTable
"""A line, or where it is read from."""


@dataclass(frozen=True, eq=False)
class Predictions:
    """Lines by the names of their photos; `skyline_viz.evaluate` takes them as it takes a method.

    Examples:
        >>> Predictions("by hand", {"a": Skyline([4, 5, 6])})
        Predictions(by hand, 1 line)
    """

    name: str
    """What they are called in tables."""

    lines: Mapping[str, Line]
    """The line of each photo, or where it is read from."""

    extra: tuple[str, ...] = ()
    """Files that belong to no photo."""

    notes: tuple[str, ...] = ()
    """A sentence for each other reason why files are not used."""

    source: str = ""
    """Where they lie."""

    def __repr__(self) -> str:
        """One line, as a console shows it."""
        count = len(self.lines)
        return f"Predictions({self.name}, {count} {'line' if count == 1 else 'lines'})"

    def line(self, item: Item) -> Skyline:
        """The line of a photo that has one.

        Raises:
            SkylineError: It does not fit the photo, or its file is damaged.
        """
        line, size = self.lines[item.name], size_of(item)
        if not isinstance(line, Skyline):
            line = line.read(size)
        if line.width != size[1]:
            raise SkylineError(f"its line has {line.width} columns, and the photo {size[1]}")
        return line


def size_of(item: Item) -> tuple[int, int]:
    """Height and width of a photo, from its header where it is a file."""
    if isinstance(item, DatasetItem) and (size := item.size()) is not None:
        return size
    height, width = item.photo().shape[:2]
    return height, width


def open_predictions(
    source: str | os.PathLike[str],
    items: Iterable[Item],
    *,
    name: str = "",
    sky: str | None = None,
    terrain: str | None = None,
) -> Predictions:
    """Find the lines of photos in a folder and the folders in it, or in one file.

    A file is called as its photo is, with another ending, and with ``_mask`` or the like besides,
    as truths are; or as `skyline-viz detect` and `skyline-annotate export` call theirs. Of several
    files of a photo CSV counts first, then JSON, then pictures. A document may hold the lines of
    many photos: COCO, ``labels.json`` of an export, or a Parquet table, see `tables`. The table and
    the record of a run of `skyline-viz detect` into a folder are no lines, nor are its pictures
    ``NAME-overlay.jpg``.

    Args:
        source: The folder or file.
        items: Photos, such as ``sv.open_dataset(folder)``.
        name: What the lines are called in tables; the name of the folder unless given.
        sky: Which value is sky in masks that leave a choice, as `read_truth` takes it.
        terrain: Which value is terrain, instead of `sky`.

    Raises:
        DatasetError: It is missing, cannot be listed, or holds no line for any of the photos; or a
            table is damaged.
    """
    root, items = Path(source), list(items)
    if not root.exists():
        raise DatasetError(f"{root} does not exist.")
    found = _Matching(root, _Names(items), sky, terrain)
    files = [root] if is_label_table(root) else _files(root)
    texts, others, pictures = _sorted_out(files)
    for file in texts:
        found.add(file)
    found.add_documents(others)
    for file in filter(is_label_table, files):
        found.add_table(file)
    for file in pictures:
        found.add(file)
    if not found.lines:
        raise DatasetError(f"{root} holds no line for any of the {len(items)} photos{found.why()}.")
    notes = tuple(f"{text}: {listed(names)}." for text, names in found.notes.items())
    return Predictions(
        name or root.absolute().name, found.lines, tuple(found.extra), notes, f"{root}"
    )


@dataclass
class _Matching:
    """Collects the files of photos."""

    root: Path
    names: _Names
    sky: str | None
    terrain: str | None
    lines: dict[str, Line] = field(default_factory=dict)
    extra: list[str] = field(default_factory=list)
    notes: dict[str, list[str]] = field(default_factory=dict)

    def add(self, file: Path) -> None:
        """Take a file for the line of the photo that it is called after."""
        inside = file.relative_to(self.root) if file != self.root else Path(file.name)
        self._take(inside.as_posix(), [inside], LineFile(file, self.sky, self.terrain))

    def add_documents(self, files: Sequence[Path]) -> None:
        """Take the lines of many photos; what else is JSON or CSV is noted.

        Raises:
            DatasetError: A file cannot be read.
        """
        try:
            documents = documents_in(files)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise DatasetError(f"{error.filename} cannot be read: {reason}.") from error
        for file, document in documents:
            for names, line in lines_in(file, document, self, self.sky, self.terrain):
                self._take(f"{names[0]} in {file.name}", [*map(Path, names)], line)
        known = {file for file, _ in documents}
        for file in files:
            if file not in known and file.name not in _OURS:
                self.note("not used, because they hold no skyline", file.name)

    def add_table(self, file: Path) -> None:
        """Take the lines of a table.

        Raises:
            DatasetError: It is damaged.
        """
        for item in open_label_table(os.fspath(file)):
            if not isinstance(item, TableItem) or not item.has_truth:
                self.note(f"without a line in {file.name}", item.name)
                continue
            names = [Path(f"{one}{SUFFIX}") for one in (item.name, item.stored.stem)]
            self._take(f"{item.name} in {file.name}", names, LineInTable(item))

    def problem(self, sentence: str) -> None:
        """See `coco.Reports`."""
        self.note("not used", sentence.rstrip("."))

    def note(self, text: str, of: object = None) -> None:
        """See `coco.Reports`."""
        self.notes.setdefault(text, []).append(f"{of}")

    def _take(
        self,
        called: str,
        names: Sequence[Path],
        line: Line,
    ) -> None:
        photos = next(filter(None, map(self.names.meant_by, names)), set())
        if not photos:
            self.extra.append(called)
        elif len(photos) > 1:
            self.note("not used, because each could be for several photos", called)
        elif (photo := photos.pop()) in self.lines:
            self.note("not used, because another file of the same photo is", called)
        else:
            self.lines[photo] = line

    def why(self) -> str:
        """What there is instead, to end a sentence."""
        if self.extra:
            return f"; its files, such as {listed(self.extra, 3)}, are called otherwise"
        return "".join(f"; {text}: {listed(names, 3)}" for text, names in self.notes.items())


class _Names:
    """The ways in which files are called after photos, the surest first."""

    def __init__(self, items: Sequence[Item]) -> None:
        self._ranks: list[dict[str, set[str]]] = [{}, {}, {}]
        for item in items:
            name = item.name
            self._put(0, name, name, name.replace("/", "-"), name.replace("/", "__"))
            if isinstance(item, DatasetItem) and not item.label_map:
                self._put(0, name, item.photo_path.name)
                self._put(1, name, item.photo_path.stem, *_with_folders(item.photo_path))
            self._put(2, name, common_name(name.rpartition("/")[2]))

    def _put(self, rank: int, photo: str, *spelled: str) -> None:
        for one in spelled:
            self._ranks[rank].setdefault(one.casefold(), set()).add(photo)

    def meant_by(self, file: Path) -> set[str]:
        """The photos that a file could be for; its path is that below the folder of all files."""
        stem = file.stem
        whole = file.with_suffix("").as_posix()
        spelled = (whole, bare_stem(whole), stem, bare_stem(stem), common_name(stem))
        for ways in self._ranks:
            for one in spelled:
                if found := ways.get(one.casefold()):
                    return set(found)
        return set()


def _with_folders(photo: Path) -> Iterator[str]:
    """What an export calls a photo, whichever folder above it was labelled: ``images__a``."""
    folders = photo.parent.parts[-_DEEP:]
    for first in range(len(folders)):
        yield "__".join((*folders[first:], photo.stem))


def _files(root: Path) -> list[Path]:
    """The file itself, or those of a folder and the folders in it that are not hidden, by name.

    Raises:
        DatasetError: A folder cannot be listed.
    """
    if not root.is_dir():
        return [root]
    try:
        return sorted(_below(root, 0))
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise DatasetError(f"{root} cannot be listed: {reason}.") from error


def _below(folder: Path, depth: int) -> Iterator[Path]:
    for one in folder.iterdir():
        if one.name.startswith("."):
            continue
        if one.is_file():
            yield one
        elif one.is_dir() and depth < _DEEP:
            yield from _below(one, depth + 1)


def _sorted_out(files: Sequence[Path]) -> tuple[list[Path], list[Path], list[Path]]:
    """Skylines, in CSV first; other CSV and JSON; pictures, those of truths' folders if any."""
    texts = [file for file in files if file.suffix.lower() in SKYLINE_SUFFIXES]
    good = [file for file in texts if begins_like_a_skyline(file)]
    pictures = [
        file
        for file in files
        if file.suffix.lower() in PHOTO_SUFFIXES and not file.stem.endswith(_OVERLAY)
    ]
    inside = [file for file in pictures if file.parent.name.lower() in TRUTH_FOLDERS]
    others = [file for file in texts if file not in good]
    return sorted(good, key=lambda file: file.suffix.lower()), others, inside or pictures
