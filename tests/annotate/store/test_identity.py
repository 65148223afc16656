"""A label belongs to the pixels it was made on: never another photo, and metadata lose none."""

import csv
import io
import json
import os
import shutil
import sqlite3
import zipfile
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import annotate.store.identity as identity
import annotate.store.opened as opened
import annotate.store.photo_table as photo_table
from annotate.cli import main
from annotate.formats import FORMATS, import_labels
from annotate.store.contents import Contents
from annotate.store.database import NAME, StoreError
from annotate.store.identity import pixel_digest
from annotate.store.opened import ReplacedError, read_whole
from annotate.store.operations import Open, SetStatus, SetTag, Straight
from annotate.store.store import Store
from annotate.work.joined import joined
from skyline_viz.photo import PhotoError, read_photo
from testing.edited_photos import replaced, with_comment, with_place, write_jpegs
from testing.labelling import served, workbench

EVERY = pytest.mark.parametrize("kind", list(FORMATS))
EDITS = pytest.mark.parametrize("edit", [with_comment, with_place])


def run(*words):
    return main([str(word) for word in words])


def label(folder, names, row, annotator="ann"):
    """Accept a level line on some photos."""
    bench = workbench(folder, annotator)
    for photo in bench.photos.values():
        if photo.name in names:
            session = bench.session(photo.id)
            session.apply(Straight(column=0, row=row, to_column=69, to_row=row), -1)
            session.apply(SetStatus(status="accepted"), -1)
    bench.close()


def statuses(folder, annotator="ann"):
    """Status of each photo, as the page lists it."""
    bench = workbench(folder, annotator)
    found = {card.photo.name: card.status for card in bench.cards()}
    bench.close()
    return found


def rows_of(folder, annotator="ann"):
    """Rows of the labels that an export as CSV holds, by the stem of the photo."""
    out = folder.parent / "rows"
    shutil.rmtree(out, ignore_errors=True)
    if run("export", folder, "--out", out, "--annotator", annotator):
        return {}
    found = {}
    for file in out.glob("*.csv"):
        with file.open(newline="") as text:
            found[file.stem] = {int(float(line["row"])) for line in csv.DictReader(text)}
    return found


@pytest.fixture
def folder(tmp_path):
    return write_jpegs(tmp_path / "alps")


# Metadata


@EDITS
def test_a_label_stays_when_metadata_is_edited(folder, edit, capsys):
    label(folder, ["hill-1.jpg"], 11)
    edit(folder / "hill-1.jpg")
    assert statuses(folder)["hill-1.jpg"] == "accepted"
    edit(folder / "hill-1.jpg")
    assert rows_of(folder) == {"hill-1": {11}}
    assert statuses(folder)["hill-1.jpg"] == "accepted"
    assert run("status", folder) == 0
    assert "not here" not in capsys.readouterr().err


@EVERY
def test_an_edited_photo_is_exported_in_every_format(folder, kind, tmp_path):
    label(folder, ["hill-1.jpg"], 11)
    with_comment(folder / "hill-1.jpg")
    assert run("export", folder, "--format", kind, "--out", tmp_path / "out") == 0
    (found,) = import_labels(tmp_path / "out", folder, [f"hill-{n}.jpg" for n in range(3)], kind)
    assert found.name == "hill-1.jpg"
    assert set(found.skyline.rows) == {11}


def test_metadata_may_be_edited_while_a_photo_is_open(folder):
    bench = workbench(folder)
    photo = next(one for one in bench.photos.values() if one.name == "hill-1.jpg")
    session = bench.session(photo.id)
    with_comment(folder / "hill-1.jpg")
    session.apply(SetStatus(status="accepted"), -1)
    with_comment(folder / "hill-1.jpg")
    session.apply(SetTag(tag="fog"), -1)
    assert bench.store.is_here(photo)
    bench.close()
    assert statuses(folder)["hill-1.jpg"] == "accepted"


def test_a_photo_that_is_edited_and_renamed_keeps_its_label(folder):
    label(folder, ["hill-1.jpg"], 11)
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
    label(folder, ["hill-1.jpg"], 11)
    (folder / "copies").mkdir()
    copy = folder / "copies" / "hill-1.jpg"
    shutil.copy(folder / "hill-1.jpg", copy)
    with_comment(copy)
    assert statuses(folder)["copies/hill-1.jpg"] == "to do"  # the first one is there
    (folder / "hill-1.jpg").unlink()
    assert statuses(folder)["copies/hill-1.jpg"] == "accepted"
    assert rows_of(folder) == {"copies__hill-1": {11}}


