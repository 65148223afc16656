"""LabelMe: what its documents hold."""

import json

import pytest

from annotate.formats import export_labels
from testing.exports import HEIGHT, WIDTH, label, put


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


def test_labelme_documents_have_what_labelme_asks_for(tmp_path, photos):
    export_labels([label(photos, "a.png", tags=["mine"])], photos, tmp_path / "out", "labelme")
    document = json.loads((tmp_path / "out" / "a.json").read_text())
    assert document["imagePath"] == "a.png"
    assert document["imageData"] is None
    assert (document["imageHeight"], document["imageWidth"]) == (HEIGHT, WIDTH)
    assert document["flags"] == {"mine": True}
    assert {shape["shape_type"] for shape in document["shapes"]} == {"linestrip"}
