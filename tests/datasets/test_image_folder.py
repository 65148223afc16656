"""Tables that name the truths of photos, as image folders of Hugging Face have them."""

import json

import pytest

import skyline_viz as sv
from skyline_viz.datasets.image_folder import linked_truths
from testing.datasets import MASK, SKYLINE, names, put

ROWS = [("a.png", "truths of a.png"), ("sub/b.png", "b_drawn.png")]


def written(folder, kind, rows=ROWS):
    if kind == "csv":
        lines = ["file_name,text,mask_file_name", *(f"{photo},x,{mask}" for photo, mask in rows)]
        (folder / "metadata.csv").write_text("\n".join(lines), encoding="utf-8")
        return
    rows = [{"file_name": photo, "sky_file_name": mask} for photo, mask in rows]
    text = "\n".join(map(json.dumps, rows))
    (folder / "metadata.jsonl").write_text(f"{text}\n\n", encoding="utf-8")


@pytest.mark.parametrize("kind", ["csv", "jsonl"])
def test_a_table_names_truths_which_are_then_no_photos(tmp_path, kind):
    for photo, mask in ROWS:
        put(tmp_path / "train" / photo)
        put(tmp_path / "train" / mask, MASK)
    put(tmp_path / "test" / "c.png")
    written(tmp_path / "train", kind)
    dataset = sv.open_dataset(tmp_path)
    assert names(dataset) == ["test/c", "train/a", "train/sub/b"]
    assert [item.truth() for item in dataset] == [None, SKYLINE, SKYLINE]
    assert dataset.problems == ()


@pytest.mark.parametrize("name", ["../a.png", "/etc/passwd", "gone.png", "", "a.png"])
def test_a_truth_lies_in_the_folder(tmp_path, name):
    put(tmp_path / "set" / "a.png")
    put(tmp_path / "a.png")
    written(tmp_path / "set", "csv", [("a.png", name)])
    assert linked_truths(tmp_path / "set") == {}


@pytest.mark.parametrize("content", [b"", b"\xff\xfe\0", b"file_name\na.png,b.png\n", b"[1]\n{"])
@pytest.mark.parametrize("ending", ["csv", "jsonl"])
def test_another_table_names_none(tmp_path, ending, content):
    put(tmp_path / "a.png")
    (tmp_path / f"metadata.{ending}").write_bytes(content)
    assert linked_truths(tmp_path) == {}
    assert names(sv.open_dataset(tmp_path)) == ["a"]