def test_a_copy_that_was_looked_at_takes_over_too(folder):
    label(folder, ["hill-1.jpg"], 11)
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
    label(folder, ["hill-1.jpg"], 11)
    shutil.copy(folder / "hill-1.jpg", folder / "hill-9.jpg")
    with_comment(folder / "hill-9.jpg")
    label(folder, ["hill-9.jpg"], 22)
    assert rows_of(folder) == {"hill-1": {11}, "hill-9": {22}}
    (folder / "hill-1.jpg").unlink()  # whose label must not take the place of the other one
    assert rows_of(folder) == {"hill-9": {22}}


# Another photo under the name


@EVERY
def test_another_photo_never_gets_the_label(folder, kind, tmp_path, capsys):
    label(folder, ["hill-0.jpg", "hill-1.jpg"], 11)
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
    label(folder, ["hill-0.jpg", "hill-1.jpg"], 11)
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
    label(folder, ["hill-1.jpg"], 11)
    replaced(folder / "hill-1.jpg", seed=7)
    label(folder, ["hill-1.jpg"], 33)
    assert rows_of(folder) == {"hill-1": {33}}
    err = capsys.readouterr().err
    assert "several labels" not in err
    assert "1 label belongs to a photo that is not here any more: hill-1.jpg" in err


def test_the_old_photo_brings_its_label_back(folder):
    label(folder, ["hill-1.jpg"], 11)
    old = (folder / "hill-1.jpg").read_bytes()
    replaced(folder / "hill-1.jpg", seed=7)
    label(folder, ["hill-1.jpg"], 33)
    (folder / "old.jpg").write_bytes(old)
    assert rows_of(folder) == {"hill-1": {33}, "old": {11}}


def test_a_replacement_of_the_same_size_and_time_is_noticed(tmp_path):
    folder = tmp_path / "alps"
    folder.mkdir()
    for name, grey in (("a.ppm", 100), ("b.ppm", 200)):
        photo = np.full((48, 70), grey, np.uint8)
        photo[20:] = grey // 2
        (folder / name).write_bytes(b"P5 70 48 255\n" + photo.tobytes())
    label(folder, ["a.ppm"], 11)
    status = (folder / "a.ppm").stat()
    shutil.copyfile(folder / "b.ppm", folder / "a.ppm")
    os.utime(folder / "a.ppm", ns=(status.st_atime_ns, status.st_mtime_ns))
    assert (folder / "a.ppm").stat().st_size == status.st_size
    assert rows_of(folder) == {}


def test_swapped_names_swap_the_labels(folder):
    label(folder, ["hill-0.jpg"], 11)
    label(folder, ["hill-1.jpg"], 22)
    for old, new in (("hill-0.jpg", "x"), ("hill-1.jpg", "hill-0.jpg"), ("x", "hill-1.jpg")):
        (folder / old).rename(folder / new)
    assert rows_of(folder) == {"hill-0": {22}, "hill-1": {11}}


def test_agreement_compares_photos_that_are_there(folder, capsys):
    label(folder, ["hill-0.jpg", "hill-1.jpg"], 11)
    label(folder, ["hill-0.jpg", "hill-1.jpg"], 13, "bob")
    replaced(folder / "hill-1.jpg", seed=7)
    assert run("agreement", folder) == 0
    said = capsys.readouterr()
    assert "ann and bob, 1 photo\n" in said.out
    assert "hill-1.jpg (sha256 " in said.err


def test_learning_takes_photos_that_are_there(tmp_path):
    folder = write_jpegs(tmp_path / "alps", 10)
    label(folder, [f"hill-{number}.jpg" for number in range(10)], 11)
    with served(folder) as page:
        replaced(folder / "hill-1.jpg", seed=70)
        page.post("/api/learn", json={})
        while (answer := page.get("/api/learn").json())["state"] == "running":
            pass
    assert answer["detail"] == "learning needs 10 accepted photos, and there are 9."


# Replaced while it is open


def test_a_photo_that_is_replaced_while_it_is_open_is_noticed_before_anything_is_kept(folder):
    with served(folder) as page:
        photos = {one["name"]: one["id"] for one in page.get("/api/photos").json()["photos"]}
        at = f"/api/photos/{photos['hill-1.jpg']}"
        before = page.get(at).json()
        replaced(folder / "hill-1.jpg", seed=7)
        for number, operation in enumerate(
            [
                {"kind": "anchor", "column": 3, "row": 5},
                {"kind": "status", "status": "accepted"},
                {"kind": "tag", "tag": "fog"},
            ]
        ):
            body = {"id": f"id-{number}", "revision": before["revision"], "operation": operation}
            answer = page.post(f"{at}/operations", json=body)
            assert answer.status_code == 410
            assert "another photo" in answer.json()["detail"]
        listed = {one["name"]: one for one in page.get("/api/photos").json()["photos"]}
        assert listed["hill-1.jpg"]["missing"]
        assert listed["hill-1.jpg"]["status"] == "to do"
        assert not listed["hill-0.jpg"]["missing"]
        for what in ("", "/image", "/thumbnail", "/strip", "/tiles/0/0"):
            assert page.get(at + what).status_code == 410
    assert statuses(folder) == dict.fromkeys(["hill-0.jpg", "hill-1.jpg", "hill-2.jpg"], "to do")


