"""The skylines of many photos as one Parquet table: a row a photo, whatever reads Parquet.

==============  ============  ===================================================================
column          type          meaning
==============  ============  ===================================================================
photo           text          path or address
sha256          text          digest of the content of its file, in hexadecimal digits
stamp           text          what the storage said of that content; empty for files
height, width   int32         size in pixels
rows            float32 list  row of the first terrain pixel of each column
visible         bool list     whether the line can be seen there
margin_05 ...   float64       quantiles of the margins of its columns, up to ``margin_95``
confidence      float64       probability that the line is no gross miss
case            text          what the photo shows, see `visibility.Case`; empty where not known
seconds         float64       of the detection
error           text          why it failed, in a sentence; all else is null then
==============  ============  ===================================================================

What made the table stands in its metadata, as JSON under ``skyline``.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from skyline_viz.files import replacing
from skyline_viz.storage.addresses import needed
from skyline_viz.system.names import printable

if TYPE_CHECKING:
    from skyline_viz.detection import Detection

SUFFIX = ".parquet"
"""How the name of a table ends."""

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)
"""Quantiles of margins that are kept."""

ABOUT = "skyline"
"""Key of the metadata."""

_GROUP = 1000  # rows of a row group: a few megabytes, which is what is held at a time


class TableError(ValueError):
    """A file is no such table, or does not fit; the message is one sentence that names it."""


def arrow(module: str = "pyarrow") -> Any:  # noqa: ANN401 - has no types
    """Pyarrow, imported where a table is needed.

    Raises:
        StorageError: It is not installed.
    """
    return needed(module, "a Parquet table")


@cache
def schema() -> Any:  # noqa: ANN401
    """The columns, as pyarrow describes them."""
    pa = arrow()
    number, text, size = pa.float64(), pa.string(), pa.int32()
    kinds = {
        "photo": text,
        "sha256": text,
        "stamp": text,
        "height": size,
        "width": size,
        "rows": pa.list_(pa.float32()),
        "visible": pa.list_(pa.bool_()),
        **dict.fromkeys(_margin_names(), number),
        "confidence": number,
        "case": text,
        "seconds": number,
        "error": text,
    }
    return pa.schema([*kinds.items()])


def found_row(photo: str, stamp: str, sha256: str, found: Detection) -> bytes:
    """The row of a detection, as it is kept and sent."""
    line, seen = found.skyline, found.visibility
    margins = np.quantile(found.margins().astype(np.float64), QUANTILES, method="lower")
    return _packed(
        {
            "photo": photo,
            "sha256": sha256,
            "stamp": stamp,
            "height": found.photo.shape[0],
            "width": line.width,
            "rows": line.rows,
            "visible": line.visible,
            **dict(zip(_margin_names(), margins.tolist(), strict=True)),
            "confidence": found.confidence,
            "case": seen.case if seen else "",
            "seconds": found.total_seconds,
        }
    )


def stamped_row(row: bytes, stamp: str) -> bytes:
    """A row whose photo has another stamp, and the same content."""
    pa = arrow()
    batch = _batch(row)
    place, kind = schema().get_field_index("stamp"), pa.string()
    stamped: bytes = (
        batch.set_column(place, "stamp", pa.array([stamp], kind)).serialize().to_pybytes()
    )
    return stamped


def failed_row(photo: str, reason: str) -> bytes:
    """The row of a photo that failed."""
    return _packed({"photo": photo, "error": printable(reason)})


def write_lines(path: Path, rows: Iterable[bytes], about: Mapping[str, object]) -> int:
    """Write a table, whole or not at all, a thousand rows at a time; return the number of rows.

    Args:
        path: Where to.
        rows: Rows as `found_row` and `failed_row` make them.
        about: What made it.

    Raises:
        OSError: The disk is full or read-only.
    """
    text = json.dumps(about, ensure_ascii=False)
    told = schema().with_metadata({ABOUT: text.encode(errors="backslashreplace")})
    count = 0
    with replacing(path) as temporary, _writer(temporary, told) as writer:
        waiting: list[Any] = []
        for row in rows:
            waiting.append(_batch(row))
            count += 1
            if len(waiting) == _GROUP:
                writer.write_table(_joined(waiting, told))
                waiting = []
        if waiting or not count:
            writer.write_table(_joined(waiting, told))
    return count


def read_about(path: Path) -> dict[str, Any]:
    """What made a table.

    Raises:
        TableError: It is no table of skylines, or damaged.
        OSError: It cannot be read.
    """
    parquet = arrow("pyarrow.parquet")
    try:
        found = parquet.read_schema(path)
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and error.errno is not None:
            raise
        raise TableError(f"{path} is damaged, or no Parquet table.") from error
    try:
        about = json.loads((found.metadata or {})[ABOUT.encode()])
    except (KeyError, ValueError) as error:
        raise TableError(f"{path} is no table of skylines.") from error
    if not isinstance(about, dict) or not found.equals(schema()):
        raise TableError(f"{path} is a table of skylines of another version.")
    return about


def photos_in(path: Path) -> Iterator[str]:
    """The name of each photo of a table.

    Raises:
        TableError: The table is damaged.
        OSError: It cannot be read.
    """
    parquet = arrow("pyarrow.parquet")
    with _damage_told(path), parquet.ParquetFile(path) as file:
        for batch in file.iter_batches(_GROUP, columns=["photo"]):
            yield from batch.column("photo").to_pylist()


def read_rows(path: Path) -> Iterator[tuple[dict[str, Any], bytes]]:
    """Photo, digest, stamp and error of each row of a table, and the row itself.

    Raises:
        TableError: The table is damaged.
    """
    parquet = arrow("pyarrow.parquet")
    names = ["photo", "sha256", "stamp", "error"]
    with _damage_told(path), parquet.ParquetFile(path) as file:
        for batch in file.iter_batches(_GROUP):
            plain = batch.replace_schema_metadata(None)
            for number, known in enumerate(batch.select(names).to_pylist()):
                yield known, plain.slice(number, 1).serialize().to_pybytes()


@contextmanager
def _damage_told(path: Path) -> Iterator[None]:
    """Say of whatever a damaged table raises that it is damaged."""
    try:
        yield
    except (OSError, ValueError, arrow().ArrowException) as error:
        if isinstance(error, OSError) and error.errno is not None:
            raise
        raise TableError(f"{path} is damaged.") from error


def _margin_names() -> list[str]:
    return [f"margin_{100 * one:02.0f}" for one in QUANTILES]


def _packed(row: Mapping[str, object]) -> bytes:
    pa = arrow()
    columns = [pa.array([row.get(one.name)], one.type) for one in schema()]
    packed: bytes = pa.record_batch(columns, schema=schema()).serialize().to_pybytes()
    return packed


def _batch(row: bytes) -> Any:  # noqa: ANN401
    pa = arrow()
    return arrow("pyarrow.ipc").read_record_batch(pa.py_buffer(row), schema())


def _joined(batches: list[Any], told: Any) -> Any:  # noqa: ANN401
    pa = arrow()
    table = pa.Table.from_batches(batches, schema()).combine_chunks()
    return table.replace_schema_metadata(told.metadata)


def _writer(path: Path, told: Any) -> Any:  # noqa: ANN401
    return arrow("pyarrow.parquet").ParquetWriter(path, told, compression="zstd")
