"""The store: what is kept, and what is refused."""

import os
import shutil
import sqlite3
from contextlib import closing

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import annotate.store.database as database
import skyline_viz.files as files
from annotate.formats import export_labels
from annotate.store.database import MIGRATIONS, NAME, StoreError, backup, on_network
from annotate.store.lines import Line
from annotate.store.operations import SetAnchor, SetStatus
from annotate.store.store import StaleError, Store
from skyline_viz.skyline import Skyline
from testing.labelling import DETECTOR, workbench, write_hills

LINE = Line(Skyline(rows=[3, 4, 9]), np.array([0, 1, 3], np.uint8))


@pytest.fixture
def store(tmp_path):
    store = Store(write_hills(tmp_path, count=2))
    store.find()
    yield store
    store.close()


def anchor(store, label, column, row=5):
    body = {"column": column, "row": row}
    return store.append(label, -1, "anchor", body, LINE)


@given(
    rows=st.lists(st.integers(0, 5000), min_size=1, max_size=50),
    data=st.data(),
)
def test_lines_are_kept_exactly(rows, data):
    width = len(rows)
    visible = data.draw(st.lists(st.booleans(), min_size=width, max_size=width))
    origin = data.draw(st.lists(st.integers(0, 3), min_size=width, max_size=width))
    line = Line(Skyline(rows=rows, visible=np.array(visible)), np.array(origin, np.uint8))
    kept = Line.unpacked(line.packed())
    assert kept.skyline == line.skyline
    np.testing.assert_array_equal(kept.origin, line.origin)


def test_a_line_of_a_photograph_takes_a_few_hundred_bytes():
    rows = 300 + np.cumsum(np.random.default_rng(0).integers(-2, 3, 1388))
    line = Line(Skyline(rows=rows), np.zeros(1388, np.uint8))
    assert len(line.packed()) < 1000


@settings(max_examples=30, deadline=None)
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


def test_every_commit_is_synchronous(store):
    (level,) = store._connection.execute("PRAGMA synchronous").fetchone()
    (mode,) = store._connection.execute("PRAGMA journal_mode").fetchone()
    assert (level, mode) == (2, "wal")


def test_a_plain_journal_where_the_file_system_is_another_machines(tmp_path, monkeypatch):
    monkeypatch.setattr(database, "on_network", lambda _: True)
    store = Store(write_hills(tmp_path, count=1))
    (mode,) = store._connection.execute("PRAGMA journal_mode").fetchone()
    store.close()
    assert mode == "delete"


def test_this_folder_is_not_on_a_network(tmp_path):
    assert not on_network(tmp_path)


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
    monkeypatch.setattr("annotate.store.store.time", lambda: next(clock))
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


def test_a_newer_file_is_refused_and_not_touched(store):
    path = store.folder / NAME
    store.close()
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA journal_mode = DELETE")
        connection.execute(f"PRAGMA user_version = {len(MIGRATIONS) + 1}")
    before = path.read_bytes()
    known = len(MIGRATIONS)
    sentence = rf"of version {known + 1}, and this program knows .* up to {known};"
    with pytest.raises(StoreError, match=sentence):
        Store(store.folder)
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("damage", "sentence"),
    [
        (lambda data: b"not a database at all" * 400, "damaged"),
        (lambda data: data[:4096] + os.urandom(len(data) - 4096), "damaged"),
        (lambda data: data[: len(data) // 2], "damaged"),
    ],
)
def test_a_damaged_file_is_refused_and_not_touched(store, damage, sentence):
    path = store.folder / NAME
    label = store.begin(1, "ann", 1)
    for column in range(40):
        anchor(store, label, column)
    store.close()
    path.write_bytes(damage(path.read_bytes()))
    before = path.read_bytes()
    with pytest.raises(StoreError, match=sentence):
        Store(store.folder)
    assert path.read_bytes() == before


def test_somebody_elses_database_is_refused(tmp_path):
    with closing(sqlite3.connect(tmp_path / NAME)) as connection:
        connection.execute("CREATE TABLE recipes (name TEXT)")
    with pytest.raises(StoreError, match="not one of skyline-annotate"):
        Store(tmp_path)


def test_older_files_are_brought_up_to_date(store, monkeypatch):
    label = store.begin(1, "ann", 1)
    anchor(store, label, 3)
    store.close()
    more = "ALTER TABLE photos ADD COLUMN place TEXT;"
    monkeypatch.setattr(database, "MIGRATIONS", (*MIGRATIONS, more))
    newer = Store(store.folder)
    (version,) = newer._connection.execute("PRAGMA user_version").fetchone()
    assert version == len(MIGRATIONS) + 1
    assert sorted(newer.state(label).edits.anchors) == [3]
    newer._connection.execute("SELECT place FROM photos")
    newer.close()


def test_a_migration_that_fails_changes_nothing(store, monkeypatch):
    store.close()
    broken = "ALTER TABLE photos ADD COLUMN place TEXT; SELECT * FROM nowhere;"
    with monkeypatch.context() as patch:
        patch.setattr(database, "MIGRATIONS", (*MIGRATIONS, broken))
        with pytest.raises(StoreError, match="nowhere"):
            Store(store.folder)
    again = Store(store.folder)
    columns = [row[1] for row in again._connection.execute("PRAGMA table_info(photos)")]
    assert "place" not in columns
    again.close()


def test_a_backup_is_whole_while_the_store_is_open(store, tmp_path):
    label = store.begin(1, "ann", 1)
    anchor(store, label, 3)
    copy = tmp_path / "elsewhere" / NAME
    backup(store.folder, copy)
    shutil.copy(store.folder / "hill-0.png", copy.parent)
    restored = Store(copy.parent)
    assert sorted(restored.state(label).edits.anchors) == [3]
    restored.close()
    assert sorted(path.name for path in copy.parent.iterdir() if NAME in path.name) == [NAME]
    with pytest.raises(StoreError, match="no labels to back up"):
        backup(tmp_path / "nowhere", copy)


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


def test_a_read_only_folder_is_one_sentence(tmp_path, monkeypatch):
    folder = write_hills(tmp_path / "photos", count=1)
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may write anywhere
    with pytest.raises(StoreError, match=r"photos is read-only, and labels are kept in it\.$"):
        Store(folder)
    assert not (folder / NAME).exists()


def test_a_new_file_of_labels_is_on_the_disk_with_its_name(tmp_path, monkeypatch):
    flushed = []
    monkeypatch.setattr(database, "flush", flushed.append)
    Store(write_hills(tmp_path, count=1)).close()
    assert flushed == [tmp_path]


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