def test_a_photo_that_vanishes_while_it_is_open_takes_nothing_more(folder):
    bench = workbench(folder)
    photo = next(one for one in bench.photos.values() if one.name == "hill-1.jpg")
    session = bench.session(photo.id)
    kept = (folder / "hill-1.jpg").read_bytes()
    (folder / "hill-1.jpg").unlink()
    with pytest.raises(PhotoError, match="not there any more"):
        session.apply(SetStatus(status="accepted"), -1)
    (folder / "hill-1.jpg").write_bytes(kept)
    session.apply(SetStatus(status="accepted"), -1)
    bench.close()
    assert statuses(folder)["hill-1.jpg"] == "accepted"


def test_pixels_are_those_of_the_photo_or_none(folder):
    store = Store(folder)
    photo = next(one for one in store.find() if one.name == "hill-1.jpg")
    assert read_whole(store, photo).shape == (48, 70, 3)
    replaced(folder / "hill-1.jpg", seed=7)
    with pytest.raises(ReplacedError, match=r"hill-1\.jpg is another photo now"):
        read_whole(store, photo)
    assert not store.is_here(photo)
    store.close()


def test_a_folder_that_is_away_for_a_while_is_no_photo_that_has_vanished(folder):
    bench = workbench(folder)
    photo = next(one for one in bench.photos.values() if one.name == "hill-1.jpg")
    session = bench.session(photo.id)
    away = folder.rename(folder.parent / "away")
    with pytest.raises(StoreError, match="moved, removed or replaced"):
        session.apply(SetStatus(status="accepted"), -1)
    away.rename(folder)
    session.apply(SetStatus(status="accepted"), -1)
    bench.close()
    assert statuses(folder)["hill-1.jpg"] == "accepted"


