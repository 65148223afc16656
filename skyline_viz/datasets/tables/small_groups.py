"""Tables of labels whose rows can be read a few at a time: in small groups, on this machine.

A truth is read when the turn of its photo comes, in whatever order. So a table in a storage, and
one with large row groups, as most programs write them, is passed over once. What is needed of it is
kept in groups of a thousand rows, in the folder of caches, and serves until the table changes;
always anew where its storage does not tell. What has not been used for a month goes.
"""

from __future__ import annotations

import atexit
import hashlib
import os
import secrets
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from skyline_viz.datasets.dataset import DatasetError
from skyline_viz.datasets.tables.parquet_files import parquet, version_of
from skyline_viz.files import replacing
from skyline_viz.storage.addresses import file_system, is_address, needed
from skyline_viz.storage.copies import KEPT, caches, check_room
from skyline_viz.storage.fetching import persistent
from skyline_viz.storage.listing import stamp_of

LARGE = 10_000
"""Rows of a group that is too large to be read for the sake of one of them."""

_SMALL = 1000
_NEEDED = ("photo", "rows")
_OTHERS = ("visible", "height", "width", "sha256")


def in_small_groups(file: str) -> tuple[str, str]:
    """A table's file that is near and has small groups: itself, or a copy.

    Args:
        file: Path or address of the file.

    Returns:
        Its path, and its version, see `version_of`; that of a copy, which nobody changes, is empty.

    Raises:
        DatasetError: It is damaged, missing or no table of labels.
        StorageError: It cannot be downloaded, or the disk would not hold the copy.
        OSError: The folder of caches cannot be written.
    """
    if is_address(file):
        found, path = file_system(file)
        found.invalidate_cache()
        about = persistent(partial(found.info, path), file, "read")
        version, size = stamp_of(about), about.get("size") or 0
    else:
        with parquet(file) as table:
            groups = range(table.num_row_groups)
            if all(table.metadata.row_group(one).num_rows <= LARGE for one in groups):
                return file, version_of(file)
        version, size = version_of(file), Path(file).stat().st_size
    home = caches() / "labels"
    own = version or secrets.token_hex(8)
    copy = home / f"{hashlib.sha256(f'{file} {own}'.encode()).hexdigest()[:16]}.parquet"
    if version and copy.is_file():
        os.utime(copy, ns=(time.time_ns(), copy.stat().st_mtime_ns))  # it has been used
        return str(copy), ""
    check_room(size, file)
    _forget_old(home)
    with replacing(copy) as temporary:
        if fault := persistent(partial(_write, file, temporary), file, "downloaded"):
            raise fault
    if not version:
        atexit.register(copy.unlink, missing_ok=True)  # nobody could know it again
    return str(copy), ""


def _write(file: str, copy: Path) -> DatasetError | None:
    """Copy what is needed of a table; what is wrong with the table is returned, for good."""
    writer = needed("pyarrow.parquet", "a table of labels").ParquetWriter
    try:
        with parquet(file) as table:
            columns = columns_of(table, file)
            whole = table.schema_arrow
            kinds = needed("pyarrow", "a table of labels").schema(
                [whole.field(one) for one in columns], whole.metadata
            )
            with writer(copy, kinds, compression="zstd") as out:
                for batch in table.iter_batches(_SMALL, columns=columns):
                    out.write_batch(batch.cast(kinds))
    except DatasetError as error:
        return error
    return None


def _forget_old(home: Path) -> None:
    for file in home.glob("*.parquet"):
        if time.time() - file.stat().st_atime > KEPT:
            file.unlink(missing_ok=True)


def columns_of(table: Any, file: str) -> list[str]:  # noqa: ANN401
    """Names of the columns that are read.

    Raises:
        DatasetError: One is missing, or holds something else.
    """
    schema, kinds = table.schema_arrow, needed("pyarrow", "a table of labels").types
    if missing := [one for one in _NEEDED if one not in schema.names]:
        raise DatasetError(
            f"{file} has no column {missing[0]}; a table of labels has photo and rows."
        )

    def is_text(kind: Any) -> bool:  # noqa: ANN401
        kind = kind.value_type if kinds.is_dictionary(kind) else kind
        return any((kinds.is_string(kind), kinds.is_large_string(kind), kinds.is_string_view(kind)))

    def is_number(kind: Any) -> bool:  # noqa: ANN401
        return bool(kinds.is_integer(kind) or kinds.is_floating(kind) or kinds.is_null(kind))

    def is_list(kind: Any, inside: Callable[[Any], bool]) -> bool:  # noqa: ANN401
        lists = (kinds.is_list, kinds.is_large_list, kinds.is_fixed_size_list)
        return any(one(kind) for one in lists) and inside(kind.value_type)

    fitting: dict[str, tuple[str, Callable[[Any], bool]]] = {
        "photo": ("text", is_text),
        "rows": (
            "lists of numbers",
            lambda kind: kinds.is_null(kind) or is_list(kind, is_number),
        ),
        "visible": (
            "lists of true and false",
            lambda kind: kinds.is_null(kind) or is_list(kind, kinds.is_boolean),
        ),
        "height": ("numbers", is_number),
        "width": ("numbers", is_number),
        "sha256": ("text", lambda kind: kinds.is_null(kind) or is_text(kind)),
    }
    names = [one for one in (*_NEEDED, *_OTHERS) if one in schema.names]
    for name in names:
        what, fits = fitting[name]
        if not fits(kind := schema.field(name).type):
            raise DatasetError(f"the column {name} of {file} holds {kind}, and not {what}.")
    return names
