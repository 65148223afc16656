"""Labels of small photos that are exported and imported again."""

import hashlib
import shutil

import numpy as np
import pytest

from annotate.formats import FormatError, export_labels, import_labels
from annotate.store.labels import Label
from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline

HEIGHT, WIDTH = 16, 24


def put(folder, name, height=HEIGHT, width=WIDTH, seed=0):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(seed)
    write_photo(path, random.integers(0, 256, (height, width, 3), np.uint8))
    return path


def label(photos, name, rows=None, visible=None, tags=(), width=WIDTH, height=HEIGHT):
    rows = np.arange(width) % 5 + 4 if rows is None else rows
    path = photos / name
    return Label(
        name=name,
        digest=hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "",
        width=width,
        height=height,
        annotator="ann",
        number=2,
        status="accepted",
        tags=tuple(tags),
        skyline=Skyline(rows, visible),
        origin=(np.arange(width) % 4).astype(np.uint8),
        operations=({"kind": "anchor", "column": 3, "row": 4, "at": 1.5},),
        seconds=12.5,
        detector="found by hand",
        blind=True,
    )


def without_line(photos, name):
    return Label(**{**vars(label(photos, name)), "skyline": None})


def there_and_back(tmp_path, photos, kind, labels):
    """Export and import; the names that are there are those of the labels."""
    out = tmp_path / "out"
    shutil.rmtree(out, ignore_errors=True)
    export = export_labels(labels, photos, out, kind)
    return export, import_labels(out, photos, [one.name for one in labels])


FILE = {
    "mask": "masks/a.png",
    "painted": "ground_truth/GT_GoogleImage001_Edge.bmp",
    "ch1": "cvg/ground_truth/a-mask.png",
    "csv": "a.csv",
    "json": "labels.json",
    "coco": "annotations-rle.json",
    "labelme": "a.json",
    "cvat": "annotations.xml",
    "parquet": "labels.parquet",
}


def refused(tmp_path, photos, kind, content):
    """What is said about a file of an export that was replaced by `content`."""
    out = tmp_path / "out"
    shutil.rmtree(out, ignore_errors=True)
    export_labels([label(photos, "a.png")], photos, out, kind)
    path = out / FILE[kind]
    path.write_bytes(content(path.read_bytes()) if callable(content) else content)
    with pytest.raises(FormatError) as caught:
        import_labels(out, photos, ["a.png"], kind)
    said = str(caught.value)
    assert len(said.splitlines()) == 1
    assert said.endswith(".")
    return said
