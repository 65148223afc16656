"""A photo that is open: replaced, edited, gone for a while, or still being written."""

import os

import pytest

from annotate.store.database import StoreError
from annotate.store.opened import ReplacedError, read_whole
from annotate.store.operations import SetStatus, SetTag
from annotate.store.store import Store
from skyline_viz.photo import PhotoError
from testing.edited_photos import replaced, with_comment, write_jpegs
from testing.labelling import served, workbench
from testing.labels import statuses


@pytest.fixture
def folder(tmp_path):
    return write_jpegs(tmp_path / "alps")


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
