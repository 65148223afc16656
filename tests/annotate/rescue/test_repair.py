"""Labels can be read wherever they lie; what is damaged is a sentence, and can be repaired."""

import pytest

from annotate.store.database import NAME
from annotate.store.store import Store
from testing.labelling import served, workbench, write_hills
from testing.labels import POISON, change, label, poisoned, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


@pytest.fixture
def labelled(folder):
    return label(folder, row=11, photos=3)


# Damaged files


DAMAGES = {
    "line": "INSERT INTO operations (label, at, kind, body, line)"
    ' VALUES (2, 1.0, \'hidden\', \'{"kind": "hidden", "first": 1, "last": 2}\', x\'0102\')',
    "line of another width": "INSERT INTO operations (label, at, kind, body, line) SELECT 2, 1.0,"
    ' \'hidden\', \'{"kind": "hidden", "first": 1, "last": 2}\', ?',
    "annotator": "UPDATE labels SET annotator = CAST(x'ff41' AS TEXT) WHERE id = 2",
    "number": "UPDATE labels SET number = -5 WHERE id = 2",
    "size": "UPDATE photos SET width = 69 WHERE id = (SELECT photo FROM labels WHERE id = 2)",
}


@pytest.mark.parametrize("damage", ["line", "size"])
def test_a_damaged_label_hides_no_other(damage, labelled, tmp_path, capsys):
    change(labelled, DAMAGES[damage])
    assert run("status", labelled) == 0
    assert run("export", labelled, "--out", tmp_path / "out") == 0
    said = capsys.readouterr()
    assert "2 labels in" in said.out
    assert "the label of hill-1.png by ann, pass 1, cannot be read" in said.err
    with served(labelled) as page:
        assert page.get("/api/photos").status_code == 200
        codes = []
        for photo in page.get("/api/photos").json()["photos"]:
            for what in ("", "/strip", "/margins", "/image"):
                answer = page.get(f"/api/photos/{photo['id']}{what}")
                codes.append(answer.status_code)
        assert set(codes) <= {200, 410, 422}
        assert codes.count(200) >= 8


def test_a_damaged_bank_is_a_sentence_for_its_photos_and_can_be_repaired(labelled, capsys):
    change(labelled, "UPDATE detectors SET bank = x'00010203'")
    with served(labelled) as page:
        for photo in page.get("/api/photos").json()["photos"]:
            answer = page.get(f"/api/photos/{photo['id']}")
            assert answer.status_code == 422
            assert "what proposed for it is damaged" in answer.json()["detail"]
    assert run("export", labelled, "--out", labelled.parent / "out") == 0
    assert "3 labels in" in capsys.readouterr().out  # the lines are there
    assert run("repair", labelled) == 0
    assert capsys.readouterr().err.count("was damaged, and is forgotten") == 3
    with served(labelled) as page:
        for photo in page.get("/api/photos").json()["photos"]:
            shown = page.get(f"/api/photos/{photo['id']}").json()
            assert (shown["status"], set(shown["rows"])) == ("accepted", {11})


# Repair


def test_nothing_to_repair_changes_nothing(labelled, capsys):
    before = (labelled / NAME).read_bytes()
    assert run("repair", labelled) == 0
    assert "All labels in" in capsys.readouterr().out
    assert (labelled / NAME).read_bytes()[100:] == before[100:]


@pytest.mark.parametrize(("kind", "body"), POISON)
def test_a_bad_label_is_set_aside_and_its_photo_is_free(kind, body, folder, capsys):
    poisoned(folder, kind, body)
    count = change(folder, "SELECT count(*) FROM operations")
    assert run("repair", folder) == 1
    said = capsys.readouterr().err
    assert "set aside: the label of hill-1.png by ann, pass 1, cannot be read" in said
    assert said.count("\n") == 1
    assert run("repair", folder) == 0
    assert "All labels in" in capsys.readouterr().out
    assert run("status", folder) == 0
    assert "set aside: the label of hill-1.png by ann" in capsys.readouterr().err
    bench = workbench(folder)
    assert {one.photo.name: one.status for one in bench.cards()} == {
        "hill-0.png": "accepted",
        "hill-1.png": "to do",
        "hill-2.png": "to do",
    }
    bench.close()
    label(folder, row=22, photos=2)
    store = Store(folder, reading=True)
    rows = {one.name: set(one.skyline.rows) for one in store.labels() if one.skyline}
    assert store.passes() == [("ann", 1)]
    store.close()
    assert rows["hill-1.png"] == {22}
    assert change(folder, "SELECT count(*) FROM operations") > count  # none is deleted


@pytest.mark.parametrize("damage", ["line", "annotator", "number"])
def test_damaged_labels_are_set_aside(damage, labelled, capsys):
    change(labelled, DAMAGES[damage])
    assert run("repair", labelled) == 1
    assert "set aside: the label of hill-1.png" in capsys.readouterr().err
    store = Store(labelled, reading=True)
    assert [one.name for one in store.labels()] == ["hill-0.png", "hill-2.png"]
    assert store.passes() == [("ann", 1)]
    store.close()


def test_a_folder_that_is_open_is_not_repaired(labelled, capsys):
    from annotate.commands.options import locked  # noqa: PLC0415

    with locked(labelled):
        assert run("repair", labelled) == 2
    assert "is open in another skyline-annotate" in capsys.readouterr().err