def test_a_photo_that_is_being_written_is_waited_for(folder):
    with served(folder) as page:
        photos = {one["name"]: one["id"] for one in page.get("/api/photos").json()["photos"]}
        at = f"/api/photos/{photos['hill-1.jpg']}"
        revision = page.get(at).json()["revision"]
        whole = (folder / "hill-1.jpg").read_bytes()
        operation = {"kind": "status", "status": "rejected"}
        body = {"id": "id-1", "revision": revision, "operation": operation}
        (folder / "hill-1.jpg").write_bytes(whole[: len(whole) // 2])
        assert page.post(f"{at}/operations", json=body).status_code == 503
        os.utime(folder / "hill-1.jpg", (1, 1))  # it has been so for long: it is damaged
        assert page.post(f"{at}/operations", json=body).status_code == 410
        (folder / "hill-1.jpg").write_bytes(whole)
        assert page.post(f"{at}/operations", json=body).status_code == 200


# What it costs


def test_opening_a_folder_decodes_nothing(tmp_path, monkeypatch):
    folder = write_jpegs(tmp_path / "alps", 6)
    label(folder, ["hill-1.jpg"], 11)
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


def test_labels_of_an_older_version_learn_their_pixels_once(folder, monkeypatch):
    label(folder, ["hill-1.jpg"], 11)
    with closing(sqlite3.connect(folder / NAME)) as labels, labels:
        labels.execute("UPDATE photos SET pixels = NULL, touched = NULL")
    Store(folder, reading=True).close()
    bench = workbench(folder)
    bench.close()
    with_comment(folder / "hill-1.jpg")
    assert statuses(folder)["hill-1.jpg"] == "accepted"


def test_known_bytes_are_the_photo_whatever_their_pixels_are_read_as(folder, monkeypatch):
    label(folder, ["hill-1.jpg"], 11)
    with closing(sqlite3.connect(folder / NAME)) as labels, labels:
        labels.execute("UPDATE photos SET pixels = 'of another decoder' WHERE pixels IS NOT NULL")
    assert rows_of(folder) == {"hill-1": {11}}
    bench = workbench(folder)
    for photo in bench.photos:
        bench.session(photo)
    bench.close()
    with_comment(folder / "hill-1.jpg")
    assert rows_of(folder) == {"hill-1": {11}}


# Orphans


def test_orphans_are_listed_and_leave_under_their_own_names(folder, tmp_path, capsys):
    label(folder, ["hill-0.jpg", "hill-1.jpg", "hill-2.jpg"], 11)
    replaced(folder / "hill-1.jpg", seed=7)
    (folder / "hill-2.jpg").unlink()
    assert run("status", folder, "--orphans") == 0
    said = capsys.readouterr()
    assert [line.split(" ")[0] for line in said.out.splitlines()[-2:]] == [
        "hill-1.jpg",
        "hill-2.jpg",
    ]
    assert "2 labels belong to photos that are not here any more: hill-1.jpg (sha256" in said.err
    out = tmp_path / "csv"
    assert run("export", folder, "--orphans", "--out", out) == 0
    names = sorted(file.name for file in out.iterdir())
    assert names[0].startswith("hill-1.sha256-")  # hill-1 is another photo's now
    assert names[1] == "hill-2.csv"
    for kind in FORMATS:
        if kind not in ("csv", "json"):
            assert run("export", folder, "--orphans", "--format", kind, "--out", "x") == 2
            assert f"leave as csv and json only, not as {kind}" in capsys.readouterr().err
    out = tmp_path / "json"
    assert run("export", folder, "--orphans", "--format", "json", "--out", out) == 0
    document = json.loads((out / "labels.json").read_text())
    assert [one["name"] for one in document["labels"]] == ["hill-1.jpg", "hill-2.jpg"]
    assert run("import", folder, out, "--annotator", "eve") == 2
    assert "not in" in capsys.readouterr().err


def test_no_orphans_is_a_sentence(folder, tmp_path, capsys):
    label(folder, ["hill-0.jpg"], 11)
    assert run("export", folder, "--orphans", "--out", tmp_path / "out") == 2
    assert "the photos of all labels of ann, pass 1, are there." in capsys.readouterr().err


def test_photos_that_were_only_looked_at_are_no_orphans(folder, capsys):
    bench = workbench(folder)
    for photo in bench.photos:
        bench.session(photo)
    bench.close()
    (folder / "hill-2.jpg").unlink()
    assert run("status", folder) == 0
    assert capsys.readouterr().err == ""


# Import


def exported(folder, tmp_path):
    out = tmp_path / "labels"
    assert run("export", folder, "--format", "json", "--out", out) == 0
    return out / "labels.json"


def test_labels_carry_both_digests(folder, tmp_path):
    label(folder, ["hill-1.jpg"], 11)
    (told,) = json.loads(exported(folder, tmp_path).read_text())["labels"]
    assert told["digest"] == identity.file_digest(folder / "hill-1.jpg")
    assert told["pixels"] == pixel_digest(read_photo(folder / "hill-1.jpg"))


def test_import_goes_by_content_and_not_by_name(folder, tmp_path, capsys):
    label(folder, ["hill-0.jpg", "hill-1.jpg", "hill-2.jpg"], 11)
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
    label(folder, ["hill-1.jpg"], 11)
    file = exported(folder, tmp_path)
    document = json.loads(file.read_text())
    document["labels"][0] |= {"digest": "", "pixels": ""}
    file.write_text(json.dumps(document))
    other = write_jpegs(tmp_path / "other")
    replaced(other / "hill-1.jpg", seed=7)
    assert run("import", other, file) == 0
    assert rows_of(other) == {"hill-1": {11}}


def test_an_imported_label_follows_metadata(folder, tmp_path):
    label(folder, ["hill-1.jpg"], 11)
    file = exported(folder, tmp_path)
    other = write_jpegs(tmp_path / "other")
    assert run("import", other, file) == 0
    with_comment(other / "hill-1.jpg")
    assert rows_of(other) == {"hill-1": {11}}


def test_contents_know_photos_by_bytes_and_by_pixels(folder):
    label(folder, ["hill-1.jpg"], 11)
    store = Store(folder, reading=True)
    (told,) = joined(store).labels
    store.close()
    (folder / "hill-1.jpg").rename(folder / "a.jpg")
    assert Contents(folder, ["a.jpg", "hill-0.jpg"]).name_of(told) == "a.jpg"
    with_comment(folder / "a.jpg")
    assert Contents(folder, ["a.jpg", "hill-0.jpg"]).name_of(told) == "a.jpg"
    assert Contents(folder, ["hill-0.jpg", "gone.jpg"]).name_of(told) is None


# Whatever happens to the files


CHANGES = st.sampled_from(["comment", "replace", "rename", "swap", "delete", "copy", "back"])


@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(changes=st.lists(st.tuples(CHANGES, st.integers(0, 2), st.booleans()), max_size=8))
def test_a_label_leaves_only_with_the_pixels_it_was_made_on(tmp_path_factory, changes):
    folder = write_jpegs(tmp_path_factory.mktemp("photos") / "alps")
    made = {}
    for number, row in enumerate((11, 22, 33)):
        label(folder, [f"hill-{number}.jpg"], row)
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


def test_the_table_of_photos_keeps_no_stamp_of_a_file_that_may_still_change(folder):
    stamp = identity.Stamp.of((folder / "hill-0.jpg").stat())
    assert not stamp.settled
    assert photo_table._stamp(stamp)[2] == 0
