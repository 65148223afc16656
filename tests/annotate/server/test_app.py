"""The labelling server through real requests: what it does, and whom it refuses."""

import io
import zipfile

import cv2
import numpy as np
import pytest

from annotate.store.database import StoreError
from annotate.store.operations import Draw, SetAnchor, SetTag
from annotate.store.store import Store
from testing.labelling import asked, done, hills, served, workbench, write_hills


def test_labelling_a_photo_from_proposal_to_acceptance(fresh):
    before = fresh.get("/api/photos/1").json()
    assert before["revision"] == 0
    assert len(before["rows"]) == before["width"] == 70
    other = before["rows"][35] + 12
    shown = fresh.post("/api/photos/1/preview", json={"column": 35, "row": other}).json()
    after = done(fresh, 1, {"kind": "anchor", "column": 35, "row": other}, 0).json()
    assert after["rows"][35] == other
    first, rows = shown["first"], shown["rows"]
    assert after["rows"][first : first + len(rows)] == rows
    assert after["rows"][:first] == before["rows"][:first]
    assert after["status"] == "in progress"
    undone = fresh.post("/api/photos/1/undo", json=asked(after["revision"])).json()
    assert undone["rows"] == before["rows"]
    assert undone["can_redo"]
    redone = fresh.post("/api/photos/1/redo", json=asked(undone["revision"])).json()
    assert redone["rows"] == after["rows"]
    done(fresh, 1, {"kind": "tag", "tag": "needs terrain data", "on": True})
    accepted = done(fresh, 1, {"kind": "status", "status": "accepted"}).json()
    assert (accepted["status"], accepted["tags"]) == ("accepted", ["needs terrain data"])
    assert fresh.get("/api/photos").json()["progress"]["done"] == 1


def test_what_was_acknowledged_is_there_after_a_restart(tmp_path):
    folder = write_hills(tmp_path)
    with served(folder) as client:
        done(client, 1, {"kind": "anchor", "column": 20, "row": 40})
        done(client, 1, {"kind": "forbid", "points": [[50, 30], [60, 30]], "radius": 3})
        done(client, 1, {"kind": "hidden", "first": 0, "last": 5})
        done(client, 1, {"kind": "straight", "column": 30, "row": 9, "to_column": 36, "to_row": 12})
        kept = done(client, 1, {"kind": "drawn", "first": 64, "rows": [7, 8, 9]}).json()
        assert kept["forbidden"] == [{"points": [[50, 30], [60, 30]], "radius": 3, "allow": False}]
        assert kept["hidden"] == [[0, 5, ""]]
        assert kept["rows"][64:67] == [7, 8, 9]
    with served(folder) as client:
        assert client.get("/api/photos/1").json() == {**kept, "kept": None}
        undone = client.post("/api/photos/1/undo", json=asked(kept["revision"])).json()
        assert [span["kind"] for span in undone["spans"]] == ["straight"]


def test_an_old_revision_is_refused(fresh):
    first = done(fresh, 1, {"kind": "anchor", "column": 20, "row": 40}, 0)
    second = done(fresh, 1, {"kind": "anchor", "column": 30, "row": 40}, 0)
    assert second.status_code == 409
    assert "another tab" in second.json()["detail"]
    assert second.json()["revision"] == first.json()["revision"]
    assert fresh.get("/api/photos/1").json() == {**first.json(), "kept": None}


def test_margins_point_at_uncertain_columns(client):
    said = client.get("/api/photos/3/margins").json()
    margins = np.array(said["margins"], float)
    assert margins[said["uncertain"][0]] == margins.min()
    assert np.all(np.diff(sorted(said["uncertain"])) >= 3)


def test_blind_photos_show_nothing_of_the_detector(tmp_path):
    with served(write_hills(tmp_path), blind=1.0) as client:
        said = client.get("/api/photos/1").json()
        assert said["blind"]
        assert said["rows"] is None
        assert client.get("/api/photos/1/stages/score").status_code == 403
        assert client.get("/api/photos/1/strip").status_code == 422
        drawn = done(client, 1, {"kind": "anchor", "column": 5, "row": 11}).json()
        assert set(drawn["rows"]) == {11}
        assert drawn["origins"]["proposal"] == 0


def test_a_photo_that_vanishes_is_a_sentence_and_loses_nothing(tmp_path):
    folder = write_hills(tmp_path)
    with served(folder) as client:
        done(client, 1, {"kind": "anchor", "column": 20, "row": 40})
        (folder / "hill-1.png").unlink()
        gone = client.get("/api/photos/2")
        assert gone.status_code == 410
        assert "hill-1.png" in gone.json()["detail"]
        assert client.get("/api/photos").json()["photos"][1]["missing"]
        assert client.get("/api/photos/1").json()["anchors"] == [[20, 40]]


