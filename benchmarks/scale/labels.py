"""What a table of labels takes: to open it, in the client, and on the way to a worker.

    python -m benchmarks.scale.labels [PHOTOS]

100,000 photos unless given. None of them is read.
"""

from __future__ import annotations

import gc
import pickle
import sys
import tempfile
from pathlib import Path
from time import process_time

import numpy as np
import psutil
import pyarrow as pa
import pyarrow.parquet as pq

from skyline_viz.datasets.layouts import open_dataset

_COLUMNS = 1600


def main(photos: int = 100_000) -> None:
    """Write a table, open it, and print the figures."""
    kinds = pa.schema({"photo": pa.string(), "rows": pa.list_(pa.float32())}.items())
    steps = np.random.default_rng(0).integers(-1, 2, (1000, _COLUMNS))
    lines = pa.array([*(300 + steps.cumsum(1)).astype(np.float32)], kinds.field("rows").type)
    with tempfile.TemporaryDirectory() as place:
        table = Path(place, "labels.parquet")
        with pq.ParquetWriter(table, kinds) as writer:
            for first in range(0, photos, 1000):
                names = [f"s3://photos/2026/11/26/webcam-{first + at:09}.jpg" for at in range(1000)]
                writer.write_table(pa.table({"photo": names, "rows": lines}, kinds))
        before = _memory()
        began = process_time()
        items = open_dataset(table).items
        took, kept = process_time() - began, _memory() - before
        sent = sum(len(pickle.dumps(item)) for item in items[:1000]) / 1000
    print(
        f"a table of {photos:,} labels of {_COLUMNS} columns: {took:.1f} s to open, "
        f"{kept / photos:.0f} bytes a photo in the client, {sent:.0f} bytes to a worker"
    )


def _memory() -> int:
    gc.collect()
    return int(psutil.Process().memory_info().rss)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
