"""Changes through real requests: sent again, on old revisions, undone, on a replaced photo."""

import os
from concurrent.futures import ThreadPoolExecutor

import cv2
import pytest

from annotate.store.store import Store
from skyline_viz.photo import read_photo, write_photo
from testing.labelling import asked, hills, served, write_hills

ANCHOR = {"kind": "anchor", "column": 20, "row": 40}
ACCEPT = {"kind": "status", "status": "accepted"}


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "photos", count=2)


@pytest.fixture
def client(folder):
    with served(folder) as client:
        yield client


def post(client, what, body, photo=1):
    return client.post(f"/api/photos/{photo}/{what}", json=body)


def do(client, operation, revision=-1, photo=1):
    return post(client, "operations", asked(revision, operation=operation), photo)


def undo(client, what="undo"):
    said = post(client, what, asked())
    assert said.status_code == 200
    return said.json()


def document(client, photo=1):
    return client.get(f"/api/photos/{photo}").json()


def test_a_change_whose_answer_was_lost_is_done_once(client):
    body = asked(0, operation=ANCHOR)
    first = post(client, "operations", body).json()
    assert first["kept"] == first["revision"] > 0
    later = do(client, {**ANCHOR, "column": 50}).json()
    again = post(client, "operations", body)
    assert again.status_code == 200
    assert again.json() == {**later, "kept": first["kept"]}
    step = asked(later["revision"])
    undone = post(client, "undo", step).json()
    assert post(client, "undo", step).json() == undone
    assert undone["anchors"] == [[20, 40]]
    assert post(client, "redo", asked(undone["revision"])).json()["anchors"] == later["anchors"]


def test_a_change_is_known_after_a_restart(folder):
    body = asked(0, operation=ANCHOR)
    with served(folder) as client:
        first = post(client, "operations", body).json()
    with served(folder) as client:
        assert post(client, "operations", body).json() == first
        assert post(client, "operations", {**body, "revision": -1}).json() == first


def test_one_change_that_arrives_many_times_at_once_is_done_once(client):
    body = asked(0, operation={"kind": "forbid", "points": [[50, 3]], "radius": 2})
    with ThreadPoolExecutor(6) as pool:
        said = list(pool.map(lambda _: post(client, "operations", body).json(), range(12)))
    assert {one["revision"] for one in said} == {said[0]["kept"]}
    assert len(document(client)["forbidden"]) == 1


def test_an_id_belongs_to_one_change(client):
    body = asked(operation=ANCHOR)
    kept = post(client, "operations", body).json()
    for photo, what, other in (
        (1, "operations", {**body, "operation": {**ANCHOR, "row": 39}}),
        (2, "operations", body),
        (1, "undo", asked() | {"id": body["id"]}),
    ):
        said = post(client, what, other, photo)
        assert said.status_code == 409
        assert said.json()["revision"] == (kept["revision"] if photo == 1 else 0)
    assert document(client) == {**kept, "kept": None}
    assert document(client, 2)["revision"] == 0


def test_an_old_revision_is_told_the_present_one_and_can_be_tried_on_it(client):
    first = do(client, ANCHOR, 0).json()
    body = asked(0, operation={"kind": "remove", "column": 20})
    said = post(client, "operations", body)
    assert said.status_code == 409
    assert said.json()["revision"] == first["revision"]
    assert said.json()["detail"].endswith(".")
    again = post(client, "operations", {**body, "revision": said.json()["revision"]})
    assert again.json()["anchors"] == []
    stale = do(client, {"kind": "remove", "column": 3}, 0)  # refused for its revision first
    assert (stale.status_code, stale.json()["revision"]) == (409, again.json()["revision"])


def test_looking_at_a_photo_needs_no_revision_and_makes_none(client):
    first = do(client, ANCHOR, 0).json()
    looked = do(client, {"kind": "open"}, 0)
    assert looked.status_code == 200
    assert looked.json()["kept"] == looked.json()["revision"] == first["revision"]
    assert do(client, {**ANCHOR, "row": 39}, first["revision"]).status_code == 200


def test_accepting_can_be_undone(client):
    do(client, ANCHOR)
    accepted = do(client, ACCEPT).json()
    assert (accepted["can_undo"], accepted["undo_what"]) == (True, "accepted")
    undone = undo(client)
    assert (undone["status"], undone["undo_what"]) == ("in progress", "the anchor")
    assert undone["rows"] == accepted["rows"]
    redone = undo(client, "redo")
    assert (redone["status"], redone["can_redo"]) == ("accepted", False)
    assert client.get("/api/photos").json()["photos"][0]["status"] == "accepted"
    undo(client)
    first = undo(client)
    assert (first["status"], first["can_undo"], first["undo_what"]) == ("to do", False, None)


def test_undoing_an_edit_of_an_accepted_photo_makes_it_accepted_again(folder):
    with served(folder) as client:
        accepted = do(client, ACCEPT).json()
        assert do(client, ANCHOR).json()["status"] == "in progress"
        do(client, {"kind": "tag", "tag": "fog", "on": True})  # no part of it
    with served(folder) as client:
        undone = undo(client)
        assert (undone["status"], undone["rows"]) == ("accepted", accepted["rows"])
        assert undone["tags"] == ["fog"]
        exported = client.get("/api/exports/csv")
        assert exported.status_code == 200


