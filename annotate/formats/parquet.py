"""Labels as one Parquet table, a row a photo: a data set of its own.

``labels.parquet`` is a table as `datasets.tables.label_table` reads it. It also has the ``name`` of
each photo below the folder, and ``tags``. In ``photo`` are whole paths.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from annotate.formats.common import Entry, Imported, check_size
from annotate.formats.importing import Task
from annotate.store.identity import file_digest
from skyline_viz.datasets.dataset import DatasetError
from skyline_viz.datasets.outlines import FormatError
from skyline_viz.datasets.tables.label_table import open_label_table, place_of_photo
from skyline_viz.datasets.tables.parquet_files import SUFFIX
from skyline_viz.datasets.tables.table_item import TableItem
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
            "name": arrow.string(),
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
        names, tags = _column(file, "name"), _column(file, "tags")
        items = {
            names.get(item.where) or item.where: item
            for item in dataset
            if isinstance(item, TableItem)
        }
        matched = task.names.of_references(items)
        for sentence in matched.unclear:
            task.found.problem(sentence)
        for name, photo in matched.photos.items():
            item = items[name]
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
                said = tuple(tags.get(item.where) or ())
                task.found.labels.append(Imported(photo, line, said))
        for name in matched.unknown:
            task.found.note("belong to no photo of the folder", name)


def _row(entry: Entry) -> dict[str, Any]:
    return {
        "photo": str(entry.photo.resolve()),
        "name": entry.label.name,
        "sha256": file_digest(entry.photo),
        "height": entry.label.height,
        "width": entry.label.width,
        "rows": entry.skyline.rows,
        "visible": entry.skyline.visible,
        "tags": entry.label.tags,
    }


def _column(file: Path, column: str) -> dict[str, Any]:
    """What a column says of each photo of a table; nothing where there is no such column."""
    parquet = _arrow("pyarrow.parquet")
    if column not in parquet.read_schema(file).names:
        return {}
    rows = parquet.read_table(file, columns=["photo", column]).to_pylist()
    return {place_of_photo(str(file), row["photo"]): row[column] for row in rows if row["photo"]}


def _arrow(module: str) -> Any:  # noqa: ANN401 - has no types
    try:
        return needed(module, "a Parquet table")
    except StorageError as error:
        raise FormatError(str(error)) from error
