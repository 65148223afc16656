"""COCO: masks that pycocotools reads as they are, and reads of what it packs."""

import json
import shutil

import numpy as np
import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st
from pycocotools import mask as coco_mask
from pycocotools.coco import COCO

from annotate.formats import export_labels, import_labels
from testing.examples import examples
from testing.exports import HEIGHT, WIDTH, label, put, refused

FEW = examples(25, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


@pytest.mark.filterwarnings("ignore:__array__ implementation:DeprecationWarning")  # theirs
@FEW
@given(
    rows=st.lists(st.integers(0, HEIGHT), min_size=WIDTH, max_size=WIDTH).filter(any),
)
def test_coco_means_this_very_mask(tmp_path, photos, rows):
    given_label = label(photos, "a.png", np.array(rows))
    out = tmp_path / "out"
    shutil.rmtree(out, ignore_errors=True)
    export_labels([given_label], photos, out, "coco")
    wanted = given_label.skyline.to_mask(HEIGHT)
    for name in ("annotations-polygon.json", "annotations-rle.json"):
        coco = COCO(out / name)
        (one,) = coco.loadAnns(coco.getAnnIds())
        packed = coco.annToRLE(one)
        np.testing.assert_array_equal(coco_mask.decode(packed).astype(bool), wanted, name)
        assert coco_mask.area(packed) == one["area"]
        (image,) = coco.loadImgs(one["image_id"])
        assert (image["height"], image["width"]) == (HEIGHT, WIDTH)
        assert coco.loadCats(one["category_id"])[0]["name"] == "sky"
    counts = one["segmentation"]["counts"]
    assert sum(counts) == HEIGHT * WIDTH
    assert min(counts[1:]) > 0


def test_coco_is_read_as_pycocotools_packs_it(tmp_path, photos):
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", "coco")
    path = tmp_path / "out" / "annotations-rle.json"
    document = json.loads(path.read_text())
    sky = label(photos, "a.png").skyline.to_mask(HEIGHT)
    packed = coco_mask.encode(np.asfortranarray(sky.astype(np.uint8)))
    document["annotations"][0]["segmentation"] = {
        "size": packed["size"],
        "counts": packed["counts"].decode(),
    }
    path.write_text(json.dumps(document))
    (found,) = import_labels(path, photos, ["a.png"])
    assert found.skyline == label(photos, "a.png").skyline


def test_a_claimed_size_is_checked_before_memory_is_taken(tmp_path, photos, monkeypatch):
    def claim(whole):
        document = json.loads(whole)
        document["images"][0] |= {"height": 10**5, "width": 10**5}
        document["annotations"][0]["segmentation"]["counts"] = [10**10]
        return json.dumps(document).encode()

    repeat = np.repeat

    def small(values, counts, *rest):
        assert np.sum(counts) < 10**9, "10 GB"
        return repeat(values, counts, *rest)

    monkeypatch.setattr(np, "repeat", small)
    refused(tmp_path, photos, "coco", claim)