def test_a_status_that_says_nothing_new_is_refused_and_undo_never_finds_it(client):
    review = {"kind": "status", "status": "needs review"}
    assert do(client, {"kind": "status", "status": "to do"}).status_code == 422
    body = asked(operation=review)
    first = post(client, "operations", body).json()
    kept = do(client, ANCHOR).json()  # still needs review
    said = do(client, review)
    assert (said.status_code, said.json()["detail"]) == (422, "hill-0.png is needs review already.")
    assert document(client)["revision"] == kept["revision"]
    again = post(client, "operations", body)  # known: no new request
    assert (again.status_code, again.json()["kept"]) == (200, first["kept"])
    assert (document(client)["status"], document(client)["undo_what"]) == (
        "needs review",
        "the anchor",
    )


def test_a_blind_photo_without_a_line_is_not_accepted(folder):
    with served(folder, blind=1.0) as client:
        said = do(client, ACCEPT)
        assert said.status_code == 422
        assert said.json()["detail"] == (
            "hill-0.png has no line yet, so there is nothing to accept."
        )
        assert (document(client)["status"], document(client)["revision"]) == ("to do", 0)
        for status in ("rejected", "needs review"):
            assert do(client, {"kind": "status", "status": status}).status_code == 200
        do(client, ANCHOR)
        assert do(client, ACCEPT).json()["status"] == "accepted"
        for _ in range(2):
            undo(client)
        assert document(client)["rows"] is None
        assert do(client, ACCEPT).status_code == 422


def test_a_blind_photo_that_was_accepted_without_a_line_still_opens(folder):
    with served(folder, blind=1.0) as client:
        do(client, {"kind": "tag", "tag": "fog", "on": True})
    store = Store(folder)
    store.append(1, -1, "status", {"status": "accepted"})
    store.close()
    with served(folder, blind=1.0) as client:
        assert (document(client)["status"], document(client)["rows"]) == ("accepted", None)
        assert undo(client)["status"] == "to do"


def test_nothing_to_undo_is_no_matter_of_revisions(client):
    for what in ("undo", "redo"):
        said = post(client, what, asked())
        assert said.status_code == 422
        assert said.json() == {"detail": f"there is nothing to {what}."}


@pytest.mark.parametrize(
    ("what", "operation"),
    [
        ("operations", ACCEPT),
        ("operations", ANCHOR),
        ("operations", {"kind": "tag", "tag": "fog", "on": True}),
        ("operations", {"kind": "open"}),
        ("undo", None),
    ],
)
def test_a_photo_that_is_replaced_while_it_is_open_takes_nothing_more(
    client, folder, what, operation
):
    kept = do(client, ANCHOR).json()
    before = (folder / "hill-0.png").stat()
    write_photo(folder / "hill-0.png", hills(9))
    os.utime(folder / "hill-0.png", ns=(before.st_atime_ns, before.st_mtime_ns))
    said = post(client, what, asked(operation=operation) if operation else asked())
    assert said.status_code == 410
    assert "hill-0.png was replaced by another photo" in said.json()["detail"]
    store = Store(folder)
    assert (store.state(1).revision, store.state(1).count) == (kept["revision"], 1)
    store.close()


@pytest.mark.parametrize("how", ["touched", "written anew"])
def test_a_photo_whose_file_changed_but_not_its_pixels_goes_on(client, folder, how):
    do(client, ANCHOR)
    path = folder / "hill-0.png"
    if how == "touched":
        os.utime(path)
    else:
        pixels = read_photo(path)
        cv2.imwrite(str(path), pixels[..., ::-1], [cv2.IMWRITE_PNG_COMPRESSION, 1])
    assert do(client, ACCEPT).json()["status"] == "accepted"


def test_a_photo_that_is_gone_takes_nothing_more(client, folder):
    kept = do(client, ANCHOR).json()
    (folder / "hill-0.png").rename(folder / "elsewhere.bin")
    said = do(client, ACCEPT)
    assert said.status_code == 410
    assert said.json()["detail"].startswith("hill-0.png ")
    (folder / "elsewhere.bin").rename(folder / "hill-0.png")
    assert document(client)["revision"] == kept["revision"]
    assert do(client, ACCEPT).status_code == 200


def test_what_another_program_added_is_shown_after_one_refusal(client, folder):
    first = do(client, ANCHOR).json()
    other = Store(folder)
    other.append(1, -1, "tag", {"tag": "theirs", "on": True})
    other.close()
    body = asked(first["revision"], operation=ACCEPT)
    said = post(client, "operations", body)
    assert said.status_code == 409
    assert document(client)["tags"] == ["theirs"]
    assert document(client)["revision"] == said.json()["revision"]
    again = post(client, "operations", {**body, "revision": said.json()["revision"]}).json()
    assert (again["status"], again["tags"]) == ("accepted", ["theirs"])


def test_a_guide_is_previewed_and_is_one_operation(client):
    before = document(client)
    stroke = {"points": [[10, 38], [40, 42], [60, 38]], "radius": 5, "times": [0, 400, 800]}
    part = post(client, "guide", stroke).json()
    assert document(client)["rows"] == before["rows"]
    after = do(client, {"kind": "guide", **stroke}).json()
    first, last = part["first"], part["first"] + len(part["rows"])
    assert after["rows"][first:last] == part["rows"]
    assert (
        after["rows"][:first] + after["rows"][last:]
        == before["rows"][:first] + before["rows"][last:]
    )
    assert all(abs(row - 40) <= 9 for row in after["rows"][12:58])
    assert (after["guides"], after["undo_what"]) == ([[10, 60]], "the guide")
    undone = undo(client)
    assert (undone["rows"], undone["guides"]) == (before["rows"], [])
    assert post(client, "guide", {"points": []}).status_code == 422
    outside = post(client, "guide", {"points": [[-900, 3]]})
    assert outside.json()["detail"] == "the guide lies outside the photo."
