"""A label belongs to the pixels it was made on: never another photo, and metadata lose none."""

import io
import os
import shutil
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

import annotate.store.identity as identity
import annotate.store.opened as opened
from annotate.formats import FORMATS, import_labels
from annotate.store.identity import pixel_digest
from annotate.store.operations import Open
from skyline_viz.photo import read_photo
from testing import until
from testing.edited_photos import replaced, with_comment, with_place, write_jpegs
from testing.examples import examples
from testing.labelling import served, workbench
from testing.labels import label_named, rows_of, run, statuses

EVERY = pytest.mark.parametrize("kind", list(FORMATS))
EDITS = pytest.mark.parametrize("edit", [with_comment, with_place])


@pytest.fixture
def folder(tmp_path):
    return write_jpegs(tmp_path / "alps")


# Metadata


@EDITS
def test_a_label_stays_when_metadata_is_edited(folder, edit, capsys):
    label_named(folder, ["hill-1.jpg"], 11)
    edit(folder / "hill-1.jpg")
    assert statuses(folder)["hill-1.jpg"] == "accepted"
    edit(folder / "hill-1.jpg")
    assert rows_of(folder) == {"hill-1": {11}}
    assert statuses(folder)["hill-1.jpg"] == "accepted"
    assert run("status", folder) == 0
    assert "not here" not in capsys.readouterr().err


@EVERY
def test_an_edited_photo_is_exported_in_every_format(folder, kind, tmp_path):
    label_named(folder, ["hill-1.jpg"], 11)
    with_comment(folder / "hill-1.jpg")
    assert run("export", folder, "--format", kind, "--out", tmp_path / "out") == 0
    (found,) = import_labels(tmp_path / "out", folder, [f"hill-{n}.jpg" for n in range(3)], kind)
    assert found.name == "hill-1.jpg"
    assert set(found.skyline.rows) == {11}


def test_a_photo_that_is_edited_and_renamed_keeps_its_label(folder):
    label_named(folder, ["hill-1.jpg"], 11)
    with_comment(folder / "hill-1.jpg")
    (folder / "day").mkdir()
    (folder / "hill-1.jpg").rename(folder / "day" / "view.jpg")
    assert statuses(folder) == {
        "day/view.jpg": "accepted",
        "hill-0.jpg": "to do",
        "hill-2.jpg": "to do",
    }
    assert rows_of(folder) == {"day__view": {11}}


def test_an_edited_copy_takes_over_when_the_first_one_goes(folder):
    label_named(folder, ["hill-1.jpg"], 11)
    (folder / "copies").mkdir()
    copy = folder / "copies" / "hill-1.jpg"
    shutil.copy(folder / "hill-1.jpg", copy)
    with_comment(copy)
    assert statuses(folder)["copies/hill-1.jpg"] == "to do"  # the first one is there
    (folder / "hill-1.jpg").unlink()
    assert statuses(folder)["copies/hill-1.jpg"] == "accepted"
    assert rows_of(folder) == {"copies__hill-1": {11}}


def test_a_copy_that_was_looked_at_takes_over_too(folder):
    label_named(folder, ["hill-1.jpg"], 11)
    shutil.copy(folder / "hill-1.jpg", folder / "copy.jpg")
    with_comment(folder / "copy.jpg")
    bench = workbench(folder)
    for photo in bench.photos:
        bench.session(photo).apply(Open(), -1)
    bench.close()
    (folder / "hill-1.jpg").unlink()
    assert statuses(folder)["copy.jpg"] == "accepted"
    assert rows_of(folder) == {"copy": {11}}


def test_edited_copies_are_two_photos_while_both_are_there(folder):
    label_named(folder, ["hill-1.jpg"], 11)
    shutil.copy(folder / "hill-1.jpg", folder / "hill-9.jpg")
    with_comment(folder / "hill-9.jpg")
    label_named(folder, ["hill-9.jpg"], 22)
    assert rows_of(folder) == {"hill-1": {11}, "hill-9": {22}}
    (folder / "hill-1.jpg").unlink()  # whose label must not take the place of the other one
    assert rows_of(folder) == {"hill-9": {22}}


