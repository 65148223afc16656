"""Parquet files of this machine or of a storage: what is one, and how it is opened."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

from skyline_viz.datasets.dataset import DatasetError
from skyline_viz.files import FULL
from skyline_viz.storage.addresses import address_of, file_system, is_address, needed
from skyline_viz.storage.fetching import persistent

SUFFIX = ".parquet"
"""How the name of a table ends."""

_BUFFER = 1 << 20  # bytes of a column that are read at a time


def is_label_table(where: str | os.PathLike[str]) -> bool:
    """Whether a path or an address is that of a table.

    >>> is_label_table("s3://labels/alps.parquet"), is_label_table("photos")
    (True, False)
    """
    return os.fspath(where).rstrip("/\\").lower().endswith(SUFFIX)


def files_of(where: str) -> list[str]:
    """The file of a table, or those of a folder of tables.

    Raises:
        DatasetError: A folder holds none.
        StorageError: An address leads nowhere.
    """
    if is_address(where):
        found, path = file_system(where)
        found.invalidate_cache()
        if not persistent(partial(found.isdir, path), where, "read"):
            return [where]
        listed = persistent(partial(found.ls, path, detail=False), where, "listed")
        inside = sorted(one for one in listed if is_label_table(one))
        files = [address_of(found, one, where) for one in inside]
    else:
        if not Path(where).is_dir():
            return [where]
        files = sorted(str(one) for one in Path(where).iterdir() if is_label_table(one))
    if not files:
        raise DatasetError(f"{where} holds no table, a file *{SUFFIX}.")
    return files


@contextmanager
def parquet(file: str) -> Iterator[Any]:
    """An open table.

    Raises:
        DatasetError: It is missing, damaged, or no table.
        StorageError: Nothing knows its address.
        MemoryError: It does not fit.
        Exception: Whatever its storage raises.
    """
    parquet = needed("pyarrow.parquet", "a table of labels")
    try:
        if is_address(file):
            found, path = file_system(file)
            opened = found.open(path, "rb")
        else:
            opened = Path(file).open("rb")  # noqa: SIM115 - closed below
        with opened, parquet.ParquetFile(opened, buffer_size=_BUFFER) as table:
            yield table
    except MemoryError:
        raise
    except needed("pyarrow", "a table of labels").ArrowException as error:
        raise DatasetError(f"{file} is damaged, or no Parquet table.") from error
    except OSError as error:
        if is_address(file) or error.errno in FULL:  # of a disk that something is written to
            raise
        reason = (error.strerror or str(error)).lower()
        raise DatasetError(f"{file} cannot be read: {reason}.") from error


def version_of(file: str) -> str:
    """What tells a file of this machine from an earlier or later one of the same name.

    Raises:
        DatasetError: It cannot be read.
    """
    try:
        about = Path(file).stat()
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise DatasetError(f"{file} cannot be read: {reason}.") from error
    return f"{about.st_mtime_ns} {about.st_size} {about.st_ino}"