def test_a_full_disk_is_a_sentence_and_changes_nothing(tmp_path):
    bench = workbench(write_hills(tmp_path, count=1))
    session = bench.session(1)
    before = session.wire.skyline
    pages = bench.store._connection.execute("PRAGMA page_count").fetchone()[0]
    bench.store._connection.execute(f"PRAGMA max_page_count = {pages}")
    tag = "x" * 80
    with pytest.raises(StoreError, match=r"the disk is full, so nothing was added to .*sqlite\.$"):
        for number in range(200):
            kept = bench.store.state(session.label)
            session.apply(SetTag(tag=f"{number}{tag}"[:80], on=True), -1)
    with pytest.raises(StoreError, match="disk is full"):
        for column in range(70):
            kept, before = bench.store.state(session.label), session.wire.skyline
            session.apply(Draw(first=0, rows=[column % 40] * 70), -1)
    assert session.wire.skyline == before
    again = bench.store.state(session.label)
    assert (again.revision, again.tags, again.edits) == (kept.revision, kept.tags, kept.edits)
    bench.store._connection.execute("PRAGMA max_page_count = 100000")
    session.apply(SetAnchor(column=20, row=40), -1)
    assert session.wire.skyline.rows[20] == 40
    bench.close()


def test_a_moved_folder_finds_its_labels(tmp_path):
    folder = write_hills(tmp_path / "before")
    with served(folder) as client:
        kept = done(client, 1, {"kind": "anchor", "column": 20, "row": 40}).json()
    moved = tmp_path / "after"
    folder.rename(moved)
    (moved / "hill-0.png").rename(moved / "zzz.png")
    with served(moved) as client:
        photos = client.get("/api/photos").json()["photos"]
        assert [photo["name"] for photo in photos] == ["hill-1.png", "hill-2.png", "zzz.png"]
        found = client.get(f"/api/photos/{photos[2]['id']}").json()
        assert found["anchors"] == kept["anchors"]
        assert found["rows"] == kept["rows"]


@pytest.mark.parametrize(
    "route",
    [
        "/static/../server.py",
        "/static/%2e%2e/server.py",
        "/static/..%2f..%2fpyproject.toml",
        "/api/photos/..%2f1",
        "/api/photos/0",
        "/api/photos/99",
        "/api/photos/-1/image",
        "/api/photos/1e3",
        "/api/photos/99999999999999999999",
        "/api/photos/1/tiles/-1/0",
        "/api/photos/1/stages/..%2f..",
        "/api/photos/1/strip?width=100000",
        "/api/exports/..%2fcsv",
        "/api/sheet",
    ],
)
def test_strange_addresses_are_refused(client, route):
    said = client.get(route)
    assert 400 <= said.status_code < 500
    assert said.json()["detail"].endswith(".")


def test_hostile_names_are_shown_as_text(tmp_path):
    folder = write_hills(tmp_path, count=1)
    names = ["<script>alert(1)<.png", "new\nline.png", "x" * 251 + ".png", "b\\c'\";--.png"]
    for number, name in enumerate(names):
        (folder / name).write_bytes(cv2.imencode(".png", hills(number + 5)[..., ::-1])[1].tobytes())
    with served(folder) as client:
        photos = client.get("/api/photos").json()["photos"]
        assert {photo["name"] for photo in photos} == {*names, "hill-0.png"}
        for photo in photos:
            assert client.get(f"/api/photos/{photo['id']}").json()["name"] == photo["name"]
            done(client, photo["id"], {"kind": "status", "status": "accepted"})
            thumbnail = client.get(f"/api/photos/{photo['id']}/thumbnail")
            assert thumbnail.headers["content-type"] == "image/jpeg"
        for kind in ("csv", "labelme", "cvat", "coco", "json", "ch1", "painted", "parquet"):
            with zipfile.ZipFile(io.BytesIO(client.get(f"/api/exports/{kind}").content)) as archive:
                for name in archive.namelist():
                    assert not name.startswith("/")
                    assert ".." not in name.split("/")


def test_a_name_that_is_no_text_is_left_out(tmp_path):
    folder = write_hills(tmp_path, count=1)
    (tmp_path / "bad\udcff.png").write_bytes((folder / "hill-0.png").read_bytes())
    store = Store(folder)
    assert [photo.name for photo in store.find()] == ["hill-0.png"]
    assert any("no text" in problem for problem in store.problems)
    store.close()
