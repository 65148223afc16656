"""Small data sets in the published layouts, and as tables of labels."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from PIL import Image

import skyline_viz as sv

HEIGHT, WIDTH = 16, 24
ROWS = np.arange(WIDTH) % 5 + 4
SKYLINE = sv.Skyline(ROWS)
PHOTO = np.full((HEIGHT, WIDTH, 3), (90, 120, 150), np.uint8)
PHOTO[SKYLINE.to_mask(HEIGHT)] = (200, 210, 230)
PAINTED = SKYLINE.to_painted(PHOTO, "red")
MASK = np.where(SKYLINE.to_mask(HEIGHT), 0, 255).astype(np.uint8)
NOISE = np.random.default_rng(0).integers(0, 256, (HEIGHT, WIDTH, 3), np.uint8)


def put(path, pixels=PHOTO, **options):
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.ascontiguousarray(pixels)).save(path, **options)
    return path


def names(dataset):
    return [item.name for item in dataset]


def only(dataset):
    assert len(dataset) == 1
    assert dataset.problems == ()
    return dataset.items[0]


def basalt(root, count=3):
    for number in range(1, count + 1):
        put(root / "images" / f"marsim{number:04}.pgm", PHOTO[:, :, 1])
        line = sv.Skyline(np.full(WIDTH, number)).to_painted(NOISE)
        put(root / "ground_truth" / f"GT_marsim{number:03}_Edge.bmp", line)


def web(root, count=3):
    for number in range(1, count + 1):
        put(root / "images" / f"R_GImag{number:04}.bmp")
        line = sv.Skyline(np.full(WIDTH, number)).to_painted(NOISE, "blue")
        put(root / "ground_truth" / f"GT_GoogleImage{number:03}_Edge.bmp", line)


def ch1(root):
    for part, name in [("cvg", "IMG_1.jpg"), ("panoramio", "IMG_1.jpg"), ("cvg", "b.png")]:
        stem, ending = name.split(".")
        put(root / part / "images" / name)
        put(root / part / "ground_truth" / f"{stem}-mask.{ending}", MASK)
    put(root / "poor_edge_images" / "images" / "c.jpg")


def geopose3k(root):
    sky = SKYLINE.to_mask(HEIGHT)
    labels = np.where(sky[:, :, None], 0, np.array([97, 89, 87])).astype(np.uint8)
    labels[12:, :, :] = (118, 219, 99)
    alpha = np.full((HEIGHT, WIDTH, 1), 255, np.uint8)
    put(root / "flickr_1@N00" / "photo.jpg")
    put(root / "flickr_1@N00" / "labels.png", labels)
    put(root / "flickr_2@N00" / "photo.jpeg")
    put(root / "flickr_2@N00" / "pinhole" / "labels_crop.png", np.dstack([labels, alpha]))
    put(root / "flickr_2@N00" / "cyl" / "labels_crop.png", labels[:10])
    put(root / "flickr_3@N00" / "photo.jpg")
    (root / "README.txt").touch()


TABLE_KINDS = {
    "photo": pa.string(),
    "rows": pa.list_(pa.float32()),
    "visible": pa.list_(pa.bool_()),
    "height": pa.int32(),
    "width": pa.int32(),
    "sha256": pa.string(),
}


def write_labels(path, rows, /, group=2, **kinds):
    """Write rows, each a dictionary, with the columns that the first one has."""
    kinds = {**TABLE_KINDS, **kinds}
    schema = pa.schema([(name, kinds[name]) for name in rows[0]])
    path.parent.mkdir(parents=True, exist_ok=True)
    pq.write_table(pa.Table.from_pylist(rows, schema), path, row_group_size=group)
    return path


def row_of(photo, line, **more):
    """The row of a photo and its line; None for no line."""
    rows, visible = (None, None) if line is None else (line.rows, line.visible)
    return {"photo": str(photo), "rows": rows, "visible": visible, **more}