# Another photo under the name


@EVERY
def test_another_photo_never_gets_the_label(folder, kind, tmp_path, capsys):
    label_named(folder, ["hill-0.jpg", "hill-1.jpg"], 11)
    before = pixel_digest(read_photo(folder / "hill-1.jpg"))
    replaced(folder / "hill-1.jpg", seed=7)
    assert statuses(folder)["hill-1.jpg"] == "to do"
    assert run("export", folder, "--format", kind, "--out", tmp_path / "out") == 0
    said = capsys.readouterr()
    assert "1 label in " in said.out
    assert "Not in it: 2 photos of the folder." in said.out
    assert "1 label belongs to a photo that is not here any more: hill-1.jpg (sha256 " in said.err
    found = import_labels(tmp_path / "out", folder, [f"hill-{n}.jpg" for n in range(3)], kind)
    assert [one.name for one in found] == ["hill-0.jpg"]
    for file in (tmp_path / "out").rglob("*"):
        if file.suffix in (".jpg", ".bmp") and "ground_truth" not in file.parts:
            assert pixel_digest(read_photo(file)) != before


@EVERY
def test_the_export_of_the_page_never_writes_it_either(folder, kind):
    label_named(folder, ["hill-0.jpg", "hill-1.jpg"], 11)
    with served(folder) as page:
        replaced(folder / "hill-1.jpg", seed=7)
        answer = page.get(f"/api/exports/{kind}")
        assert answer.status_code == 200
        whole = zipfile.ZipFile(io.BytesIO(answer.content))
        names = [name for name in whole.namelist() if name != "notes.txt"]
        assert not any("hill-1" in name for name in names)
        if kind in ("json", "coco", "cvat"):
            assert not any(b"hill-1" in whole.read(name) for name in names)
        assert "hill-1.jpg (sha256 " in whole.read("notes.txt").decode()


def test_the_new_photo_gets_its_own_label_and_that_is_what_leaves(folder, capsys):
    label_named(folder, ["hill-1.jpg"], 11)
    replaced(folder / "hill-1.jpg", seed=7)
    label_named(folder, ["hill-1.jpg"], 33)
    assert rows_of(folder) == {"hill-1": {33}}
    err = capsys.readouterr().err
    assert "several labels" not in err
    assert "1 label belongs to a photo that is not here any more: hill-1.jpg" in err


def test_the_old_photo_brings_its_label_back(folder):
    label_named(folder, ["hill-1.jpg"], 11)
    old = (folder / "hill-1.jpg").read_bytes()
    replaced(folder / "hill-1.jpg", seed=7)
    label_named(folder, ["hill-1.jpg"], 33)
    (folder / "old.jpg").write_bytes(old)
    assert rows_of(folder) == {"hill-1": {33}, "old": {11}}


def test_a_replacement_of_the_same_size_and_time_is_noticed(tmp_path):
    folder = tmp_path / "alps"
    folder.mkdir()
    for name, grey in (("a.ppm", 100), ("b.ppm", 200)):
        photo = np.full((48, 70), grey, np.uint8)
        photo[20:] = grey // 2
        (folder / name).write_bytes(b"P5 70 48 255\n" + photo.tobytes())
    label_named(folder, ["a.ppm"], 11)
    status = (folder / "a.ppm").stat()
    shutil.copyfile(folder / "b.ppm", folder / "a.ppm")
    os.utime(folder / "a.ppm", ns=(status.st_atime_ns, status.st_mtime_ns))
    assert (folder / "a.ppm").stat().st_size == status.st_size
    assert rows_of(folder) == {}


def test_swapped_names_swap_the_labels(folder):
    label_named(folder, ["hill-0.jpg"], 11)
    label_named(folder, ["hill-1.jpg"], 22)
    for old, new in (("hill-0.jpg", "x"), ("hill-1.jpg", "hill-0.jpg"), ("x", "hill-1.jpg")):
        (folder / old).rename(folder / new)
    assert rows_of(folder) == {"hill-0": {22}, "hill-1": {11}}


