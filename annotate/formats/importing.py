"""What an import came to: labels, what was wrong, and what is worth knowing."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from annotate.formats.common import Imported, check_size
from annotate.formats.drawings import Wanted
from annotate.formats.photo_names import PhotoNames
from annotate.formats.rivals import refuse_rivals, seen_rows
from annotate.store.contents import Contents
from skyline_viz.command_line.messages import counted
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.photo import PhotoError
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.names import listed


@dataclass(frozen=True)
class Imports:
    """Labels that were read: iterate over them, ask for their number, or for one by its place."""

    found: tuple[Imported, ...]
    """The labels, one a photo, except where the format carries several passes."""

    problems: tuple[str, ...] = ()
    """A sentence for each label or file that could not be read, though it should be."""

    notes: tuple[str, ...] = ()
    """Sentences on what was left out because it belongs to no photo, or decided in passing."""

    def __iter__(self) -> Iterator[Imported]:
        return iter(self.found)

    def __len__(self) -> int:
        return len(self.found)

    def __getitem__(self, place: int) -> Imported:
        return self.found[place]


@dataclass
class Found:
    """Collects what an import comes to."""

    labels: list[Imported] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    _notes: dict[str, list[str]] = field(default_factory=dict)

    def problem(self, sentence: str) -> None:
        """Keep a sentence, once."""
        if sentence not in self.problems:
            self.problems.append(sentence)

    def note(self, text: str, of: Any = None) -> None:  # noqa: ANN401
        """Keep a note without its full stop; the names of what it is about are put together."""
        names = self._notes.setdefault(text, [])
        if of is not None and str(of) not in names:
            names.append(str(of)[:200])

    @property
    def notes(self) -> list[str]:
        """A sentence a note."""
        return [
            f"{text}: {listed(names)}." if names else f"{text}."
            for text, names in self._notes.items()
        ]

    def outcome(self) -> Imports:
        """All of it."""
        return Imports(tuple(self.labels), tuple(self.problems), tuple(self.notes))


@dataclass(frozen=True)
class Task:
    """What is to be imported."""

    source: Path
    """The file or folder."""

    files: tuple[Path, ...]
    """The files of it."""

    photos: Path
    """Folder of the photos."""

    given: tuple[str, ...]
    """Names of the photos that labels may be for."""

    names: PhotoNames
    """The same, to be looked up."""

    found: Found
    """Gets labels, problems and notes."""

    contents: Contents | None = None
    """What is in the files of the photos, where that is known."""

    wanted: Wanted = field(default_factory=Wanted)
    """Which labels of drawn shapes count."""

    sky: str | None = None
    terrain: str | None = None
    """Which value is sky, or terrain, in masks."""

    def read_each(self, files: Iterable[Path], read: Callable[[Path, str], Skyline]) -> None:
        """Read the file of each photo, where files are called as photos are.

        Args:
            files: The files; of two for a photo the first counts, if they agree.
            read: Reads one, given the name of its photo.
        """
        of_stem: dict[str, list[Path]] = {}
        for file in files:
            of_stem.setdefault(file.stem, []).append(file)
        matched = self.names.of_stems(of_stem)
        for sentence in matched.unclear:
            self.found.problem(sentence)
        for stem, photo in matched.photos.items():
            lines: dict[Path, Skyline] = {}
            for file in of_stem[stem]:
                try:
                    lines[file] = check_size(photo, read(file, photo), self.photos)
                except (FormatError, PhotoError, SkylineError) as error:
                    self.found.problem(str(error))
            try:
                refuse_rivals(map(seen_rows, lines.values()), "files", f"{photo} has")
            except FormatError as error:
                self.found.problem(f"{error}.")
                continue
            self.found.labels += [Imported(photo, line) for line in [*lines.values()][:1]]
            for file in [*lines][1:]:
                told = "not used, because another file for the same photo is"
                self.found.note(told, file.name)
        if lost := [file.name for stem in matched.unknown for file in of_stem[stem]]:
            told = counted(len(lost), "file")
            belongs = "belongs" if len(lost) == 1 else "belong"
            self.found.note(f"{told} {belongs} to no photo of the folder: {listed(lost)}")


Reader: TypeAlias = Callable[[Task], None]
"""Reads the files of a format."""
