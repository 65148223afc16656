"""The labelling server through real requests: what it does, and whom it refuses."""

import asyncio
import io
import zipfile

import cv2
import numpy as np
import pytest

from annotate.server.security import PASS_HEADER, Guard
from annotate.store.database import StoreError
from annotate.store.operations import Draw, SetAnchor, SetTag
from annotate.store.store import Store
from skyline_viz.photo import read_photo
from testing.labelling import TOKEN, asked, hills, served, workbench, write_hills

ROUTES = [
    ("GET", "/"),
    ("GET", "/api/photos"),
    ("GET", "/api/photos/1"),
    ("GET", "/api/photos/1/margins"),
    ("GET", "/api/photos/1/image"),
    ("GET", "/api/photos/1/thumbnail"),
    ("GET", "/api/photos/1/tiles/0/0"),
    ("GET", "/api/photos/1/stages/edges"),
    ("GET", "/api/photos/1/strip"),
    ("GET", "/api/photos/1/alternatives/3"),
    ("GET", "/api/sheet"),
    ("GET", "/api/learn"),
    ("GET", "/api/exports/csv"),
    ("GET", "/api/openapi.json"),
    ("POST", "/api/photos/1/preview"),
    ("POST", "/api/photos/1/operations"),
    ("POST", "/api/photos/1/undo"),
    ("POST", "/api/photos/1/redo"),
    ("GET", "/api/photos/1/recording"),
    ("POST", "/api/learn"),
    ("GET", "/api/nothing"),
    ("GET", "/static/index.html"),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_hills(tmp_path_factory.mktemp("photos"))


@pytest.fixture(scope="module")
def client(folder):
    with served(folder) as client:
        yield client


@pytest.fixture
def fresh(tmp_path):
    with served(write_hills(tmp_path / "photos")) as client:
        yield client


def do(client, photo, operation, revision=-1):
    body = asked(revision, operation=operation)
    return client.post(f"/api/photos/{photo}/operations", json=body)


def picture(response):
    assert response.status_code == 200
    return cv2.imdecode(np.frombuffer(response.content, np.uint8), cv2.IMREAD_UNCHANGED)


def test_the_list_has_all_photos(client):
    said = client.get("/api/photos").json()
    assert [photo["name"] for photo in said["photos"]] == [f"hill-{n}.png" for n in range(3)]
    assert {photo["status"] for photo in said["photos"]} == {"to do"}
    assert said["progress"] == {
        "done": 0,
        "total": 3,
        "seconds_a_photo": None,
        "seconds_left": None,
    }


def test_labelling_a_photo_from_proposal_to_acceptance(fresh):
    before = fresh.get("/api/photos/1").json()
    assert before["revision"] == 0
    assert len(before["rows"]) == before["width"] == 70
    other = fresh.get("/api/photos/1/alternatives/35").json()["alternatives"][0]["row"]
    shown = fresh.post("/api/photos/1/preview", json={"column": 35, "row": other}).json()
    after = do(fresh, 1, {"kind": "anchor", "column": 35, "row": other}, 0).json()
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
    do(fresh, 1, {"kind": "tag", "tag": "needs terrain data", "on": True})
    accepted = do(fresh, 1, {"kind": "status", "status": "accepted"}).json()
    assert (accepted["status"], accepted["tags"]) == ("accepted", ["needs terrain data"])
    assert fresh.get("/api/photos").json()["progress"]["done"] == 1


def test_what_was_acknowledged_is_there_after_a_restart(tmp_path):
    folder = write_hills(tmp_path)
    with served(folder) as client:
        do(client, 1, {"kind": "anchor", "column": 20, "row": 40})
        do(client, 1, {"kind": "forbid", "points": [[50, 30], [60, 30]], "radius": 3})
        do(client, 1, {"kind": "hidden", "first": 0, "last": 5})
        do(client, 1, {"kind": "straight", "column": 30, "row": 9, "to_column": 36, "to_row": 12})
        kept = do(client, 1, {"kind": "drawn", "first": 64, "rows": [7, 8, 9]}).json()
        assert kept["forbidden"] == [{"points": [[50, 30], [60, 30]], "radius": 3, "allow": False}]
        assert kept["hidden"] == [[0, 5]]
        assert kept["rows"][64:67] == [7, 8, 9]
    with served(folder) as client:
        assert client.get("/api/photos/1").json() == {**kept, "kept": None}
        undone = client.post("/api/photos/1/undo", json=asked(kept["revision"])).json()
        assert [span["kind"] for span in undone["spans"]] == ["straight"]


def test_an_old_revision_is_refused(fresh):
    first = do(fresh, 1, {"kind": "anchor", "column": 20, "row": 40}, 0)
    second = do(fresh, 1, {"kind": "anchor", "column": 30, "row": 40}, 0)
    assert second.status_code == 409
    assert "another tab" in second.json()["detail"]
    assert second.json()["revision"] == first.json()["revision"]
    assert fresh.get("/api/photos/1").json() == {**first.json(), "kept": None}


def test_pictures_show_the_photo(client, folder):
    photo = read_photo(folder / "hill-1.png")
    whole = picture(client.get("/api/photos/2/image"))
    np.testing.assert_array_equal(whole[..., ::-1], photo)
    part = picture(client.get("/api/photos/2/tiles/0/0"))
    np.testing.assert_array_equal(part[..., ::-1], photo)
    assert client.get("/api/photos/2/tiles/1/0").status_code == 404
    strip = picture(client.get("/api/photos/2/strip?width=70"))
    rows = client.get("/api/photos/2").json()["rows"]
    assert strip.shape == (81, 70, 3)
    for column in (0, 33, 69):
        np.testing.assert_array_equal(strip[40, column, ::-1], photo[rows[column], column])
    for stage in ("edges", "strength", "coherence", "orientation", "bin", "score", "cost"):
        layer = picture(client.get(f"/api/photos/2/stages/{stage}"))
        assert layer.shape == (48, 70, 4)
        assert layer[..., 3].any()


def test_large_photos_are_seen_reduced_and_in_exact_tiles(tmp_path):
    folder = write_hills(tmp_path, count=1, height=1400, width=2400)
    with served(folder) as client:
        assert picture(client.get("/api/photos/1/image")).shape == (1195, 2048, 3)
        part = picture(client.get("/api/photos/1/tiles/4/2"))
        expected = hills(0, 1400, 2400)[1024:, 2048:]
        np.testing.assert_array_equal(part[..., ::-1], expected)


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
        drawn = do(client, 1, {"kind": "anchor", "column": 5, "row": 11}).json()
        assert set(drawn["rows"]) == {11}
        assert drawn["origins"]["proposal"] == 0


def test_a_sheet_is_a_page_of_photos(client):
    said = client.get("/api/sheet", params={"status": "to do"}).json()
    assert said["pages"] == 1
    assert len(said["photos"]) == 3
    assert client.get("/api/sheet", params={"status": "rejected"}).json()["photos"] == []


def test_exporting_what_was_accepted(fresh):
    said = fresh.get("/api/exports/mask")
    assert said.status_code == 422
    assert "nothing to export" in said.json()["detail"]
    do(fresh, 2, {"kind": "status", "status": "accepted"})
    said = fresh.get("/api/exports/mask")
    with zipfile.ZipFile(io.BytesIO(said.content)) as archive:
        assert archive.namelist() == ["masks/hill-1.png"]
    assert said.headers["content-type"] == "application/zip"


def test_a_photo_that_vanishes_is_a_sentence_and_loses_nothing(tmp_path):
    folder = write_hills(tmp_path)
    with served(folder) as client:
        do(client, 1, {"kind": "anchor", "column": 20, "row": 40})
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
        kept = do(client, 1, {"kind": "anchor", "column": 20, "row": 40}).json()
    moved = tmp_path / "after"
    folder.rename(moved)
    (moved / "hill-0.png").rename(moved / "zzz.png")
    with served(moved) as client:
        photos = client.get("/api/photos").json()["photos"]
        assert [photo["name"] for photo in photos] == ["hill-1.png", "hill-2.png", "zzz.png"]
        found = client.get(f"/api/photos/{photos[2]['id']}").json()
        assert found["anchors"] == kept["anchors"]
        assert found["rows"] == kept["rows"]


@pytest.mark.parametrize(("method", "route"), ROUTES)
class TestRefusals:
    def test_another_host(self, client, method, route):
        for host in ("evil.example", "127.0.0.1", "127.0.0.1:1", ""):
            said = client.request(method, route, headers={"Host": host}, params={"token": TOKEN})
            assert said.status_code in (400, 421)
            assert "hill" not in said.text

    def test_no_token(self, client, method, route):
        code_of_the_page = route == "/" or route.startswith("/static")  # is no secret
        for token in ("", "wrong", TOKEN + "x"):
            said = client.request(
                method, route, headers={"X-Skyline-Token": token}, params={"token": token}
            )
            assert said.status_code == (200 if code_of_the_page else 401)
            assert code_of_the_page or "token" in said.json()["detail"]

    def test_another_origin(self, client, method, route):
        here = str(client.base_url).removeprefix("http://").rstrip("/")
        for origin in (
            "http://evil.example",
            "null",
            "https://127.0.0.1",
            "file://",
            f"https://{here}",
            f"ws://{here}",
            here,
        ):
            said = client.request(method, route, headers={"Origin": origin})
            assert said.status_code == 403

    def test_another_pass(self, client, method, route):
        shown = client.request(method, route).headers[PASS_HEADER]
        said = client.request(method, route, headers={PASS_HEADER: "another"})
        assert said.status_code == 412
        assert said.headers[PASS_HEADER] == shown
        assert client.request(method, route, headers={PASS_HEADER: shown}).status_code != 412

    def test_headers_of_every_answer(self, client, method, route):
        headers = client.request(method, route).headers
        assert headers["x-content-type-options"] == "nosniff"
        assert "default-src 'none'" in headers["content-security-policy"]
        assert "unsafe" not in headers["content-security-policy"]
        assert headers["cache-control"] == "no-store"


def test_web_sockets_are_closed_before_anything_sees_them():
    async def app(scope, receive, send):
        raise AssertionError("it was let through")

    said = []

    async def send(message):
        said.append(message)

    guard = Guard(app, TOKEN, frozenset())
    for kind in ("websocket", "something else"):
        asyncio.run(guard({"type": kind, "path": "/api/photos"}, None, send))
    assert [message["type"] for message in said] == ["websocket.close"] * 2


@pytest.mark.parametrize("route", [route for method, route in ROUTES if method == "POST"])
def test_changes_need_json_of_a_limited_size(client, route):
    form = {"Content-Type": "application/x-www-form-urlencoded"}
    assert client.post(route, content=b"revision=0", headers=form).status_code == 415
    assert client.post(route, content=b"{}").status_code == 415
    json = {"Content-Type": "application/json"}
    large = b"[" * 3_000_000
    assert client.post(route, content=large, headers=json).status_code == 413

    def slowly():
        for _ in range(30):
            yield b" " * 100_000

    assert client.post(route, content=slowly(), headers=json).status_code == 413


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"[" * 100_000,
        b"null",
        b"\xff\xfe",
        b'{"id": "a", "revision": 0}',
        b'{"revision": 0, "operation": {"kind": "open"}}',
        b'{"id": "", "revision": 0, "operation": {"kind": "open"}}',
        b'{"id": "a b", "revision": 0, "operation": {"kind": "open"}}',
        b'{"id": 7, "revision": 0, "operation": {"kind": "open"}}',
        b'{"id": "%s", "revision": 0, "operation": {"kind": "open"}}' % (b"a" * 65),
        b'{"id": "a", "revision": 0, "operation": {}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "drop table"}}',
        b'{"id": "a", "revision": "0", "operation": {"kind": "open"}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "anchor", "column": 1e400, "row": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "anchor", "column": NaN, "row": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "anchor", "column": 1.5, "row": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "open", "x": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "anchor", "column": 700, "row": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "remove", "column": 7}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "status", "status": "done"}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "tag", "tag": "\\u0000"}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "drawn", "first": 0, "rows": []}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "forbid", "points": [[1]]}}',
    ],
)
def test_malformed_operations_are_one_sentence(client, body):
    headers = {"Content-Type": "application/json"}
    said = client.post("/api/photos/1/operations", content=body, headers=headers)
    assert 400 <= said.status_code < 500
    assert said.json()["detail"].endswith(".")
    assert client.get("/api/photos/1").json()["revision"] == 0


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
        "/api/photos/1/alternatives/70",
        "/api/exports/..%2fcsv",
        "/api/sheet?page=-1",
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
            do(client, photo["id"], {"kind": "status", "status": "accepted"})
            thumbnail = client.get(f"/api/photos/{photo['id']}/thumbnail")
            assert thumbnail.headers["content-type"] == "image/jpeg"
        for kind in ("csv", "labelme", "cvat", "coco", "json", "ch1", "painted"):
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
