"""Tables of labels, as other programs would write them."""

import pyarrow as pa
import pyarrow.parquet as pq

KINDS = {
    "photo": pa.string(),
    "rows": pa.list_(pa.float32()),
    "visible": pa.list_(pa.bool_()),
    "height": pa.int32(),
    "width": pa.int32(),
    "sha256": pa.string(),
}


def write_labels(path, rows, /, group=2, **kinds):
    """Write rows, each a dictionary, with the columns that the first one has."""
    kinds = {**KINDS, **kinds}
    schema = pa.schema([(name, kinds[name]) for name in rows[0]])
    path.parent.mkdir(parents=True, exist_ok=True)
    pq.write_table(pa.Table.from_pylist(rows, schema), path, row_group_size=group)
    return path


def row_of(photo, line, **more):
    """The row of a photo and its line; None for no line."""
    rows, visible = (None, None) if line is None else (line.rows, line.visible)
    return {"photo": str(photo), "rows": rows, "visible": visible, **more}
