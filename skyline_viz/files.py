"""Writing files so that they appear whole or not at all, and are on the disk when that is said."""

import errno
import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from skyline_viz.system.aftermath import passing

FULL = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EFBIG})
"""Errors of the disk, not of a photo: no later photo could be written either. The last is that of a
limit that was set for a process."""

_UNABLE = {errno.EINVAL, errno.ENOTSUP, errno.EBADF, errno.EACCES, errno.EPERM}


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a temporary path beside `path`; on success move it there in one step.

    The temporary file is hidden and keeps the suffix of `path`, so that encoders that go by it
    work. When the block raises, the temporary file is removed and whatever stood at `path` is
    untouched. Missing folders above `path` are made. When it is done, the file is on the disk,
    also if the power fails.

    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> with replacing(folder / "note.txt") as temporary:
    ...     _ = temporary.write_text("whole")
    >>> [file.name for file in folder.iterdir()]
    ['note.txt']
    """
    target = Path(path)
    make_folder(target.parent)
    temporary = target.with_name(f".{secrets.token_hex(8)}{target.suffix}")
    try:
        with passing(temporary):
            temporary.touch(exist_ok=False)  # not tempfile, whose files only their owner may read
            try:
                yield temporary
                flush(temporary)
                temporary.replace(target)
                flush(target.parent)
            except BaseException:
                temporary.unlink(missing_ok=True)
                raise
    except OSError as error:  # a write says that the disk is full, and not which file that meets
        if error.errno is not None and error.filename in (None, temporary, str(temporary)):
            error.filename = str(target)
        raise


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write `text` as UTF-8 with Unix line ends, whole or not at all.

    Bytes of file names that are no text become escapes, which in JSON mean those bytes again.
    """
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", errors="backslashreplace", newline="\n")


def make_folder(folder: Path) -> None:
    """Make a folder, and those above it, where they are missing; they are on the disk then."""
    missing = [one for one in (folder, *folder.parents) if not one.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    for one in reversed(missing):
        flush(one.parent)


def move_folder(folder: Path, target: Path) -> None:
    """Move a folder to where nothing is, in one step, when all that is in it is on the disk."""
    for place, _, files in os.walk(folder):
        for name in files:
            flush(Path(place, name))
        flush(Path(place))
    folder.rename(target)
    flush(target.parent)


def flush(path: Path) -> None:
    """Wait until a file, or the list of names in a folder, is on the disk.

    Raises:
        OSError: The disk is full or broken.
    """
    if path.is_dir():
        if os.name != "posix":
            return  # other systems open no folders
        flags = os.O_RDONLY | os.O_DIRECTORY
    else:
        flags = os.O_RDONLY if os.name == "posix" else os.O_RDWR
    try:
        opened = os.open(path, flags)
    except PermissionError:  # a folder that may be written into, but not listed
        return
    try:
        os.fsync(opened)
    except OSError as error:
        if not (flags & getattr(os, "O_DIRECTORY", 0) and error.errno in _UNABLE):
            raise
    finally:
        os.close(opened)


def read_at_most(path: Path, limit: int) -> bytes:
    """Read a regular file, unless it is too large to be what it should be.

    Args:
        path: The file.
        limit: Its largest size, in bytes.

    Raises:
        OSError: It cannot be read, is no regular file or too large; ``strerror`` says which.
    """
    with open(path, "rb", opener=opened_at_once) as file:  # a path has no opener
        kind = os.fstat(file.fileno())
        if not stat.S_ISREG(kind.st_mode):
            raise OSError(errno.EINVAL, "it is a pipe or a device, not a file", str(path))
        if kind.st_size > limit:
            large = f"it has {kind.st_size:,} bytes, and the limit is {limit:,}"
            raise OSError(errno.EFBIG, large, str(path))
        return file.read(limit)


def opened_at_once(path: str, flags: int) -> int:
    """Open a file without waiting for the other end of a pipe."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
