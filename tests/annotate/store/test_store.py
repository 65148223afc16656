"""The store: what is kept, and what is refused."""

import shutil
import sqlite3
from contextlib import closing

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import skyline_viz.files as files
from annotate.engine.edits import EditError
from annotate.formats import export_labels
from annotate.store.database import NAME
from annotate.store.kept_states import Request
from annotate.store.lines import Line
from annotate.store.operations import SetAnchor, SetStatus
from annotate.store.store import StaleError, Store
from skyline_viz.skyline import Skyline
from testing.examples import examples
from testing.labelling import DETECTOR, workbench, write_hills
from testing.logs import LINE, anchor


@examples(30)
@example(["edit", "undo", "edit", "redo"])
@given(st.lists(st.sampled_from(["edit", "undo", "redo", "tag", "open"]), max_size=30))
def test_undo_and_redo_are_a_cursor_in_the_log(tmp_path_factory, asked):
    folder = tmp_path_factory.mktemp("log")
    store = Store(write_hills(folder, count=1))
    (photo,) = store.find()
    label = store.begin(photo.id, "ann", 1)
    done, undone = [], []
    for number, kind in enumerate(asked):
        if kind == "edit":
            anchor(store, label, number)
            done.append(number)
            undone = []
        elif kind == "tag":
            store.append(label, -1, "tag", {"tag": "x", "on": True})
        else:
            store.append(label, -1, kind, {})
            if kind == "undo" and done:
                undone.append(done.pop())
            if kind == "redo" and undone:
                done.append(undone.pop())
    store.close()
    store = Store(folder)
    state = store.state(label)
    assert [edit.column for edit in state.done] == done
    assert [edit.column for edit in state.undone] == undone
    assert dict(state.edits.anchors) == dict.fromkeys(done, 5)
    store.close()


def test_the_log_cannot_be_rewritten(store):
    label = store.begin(1, "ann", 1)
    anchor(store, label, 3)
    with closing(sqlite3.connect(store.folder / NAME)) as connection:
        for change in ("UPDATE operations SET kind = 'x'", "DELETE FROM operations"):
            with pytest.raises(sqlite3.IntegrityError, match="operations are never"):
                connection.execute(change)


def test_a_stale_revision_is_refused(store):
    label = store.begin(1, "ann", 1)
    first = anchor(store, label, 3)
    anchor(store, label, 4)
    with pytest.raises(StaleError, match="another tab"):
        store.append(label, first, "anchor", {"column": 5, "row": 5}, LINE)
    assert sorted(store.state(label).edits.anchors) == [3, 4]


def test_passes_are_kept_apart(store):
    labels = [store.begin(1, who, number) for who, number in (("a", 1), ("a", 2), ("b", 1))]
    for column, label in enumerate(labels):
        anchor(store, label, column)
    assert [sorted(store.state(label).edits.anchors) for label in labels] == [[0], [1], [2]]
    assert store.passes() == [("a", 1), ("a", 2), ("b", 1)]
    assert store.begin(1, "a", 2) == labels[1]


def test_status_tags_and_time_follow_from_the_log(store, monkeypatch):
    label = store.begin(1, "ann", 1)
    clock = iter([100.0, 110.0, 115.0, 1000.0, 1001.0])
    monkeypatch.setattr("annotate.store.kept_states.time", lambda: next(clock))
    store.append(label, -1, "open", {})
    anchor(store, label, 3)
    store.append(label, -1, "tag", {"tag": "fog", "on": True})
    store.append(label, -1, "status", {"status": "accepted"})
    card = store.cards("ann", 1)[1]
    assert (card.status, card.tags, card.seconds) == ("accepted", ("fog",), 10 + 5 + 60)
    anchor(store, label, 4)  # an accepted photo that is edited is in progress again
    assert store.state(label).status == "in progress"


def test_a_proposal_stays_once_somebody_has_worked_on_it(store):
    label = store.begin(1, "ann", 1)
    store.propose(label, LINE, DETECTOR, 0.5)
    assert store.state(label).line.skyline == LINE.skyline
    again = store.detector(label)
    assert again.config == DETECTOR.config
    np.testing.assert_array_equal(again.bank.filters, DETECTOR.bank.filters)
    store.append(label, -1, "status", {"status": "accepted"})
    with pytest.raises(StaleError, match="worked on"):
        store.propose(label, LINE, DETECTOR, 0.7)


def test_labels_tell_everything(store):
    label = store.begin(1, "ann", 1)
    store.propose(label, LINE, DETECTOR, 0.5)
    body = SetAnchor(column=1, row=4).model_dump(exclude={"kind"})
    rows = np.arange(70)
    line = Line(Skyline(rows=rows % 40), np.ones(70, np.uint8))
    store.append(label, 0, "anchor", body, line)
    (told,) = store.labels()
    assert (told.name, told.annotator, told.number) == ("hill-0.png", "ann", 1)
    assert told.skyline == line.skyline
    assert [one["kind"] for one in told.operations] == ["anchor"]
    assert "skyline-viz" in told.detector


def test_two_files_with_one_content_are_one_photo(tmp_path):
    folder = write_hills(tmp_path, count=1)
    shutil.copy(folder / "hill-0.png", folder / "hill-9.png")
    (folder / "sub").mkdir()
    (folder / "sub" / "broken.jpg").write_bytes(b"no photo")
    store = Store(folder)
    assert [photo.name for photo in store.find()] == ["hill-0.png"]
    assert any("same content as hill-0.png" in one for one in store.problems)
    assert any("broken.jpg" in one for one in store.problems)
    store.close()


def test_an_export_is_on_the_disk_before_it_is_said_to_be_there(tmp_path, monkeypatch):
    folder = write_hills(tmp_path / "photos", count=1)
    bench = workbench(folder)
    for photo in bench.photos:
        bench.session(photo).apply(SetStatus(status="accepted"), -1)
    joined = bench.joined()
    said = []
    flush = files.flush

    def recorded(path):
        said.append(path.name)
        flush(path)

    monkeypatch.setattr(files, "flush", recorded)
    out = tmp_path / "out"
    export_labels(joined.labels, folder, out, "ch1", joined.contents)
    names = {path.name for path in out.rglob("*")}
    assert names <= set(said)
    assert said[-1] == tmp_path.name  # the name of the whole folder comes last
    bench.close()


def test_several_operations_are_kept_at_once_or_none_is(store):
    one, other = store.begin(1, "ann", 1), store.begin(2, "ann", 1)
    tag = Request(one, -1, "tag", {"tag": "fog", "on": True})
    refused = Request(other, -1, "remove", {"column": 3})
    with pytest.raises(EditError, match="no anchor in column 3"):
        store.append_all([(tag, None), (refused, None)])
    assert store.state(one).revision == 0
    more = Request(one, -1, "tag", {"tag": "hut", "on": True})
    revisions = store.append_all([(tag, None), (more, None)])
    assert store.state(one).tags == ("fog", "hut")
    assert store.state(one).revision == revisions[-1]
    stale = Request(one, revisions[0], "tag", {"tag": "snow", "on": True})
    with pytest.raises(StaleError):
        store.append_all(
            [(Request(other, -1, "tag", {"tag": "x", "on": True}), None), (stale, None)]
        )
    assert store.state(other).revision == 0


def test_labels_of_one_photo(store):
    for photo in (1, 2):
        for who in ("ann", "bob"):
            store.append(store.begin(photo, who, 1), -1, "tag", {"tag": "fog", "on": True})
    found = [(one.name, one.annotator) for one in store.labels(photo=2)]
    assert found == [("hill-1.png", "ann"), ("hill-1.png", "bob")]
