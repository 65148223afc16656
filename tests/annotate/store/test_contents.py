"""Photos known by their bytes and pixels: a label that comes back finds its photo."""

import json

import pytest

import annotate.store.identity as identity
from annotate.store.contents import Contents
from annotate.store.identity import pixel_digest
from annotate.store.store import Store
from annotate.work.joined import joined
from skyline_viz.photo import read_photo
from testing.edited_photos import replaced, with_comment, write_jpegs
from testing.labels import label_named, rows_of, run


@pytest.fixture
def folder(tmp_path):
    return write_jpegs(tmp_path / "alps")


def exported(folder, tmp_path):
    out = tmp_path / "labels"
    assert run("export", folder, "--format", "json", "--out", out) == 0
    return out / "labels.json"


def test_labels_carry_both_digests(folder, tmp_path):
    label_named(folder, ["hill-1.jpg"], 11)
    (told,) = json.loads(exported(folder, tmp_path).read_text())["labels"]
    assert told["digest"] == identity.file_digest(folder / "hill-1.jpg")
    assert told["pixels"] == pixel_digest(read_photo(folder / "hill-1.jpg"))


def test_import_goes_by_content_and_not_by_name(folder, tmp_path, capsys):
    label_named(folder, ["hill-0.jpg", "hill-1.jpg", "hill-2.jpg"], 11)
    file = exported(folder, tmp_path)
    other = write_jpegs(tmp_path / "other")
    (other / "hill-0.jpg").rename(other / "renamed.jpg")
    with_comment(other / "hill-1.jpg")
    replaced(other / "hill-2.jpg", seed=7)
    capsys.readouterr()
    assert run("import", other, file) == 0
    said = capsys.readouterr()
    assert "2 labels imported" in said.out
    assert "1 label belongs to a photo that is not in" in said.err
    assert "hill-2.jpg (sha256" in said.err
    assert rows_of(other) == {"renamed": {11}, "hill-1": {11}}


def test_a_label_without_digests_goes_by_its_name(folder, tmp_path):
    label_named(folder, ["hill-1.jpg"], 11)
    file = exported(folder, tmp_path)
    document = json.loads(file.read_text())
    document["labels"][0] |= {"digest": "", "pixels": ""}
    file.write_text(json.dumps(document))
    other = write_jpegs(tmp_path / "other")
    replaced(other / "hill-1.jpg", seed=7)
    assert run("import", other, file) == 0
    assert rows_of(other) == {"hill-1": {11}}


def test_an_imported_label_follows_metadata(folder, tmp_path):
    label_named(folder, ["hill-1.jpg"], 11)
    file = exported(folder, tmp_path)
    other = write_jpegs(tmp_path / "other")
    assert run("import", other, file) == 0
    with_comment(other / "hill-1.jpg")
    assert rows_of(other) == {"hill-1": {11}}


def test_contents_know_photos_by_bytes_and_by_pixels(folder):
    label_named(folder, ["hill-1.jpg"], 11)
    store = Store(folder, reading=True)
    (told,) = joined(store).labels
    store.close()
    (folder / "hill-1.jpg").rename(folder / "a.jpg")
    assert Contents(folder, ["a.jpg", "hill-0.jpg"]).name_of(told) == "a.jpg"
    with_comment(folder / "a.jpg")
    assert Contents(folder, ["a.jpg", "hill-0.jpg"]).name_of(told) == "a.jpg"
    assert Contents(folder, ["hill-0.jpg", "gone.jpg"]).name_of(told) is None
