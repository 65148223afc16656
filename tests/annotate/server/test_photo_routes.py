"""Routes of one photo: what they show, and that a preview changes nothing."""

import numpy as np
import pytest

from skyline_viz import render
from skyline_viz.photo import write_photo
from testing.detections import unseen
from testing.labelling import asked, served, write_hills


def operate(client, photo, **operation):
    return client.post(f"/api/photos/{photo}/operations", json=asked(operation=operation)).json()


def test_a_preview_is_what_the_anchor_makes_of_the_line_and_changes_nothing(client):
    before = client.get("/api/photos/1").json()
    part = client.post("/api/photos/1/preview", json={"column": 30, "row": 5}).json()
    assert client.get("/api/photos/1").json() == before
    rows = before["rows"][:]
    rows[part["first"] : part["first"] + len(part["rows"])] = part["rows"]
    after = operate(client, 1, kind="anchor", column=30, row=5)
    assert after["rows"] == rows
    assert after["revision"] > before["revision"]


def test_a_click_that_snaps_is_previewed_and_kept_as_one_operation(client):
    before = client.get("/api/photos/3").json()
    aim = {"column": 30, "row": before["rows"][30] + 14, "within": 3}
    part = client.post("/api/photos/3/preview", json=aim).json()
    rows = before["rows"][:]
    rows[part["first"] : part["first"] + len(part["rows"])] = part["rows"]
    after = operate(client, 3, kind="anchor", **aim)
    assert after["rows"] == rows
    assert after["anchors"] == [[30, rows[30]]]
    assert abs(rows[30] - aim["row"]) <= 3
    assert after["forbidden"] == []
    assert client.post("/api/photos/3/undo", json=asked()).json()["rows"] == before["rows"]


def test_all_above_a_stroke_is_sky(client):
    before = client.get("/api/photos/3").json()["rows"]
    after = operate(client, 3, kind="side", points=[[0, 30], [69, 30]], ground="sky")
    assert min(after["rows"]) >= 30
    assert after["sides"] == [{"first": 0, "rows": [30] * 70, "ground": "sky"}]
    assert after["undo_what"] == "all above is sky"
    assert client.post("/api/photos/3/undo", json=asked()).json()["rows"] == before


def test_margins_are_those_of_the_line_as_it_is(client):
    shown = operate(client, 2, kind="anchor", column=30, row=20)
    margins = client.get("/api/photos/2/margins").json()
    assert margins["revision"] == shown["revision"]
    assert margins["margins"][30] is None  # it is fixed
    assert len(margins["margins"]) == len(shown["rows"])
    assert margins["uncertain"]


def test_an_alternative_is_another_ridge_and_a_guide_chooses_it(client):
    before = client.get("/api/photos/3").json()["rows"]
    found = client.get("/api/photos/3/alternatives").json()["alternatives"]
    assert 0 < len(found) <= 4
    for one in found:
        off = np.abs(np.subtract(one["rows"], before)) > 5
        assert off.mean() == pytest.approx(one["apart"], abs=1e-3)
        assert one["apart"] >= 0.2
    chosen = {name: found[0][name] for name in ("points", "radius")}
    after = operate(client, 3, kind="guide", **chosen)
    assert np.abs(np.subtract(after["rows"], found[0]["rows"])).max() <= 8
    assert client.post("/api/photos/3/undo", json=asked()).json()["rows"] == before


def test_a_pixel_is_explained_down_to_its_patch_and_terms(client):
    row = client.get("/api/photos/3").json()["rows"][40]
    told = client.get(f"/api/photos/3/pixels/40/{row}").json()
    assert (told["row"], told["column"], told["edge"]) == (row, 40, True)
    assert sum(told["terms"].values()) == pytest.approx(told["cost"], abs=1e-4)
    filtered = told["filtered"]
    assert filtered["score"] == pytest.approx(told["score"])
    np.testing.assert_allclose(
        np.array(filtered["patch"]) * filtered["taps"] / 255, filtered["product"], atol=1e-5
    )
    refused = client.get("/api/photos/3/pixels/40/9999")
    assert refused.status_code == 422
    assert refused.json()["detail"].startswith("there is no pixel in row 9999")


def test_undo_and_redo_go_back_and_forth(client):
    first = operate(client, 3, kind="anchor", column=9, row=9)
    operate(client, 3, kind="anchor", column=50, row=9)
    back = client.post("/api/photos/3/undo", json=asked()).json()
    assert (back["anchors"], back["rows"]) == (first["anchors"], first["rows"])
    again = client.post("/api/photos/3/redo", json=asked()).json()
    assert np.array(again["anchors"]).tolist() == [[9, 9], [50, 9]]


def test_a_blind_photo_has_no_recording(tmp_path):
    with served(write_hills(tmp_path, count=1), blind=1.0) as client:
        answer = client.get("/api/photos/1/recording")
        assert answer.status_code == 403
        assert "labelled blind" in answer.json()["detail"]
        assert client.get("/api/photos/1/pixels/3/3").status_code == 403
        assert client.get("/api/photos/1/alternatives").json() == {"alternatives": []}


def test_a_doubted_proposal_is_said_until_somebody_has_worked_on_it(tmp_path):
    with served(write_hills(tmp_path, count=1), detector=unseen()) as client:
        shown = client.get("/api/photos/1").json()
        assert "no sky" in shown["doubt"]
        assert shown["hidden"] == []
        assert operate(client, 1, kind="anchor", column=30, row=5)["doubt"] == ""


def test_what_is_carried_over_is_told_until_somebody_works_on_it(tmp_path):
    scene = render("clear", 3, 640, 480).photo
    for name, left in (("pan-1", 100), ("pan-2", 140)):
        write_photo(tmp_path / f"{name}.png", scene[20:260, left : left + 400])
    with served(tmp_path) as client:
        own = client.get("/api/photos/2").json()
        assert own["carried"] == ""
        operate(client, 1, kind="anchor", column=200, row=160)
        operate(client, 1, kind="status", status="accepted")
        shown = client.get("/api/photos/2").json()
        assert (shown["carried"], shown["status"]) == ("pan-1.png", "to do")
        assert shown["undo_what"] == "the line carried over from pan-1.png"
        assert shown["rows"] != own["rows"]
        back = client.post("/api/photos/2/undo", json=asked()).json()
        assert (back["carried"], back["rows"]) == ("", own["rows"])
        forged = {"kind": "carried", "points": [[1, 2]], "radius": 3, "name": "x"}
        answer = client.post("/api/photos/2/operations", json=asked(operation=forged))
        assert answer.status_code == 422  # the program alone carries
