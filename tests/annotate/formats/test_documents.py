"""Text files of other programs, as they are written and packed."""

import json

import pytest

from annotate.formats import documents
from testing import label_files as made
from testing.imports import imported, is_right, said_about
from testing.label_documents import LAYOUTS, READ


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("packed", [False, True])
def test_folders_and_zips_as_programs_lay_them_out(tmp_path, photos, layout, packed):
    for name, document in LAYOUTS[layout].items():
        made.written(tmp_path / "in" / name, document)
    source = tmp_path / "in"
    if packed:
        source = made.packed(source, tmp_path / "packed.zip")
    found = is_right(imported(source, photos))
    assert bool(found.problems) == (layout == "one damaged file among them")
    assert all("skyline-labels-" not in one for one in (*found.problems, *found.notes))


def test_masks_in_a_zip(tmp_path, photos):
    png = made.SAME["palette of two"](tmp_path).read_bytes()
    members = {"SegmentationClass/ridge.png": png, "SegmentationObject/ridge.png": b"", "l.txt": ""}
    is_right(imported(made.zipped(tmp_path / "a.zip", members), photos))


def test_a_zip_cannot_leave_its_folder_nor_fill_the_disk(tmp_path, photos, monkeypatch):
    text = json.dumps(READ["coco polygon"])
    bad = {"../out.json": text, "/etc/out.json": text, "a\\..\\out.json": text, ".x/o.json": text}
    said_about(made.zipped(tmp_path / "a.zip", bad), photos)
    assert sorted(one.name for one in tmp_path.iterdir()) == ["a.zip", "photos"]
    monkeypatch.setattr(documents, "_MOST_UNPACKED", 1000)
    assert "unpack it" in said_about(made.zipped(tmp_path / "b.zip", {"a.json": text}), photos)
    (tmp_path / "c.zip").write_bytes((tmp_path / "b.zip").read_bytes()[:-30])
    assert "no sound ZIP" in said_about(tmp_path / "c.zip", photos)
