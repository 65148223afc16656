"""Other lines as the page asks for them: in the consensus, those of the passes."""

import pytest

from testing.labelling import asked, done, served, write_hills
from testing.labels import label_named, run


@pytest.fixture
def folder(tmp_path):
    folder = write_hills(tmp_path / "alps")
    for who, row in (("ann", 10), ("bob", 30)):
        label_named(folder, ["hill-0.png"], row, who)
    assert run("consensus", folder) == 0
    return folder


def test_somebody_decides_by_taking_the_line_of_a_pass(folder):
    with served(folder, annotator="consensus") as client:
        shown = client.get("/api/photos/1").json()
        assert shown["status"] == "needs review"
        assert shown["apart"] == [[0, 69]]
        assert shown["comment"]["by"] == "consensus"
        listed = client.get("/api/photos").json()["photos"][0]
        assert listed["comment"] == shown["comment"]
        found = client.get("/api/photos/1/alternatives?column=35").json()["alternatives"]
        assert [one["name"] for one in found] == ["ann", "bob"]
        assert [set(one["rows"]) for one in found] == [{10}, {30}]
        after = done(client, 1, found[1]["take"]).json()
        assert set(after["rows"]) == {30}
        assert after["apart"] == []
        assert after["undo_what"] == "the line of bob"
        assert after["origins"]["straight"] == 70  # as in bob's pass
        others = client.get("/api/photos/1/alternatives?column=35").json()["alternatives"]
        assert all(not one["name"] and one["take"] is None for one in others)
        assert done(client, 1, {"kind": "status", "status": "accepted"}).json()["comment"] is None
        client.post("/api/photos/1/undo", json=asked())
        back = client.post("/api/photos/1/undo", json=asked()).json()
        assert (set(back["rows"]), back["apart"]) == ({10}, [[0, 69]])
        assert back["comment"] == shown["comment"]


def test_a_photo_that_was_not_compared_is_labelled_as_any_other(folder):
    with served(folder, annotator="consensus") as client:
        shown = client.get("/api/photos/3").json()
        assert (shown["apart"], shown["comment"]) == ([], None)
        found = client.get("/api/photos/3/alternatives").json()["alternatives"]
        assert all(not one["name"] for one in found)


@pytest.mark.parametrize(
    "taken",
    [
        {"first": 60, "rows": [5] * 20, "origins": [["solved", 20]], "of": ["bob"]},
        {"first": 0, "rows": [5] * 20, "origins": [["solved", 19]], "of": ["bob"]},
        {"first": 0, "rows": [500], "origins": [["solved", 1]], "of": ["bob"]},
        {"first": 0, "rows": [5], "origins": [["guessed", 1]], "of": ["bob"]},
        {"first": 0, "rows": [5], "origins": [["solved", 1]], "of": []},
        {
            "first": 0,
            "rows": [5],
            "origins": [["solved", 1]],
            "of": ["bob"],
            "hidden": [[3, 4]],
        },
    ],
)
def test_a_line_that_makes_no_sense_is_refused_in_a_sentence(folder, taken):
    with served(folder, annotator="consensus") as client:
        before = client.get("/api/photos/1").json()
        answer = done(client, 1, {"kind": "taken", **taken})
        assert answer.status_code == 422
        assert answer.json()["detail"].endswith(".")
        assert client.get("/api/photos/1").json() == before


def test_the_page_cannot_write_a_consensus(folder):
    with served(folder, annotator="consensus") as client:
        operation = {"kind": "consensus", "first": 0, "rows": [5], "origins": [["solved", 1]]}
        assert done(client, 1, {**operation, "of": ["bob"]}).status_code == 422
