"""LabelMe: what its documents hold."""

import json
from dataclasses import replace

import pytest

from annotate.formats import export_labels
from annotate.store.labels import Comment
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


def test_what_was_said_of_a_photo_is_the_description(tmp_path, photos):
    said = replace(label(photos, "a.png"), comment=Comment("the hut is cut off", "eve"))
    found = export_labels([said], photos, tmp_path / "out", "labelme")
    (shape,) = json.loads((tmp_path / "out" / "a.json").read_text())["shapes"]
    assert shape["description"] == "eve: the hut is cut off"
    assert found.notes == ()
    found = export_labels([said], photos, tmp_path / "csv", "csv")
    assert found.notes == ("csv cannot say what was said of a photo: a.png.",)