def test_agreement_compares_photos_that_are_there(folder, capsys):
    label_named(folder, ["hill-0.jpg", "hill-1.jpg"], 11)
    label_named(folder, ["hill-0.jpg", "hill-1.jpg"], 13, "bob")
    replaced(folder / "hill-1.jpg", seed=7)
    assert run("agreement", folder) == 0
    said = capsys.readouterr()
    assert "2 passes, 1 photo accepted in several of them\n" in said.out
    assert "hill-1.jpg (sha256 " in said.err


def test_learning_takes_photos_that_are_there(tmp_path):
    folder = write_jpegs(tmp_path / "alps", 10)
    label_named(folder, [f"hill-{number}.jpg" for number in range(10)], 11)
    with served(folder) as page:
        replaced(folder / "hill-1.jpg", seed=70)
        page.post("/api/learn", json={})
        answer = until(lambda: (now := page.get("/api/learn").json())["state"] != "running" and now)
    assert answer["detail"] == "learning needs 10 accepted photos, and there are 9."


# What it costs


def test_opening_a_folder_decodes_nothing(tmp_path, monkeypatch):
    folder = write_jpegs(tmp_path / "alps", 6)
    label_named(folder, ["hill-1.jpg"], 11)
    read = []

    def counted(path, **how):
        read.append(Path(path).name)
        return read_photo(path, **how)

    monkeypatch.setattr(identity, "read_photo", counted)
    monkeypatch.setattr(opened, "read_photo", counted)
    (folder / "hill-2.jpg").rename(folder / "hill-8.jpg")
    (folder / "hill-1.jpg").rename(folder / "hill-9.jpg")
    statuses(folder)
    assert read == []
    with_comment(folder / "hill-9.jpg")
    statuses(folder)
    assert read == ["hill-9.jpg"]
    statuses(folder)
    assert read == ["hill-9.jpg"]


# Whatever happens to the files


CHANGES = st.sampled_from(["comment", "replace", "rename", "swap", "delete", "copy", "back"])


@examples(25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(changes=st.lists(st.tuples(CHANGES, st.integers(0, 2), st.booleans()), max_size=8))
def test_a_label_leaves_only_with_the_pixels_it_was_made_on(tmp_path_factory, changes):
    folder = write_jpegs(tmp_path_factory.mktemp("photos") / "alps")
    made = {}
    for number, row in enumerate((11, 22, 33)):
        label_named(folder, [f"hill-{number}.jpg"], row)
        made[pixel_digest(read_photo(folder / f"hill-{number}.jpg"))] = row
    first = {path.name: path.read_bytes() for path in folder.glob("*.jpg")}
    for step, (change, number, look) in enumerate(changes):
        path = folder / f"hill-{number}.jpg"
        other = folder / f"hill-{(number + 1) % 3}.jpg"
        if change == "back":
            path.write_bytes(first[path.name])
        elif not path.exists():
            continue
        elif change == "comment":
            with_comment(path)
        elif change == "replace":
            replaced(path, seed=50 + step)
        elif change == "rename":
            path.rename(folder / f"z-{step}.jpg")
        elif change == "copy":
            shutil.copy(path, folder / f"y-{step}.jpg")
            with_comment(folder / f"y-{step}.jpg")
        elif change == "delete":
            path.unlink()
        elif other.exists():
            here, there = path.read_bytes(), other.read_bytes()
            path.write_bytes(there)
            other.write_bytes(here)
        if look:
            statuses(folder)
    left = rows_of(folder)
    pixels = {path.stem: pixel_digest(read_photo(path)) for path in folder.glob("*.jpg")}
    for stem, rows in left.items():
        assert rows == {made[pixels[stem]]}
    for there in set(pixels.values()) & set(made):  # none is lost, either
        assert made[there] in {row for rows in left.values() for row in rows}
