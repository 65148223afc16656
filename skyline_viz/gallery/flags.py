"""What people said about the photos of a gallery: which are reviewed, and comments.

They lie in ``flags.json``, which outlives the recordings. Commands and pages change it at the same
time; each change is about single photos, and waits until the one before it is on the disk.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from filelock import FileLock, Timeout

from skyline_viz.gallery.documents import GalleryError, made, read_list, write_list
from skyline_viz.system.nearest import nearest

FILE = "flags.json"
"""The file's name in the folder of the gallery."""

LONGEST = 2_000
"""Characters that a comment has at most."""

_VERSION = 1
_LOCK = ".flags.lock"
_PATIENCE = 10.0  # seconds that a change waits for others


@dataclass(frozen=True)
class Flag:
    """What people said about a photo."""

    reviewed: bool = False
    """Whether somebody has looked at it."""

    comment: str = ""
    """Their comment."""


@dataclass(frozen=True)
class Change:
    """What is to become of a photo's flag; what is None stays."""

    reviewed: bool | None = None
    """Whether it is reviewed."""

    comment: str | None = None
    """The comment."""

    instead_of: str | None = None
    """The comment that is replaced: where it is another one by now, nothing is changed. None
    replaces any."""


class OvertakenError(GalleryError):
    """Somebody else has changed the comment meanwhile."""

    def __init__(self, name: str, flag: Flag) -> None:
        """Say so.

        Args:
            name: Name of the photo.
            flag: What is said about it now.
        """
        super().__init__(f"the comment on {name} was changed elsewhere meanwhile.")
        self.flag = flag


def read_flags(folder: Path) -> dict[str, Flag]:
    """What people said, by name of photo, also of photos that are no longer in the data set.

    Args:
        folder: Of the gallery.

    Raises:
        GalleryError: The file is damaged.
    """
    path = folder / FILE
    flags = {}
    for one in read_list(path, "flags", _VERSION):
        name = one.pop("name", "")
        flag: Flag = made(Flag, path, one)
        if not (isinstance(name, str) and isinstance(flag.comment, str)):
            raise GalleryError(f"{path} is damaged: names and comments are texts.")
        flags[name] = Flag(bool(flag.reviewed), flag.comment)
    return flags


def change_flags(folder: Path, changes: Mapping[str, Change]) -> dict[str, Flag]:
    """Change what is said about photos: all of it or nothing; it is on the disk then.

    Args:
        folder: Of the gallery.
        changes: By name of photo.

    Returns:
        What is said about all photos now. Photos about which nothing is said any more are left out.

    Raises:
        OvertakenError: Another comment is there than the one to be replaced.
        GalleryError: The file is damaged, a comment is too long, or others keep changing it.
        OSError: It cannot be written.
    """
    with _alone(folder):
        flags = read_flags(folder)
        for name, change in changes.items():
            before = flags.get(name, Flag())
            if change.instead_of not in (None, before.comment) and change.comment != before.comment:
                raise OvertakenError(name, before)
            if len(change.comment or "") > LONGEST:
                raise GalleryError(f"a comment has at most {LONGEST} characters.")
            flags[name] = Flag(
                before.reviewed if change.reviewed is None else change.reviewed,
                before.comment if change.comment is None else change.comment,
            )
        said = {name: flag for name, flag in sorted(flags.items()) if flag != Flag()}
        if said != read_flags(folder):
            rows = [{"name": name, **asdict(flag)} for name, flag in said.items()]
            write_list(folder / FILE, "flags", rows, _VERSION)
    return said


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Keep other threads and programs from changing flags meanwhile."""
    lock = FileLock(folder / _LOCK, timeout=_PATIENCE)
    try:
        lock.acquire()
    except Timeout:
        raise GalleryError(
            f"another program keeps changing {folder / FILE}; try again when it is done."
        ) from None
    try:
        yield
    finally:
        lock.release()


def find_names(words: Sequence[str], files: Mapping[str, str]) -> list[str]:
    """Names of photos that somebody means, each once.

    Args:
        words: Names of photos, their files, or names of their files.
        files: File of each photo, by its name.

    Raises:
        GalleryError: There is no such photo, or several that one word could mean.

    >>> find_names(["b.jpg", "a"], {"a": "alps/a.jpg", "b": "alps/b.jpg"})
    ['b', 'a']
    """
    found: dict[str, None] = {}
    for word in words:
        meant = [word] if word in files else _named_by_file(word, files)
        if not meant:
            near = nearest(word, files)
            better = f"; did you mean {near}?" if near else "."
            raise GalleryError(f"no photo of the gallery is called {word}{better}")
        if len(meant) > 1:
            raise GalleryError(f"{word} could be {' or '.join(meant)}; name one of them.")
        found[meant[0]] = None
    return list(found)


def _named_by_file(word: str, files: Mapping[str, str]) -> list[str]:
    place = Path(word).resolve()
    if exact := [name for name, file in files.items() if file and Path(file).resolve() == place]:
        return exact
    if Path(word).name != word:  # somewhere else
        return []
    return [name for name, file in files.items() if file and Path(file).name == word]
