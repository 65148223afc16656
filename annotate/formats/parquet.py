"""Labels as one Parquet table, a row a photo: a data set of its own, see `datasets.label_table`.

``labels.parquet`` has the columns of that table, and ``tags``. Photos are named by their whole
paths.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from annotate.formats.common import Entry, Imported, check_size
from annotate.formats.importing import Task
from annotate.store.identity import file_digest
from skyline_viz.datasets.dataset import DatasetError
from skyline_viz.datasets.label_table import open_label_table
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.datasets.parquet_files import SUFFIX
from skyline_viz.datasets.table_item import TableItem
from skyline_viz.photo import PhotoError
from skyline_viz.skyline import SkylineError
from skyline_viz.storage.addresses import StorageError, needed

_FILE = "labels" + SUFFIX
_GROUP = 1000  # rows of a row group


def write_parquet(entries: list[Entry], folder: Path) -> None:
    """Write a table.

    Raises:
        FormatError: pyarrow is not installed.
    """
    arrow, parquet = _arrow("pyarrow"), _arrow("pyarrow.parquet")
    schema = arrow.schema(
        {
            "photo": arrow.string(),
            "sha256": arrow.string(),
            "height": arrow.int32(),
            "width": arrow.int32(),
            "rows": arrow.list_(arrow.float32()),
            "visible": arrow.list_(arrow.bool_()),
            "tags": arrow.list_(arrow.string()),
        }.items()
    )
    with parquet.ParquetWriter(folder / _FILE, schema, compression="zstd") as writer:
        for first in range(0, len(entries), _GROUP):
            rows = [_row(entry) for entry in entries[first : first + _GROUP]]
            writer.write_table(arrow.Table.from_pylist(rows, schema))


def read_parquet(task: Task) -> None:
    """Read the tables of a folder, or one of them.

    Raises:
        FormatError: A table is damaged, or pyarrow is not installed.
    """
    for file in task.files:
        if file.suffix.lower() != SUFFIX:
            continue
        try:
            dataset = open_label_table(str(file))
        except (DatasetError, StorageError) as error:
            raise FormatError(str(error)) from error
        items = {item.where: item for item in dataset if isinstance(item, TableItem)}
        tags = _tags(file)
        matched = task.names.of_references(items)
        for sentence in matched.unclear:
            task.found.problem(sentence)
        for where, photo in matched.photos.items():
            item = items[where]
            try:
                line = item.truth()
                if line is not None:
                    height = item.pixels[0] if item.pixels else None
                    line = check_size(photo, line, task.photos, height)
            except (FormatError, PhotoError, SkylineError) as error:
                task.found.problem(str(error))
                continue
            if line is None:
                task.found.note(f"without a line in {file.name}", photo)
            else:
                given = item.place.photo if item.place else ""
                task.found.labels.append(Imported(photo, line, tags.get(given, ())))
        for where in matched.unknown:
            task.found.note("belong to no photo of the folder", where)


def _row(entry: Entry) -> dict[str, Any]:
    return {
        "photo": str(entry.photo.resolve()),
        "sha256": file_digest(entry.photo),
        "height": entry.label.height,
        "width": entry.label.width,
        "rows": entry.skyline.rows,
        "visible": entry.skyline.visible,
        "tags": entry.label.tags,
    }


def _tags(file: Path) -> dict[str, tuple[str, ...]]:
    """What was said of each photo that a table names; nothing where it has no such column."""
    parquet = _arrow("pyarrow.parquet")
    if "tags" not in parquet.read_schema(file).names:
        return {}
    rows = parquet.read_table(file, columns=["photo", "tags"]).to_pylist()
    return {row["photo"]: tuple(row["tags"] or ()) for row in rows}


def _arrow(module: str) -> Any:  # noqa: ANN401 - has no types
    try:
        return needed(module, "a Parquet table")
    except StorageError as error:
        raise FormatError(str(error)) from error
