"""The photo files of a folder; what looks like one and is not; and what is no file at all."""

import os
import stat
from pathlib import Path

from skyline_viz.picture_files.kinds import PHOTO_SUFFIXES, why_unread


def find_photos(folder: str | os.PathLike[str]) -> list[Path]:
    """List the photographs directly inside `folder`, by name.

    Goes by file name endings; hidden files are left out.

    Raises:
        OSError: `folder` is missing, is a file, or may not be listed.
    """
    return sorted(
        file
        for file in Path(folder).iterdir()
        if file.suffix.lower() in PHOTO_SUFFIXES
        and not file.name.startswith(".")
        and file.is_file()
    )


def find_unread(folder: str | os.PathLike[str]) -> list[Path]:
    """List the pictures directly inside `folder` that `find_photos` does not take, by name.

    Raises:
        OSError: As `find_photos`.
    """
    return sorted(
        file
        for file in Path(folder).iterdir()
        if not file.name.startswith(".") and not file.is_dir() and why_unread(file) is not None
    )


def checked_file(path: Path) -> str | None:
    """What is wrong with a file before it is opened, to go on after its name; None if nothing.

    Raises:
        OSError: It is missing, or its folder may not be entered.
    """
    status = path.stat()
    if stat.S_ISDIR(status.st_mode):
        return "is a folder, not a photo"
    if not stat.S_ISREG(status.st_mode):  # opening a pipe would wait for its other end
        return "is a pipe or a device, not a photo"
    return "is empty (0 bytes)" if status.st_size == 0 else None
