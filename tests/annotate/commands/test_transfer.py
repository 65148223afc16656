"""``skyline-annotate export``, ``import`` and ``backup``: labels leave and come back."""

import json

import numpy as np
import pytest

from annotate.store.database import NAME
from annotate.store.operations import SetStatus, Straight
from annotate.store.store import Store
from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.photo import read_photo
from skyline_viz.skyline import Skyline
from testing.labelling import workbench, write_hills
from testing.labels import label, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


@pytest.mark.parametrize(
    "kind", ["mask", "painted", "ch1", "csv", "json", "coco", "labelme", "cvat", "parquet"]
)
def test_labels_leave_and_come_back(folder, kind, tmp_path, capsys):
    label(folder)
    out = tmp_path / "out"
    assert run("export", folder, "--format", kind, "--out", out) == 0
    said = capsys.readouterr().out
    assert f"2 labels in {out}" in said
    assert "Not in it: 1 photo of the folder." in said
    again = write_hills(tmp_path / "again")
    words = ["import", again, out, "--annotator", "eve", "--status", "accepted"]
    assert run(*words) == 0
    assert "2 labels imported" in capsys.readouterr().out
    lines = []
    for place, who in ((folder, "ann"), (again, "eve")):
        store = Store(place)
        lines.append([one for one in store.labels(who) if one.status == "accepted"])
        store.close()
    assert [one.skyline for one in lines[0]] == [one.skyline for one in lines[1]]
    assert run(*words) == 1
    assert "has been labelled by eve in pass 1 already" in capsys.readouterr().err


def test_undone_statuses_leave_and_come_back(folder, tmp_path):
    bench = workbench(folder)
    session = bench.session(1)
    session.apply(SetStatus(status="accepted"), -1)
    session.apply(Straight(column=0, row=9, to_column=69, to_row=9), -1)
    session.undo(-1)
    assert session.state.status == "accepted"
    kept = session.state
    bench.close()
    assert run("export", folder, "--format", "json", "--out", tmp_path / "out") == 0
    file = tmp_path / "out" / "labels.json"
    document = json.loads(file.read_text())
    assert document["version"] == 2  # programs that would misread the undo refuse it
    assert run("import", write_hills(tmp_path / "again"), file) == 0
    store = Store(tmp_path / "again")
    came = store.state(1)
    assert (came.status, came.edits, came.steps) == ("accepted", kept.edits, kept.steps)
    assert came.taken == kept.taken
    store.close()
    file.write_text(json.dumps({**document, "version": 1}))  # as programs before wrote it
    assert run("import", write_hills(tmp_path / "third"), file) == 0
    file.write_text(json.dumps({**document, "version": 3}))
    assert run("import", write_hills(tmp_path / "fourth"), file) == 2


def test_imported_labels_can_be_edited_on(folder, tmp_path):
    label(folder, row=11)
    assert run("export", folder, "--format", "json", "--out", tmp_path / "out") == 0
    again = write_hills(tmp_path / "again")
    assert run("import", again, tmp_path / "out" / "labels.json") == 0
    bench = workbench(again)
    session = bench.session(1)
    assert session.state.status == "accepted"
    assert set(session.wire.skyline.rows) == {11}
    session.undo(-1)
    assert session.state.status == "in progress"
    session.undo(-1)
    assert len(set(session.wire.skyline.rows)) > 1
    bench.close()


def test_an_export_is_a_data_set(folder, tmp_path):
    label(folder)
    assert run("export", folder, "--format", "ch1", "--out", tmp_path / "out") == 0
    items = list(open_dataset(tmp_path / "out"))
    assert len(items) == 2
    for item in items:
        np.testing.assert_array_equal(item.photo(), read_photo(folder / item.photo_path.name))
        assert isinstance(item.truth(), Skyline)


def test_a_backup_is_one_file(folder, tmp_path, capsys):
    label(folder)
    assert run("backup", folder, "--out", tmp_path / "kept.sqlite") == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "kept.sqlite")
    again = write_hills(tmp_path / "again")
    (tmp_path / "kept.sqlite").rename(again / NAME)
    assert run("status", again) == 0
    assert run("backup", folder, "--out", again / NAME) == 2
