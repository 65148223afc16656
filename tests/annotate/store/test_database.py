"""The file of labels: where it lies, what it is, how it is opened and brought up to date."""

import os
import shutil
import sqlite3
from contextlib import closing

import pytest

import annotate.store.database as database
from annotate.store.database import MIGRATIONS, NAME, Place, StoreError, backup, on_network
from annotate.store.store import Store
from testing.labelling import served, write_hills
from testing.labels import label, run
from testing.logs import anchor


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


@pytest.fixture
def labelled(folder):
    return label(folder, row=11, photos=3)


@pytest.mark.parametrize("how", ["moved", "removed", "replaced", "journal"])
def test_a_database_that_is_moved_away_stops_acknowledging(how, labelled, tmp_path):
    with served(labelled) as page:
        ids = {one["name"]: one["id"] for one in page.get("/api/photos").json()["photos"]}
        at = f"/api/photos/{ids['hill-0.png']}"
        revision = page.get(at).json()["revision"]
        asked = {"kind": "tag", "tag": "fog"}
        body = {"id": "id-1", "revision": revision, "operation": asked}
        answer = page.post(f"{at}/operations", json=body)
        assert answer.status_code == 200
        file = labelled / NAME
        if how == "moved":
            file.rename(tmp_path / "elsewhere")
        elif how == "removed":
            for end in ("", "-wal", "-shm"):
                (labelled / (NAME + end)).unlink(missing_ok=True)
        elif how == "replaced":
            shutil.copy(file, tmp_path / "copy")
            (tmp_path / "copy").replace(file)
        else:
            (labelled / f"{NAME}-wal").unlink()
        body = {"id": "id-2", "revision": answer.json()["revision"], "operation": asked}
        answer = page.post(f"{at}/operations", json=body)
        assert answer.status_code == 507
        assert "was moved, removed or replaced while it was open" in answer.json()["detail"]


def test_a_file_that_stays_is_confirmed(tmp_path):
    path = tmp_path / NAME
    path.write_bytes(b"x")
    place = Place(path)
    place.confirm()
    path.write_bytes(b"more")
    place.confirm()
    path.unlink()
    with pytest.raises(StoreError, match="was moved"):
        place.confirm()


@pytest.mark.parametrize("content", [b"x", b"SQLite", b"SQLite format 3\0", b"\0" * 4096])
def test_a_file_that_is_no_database_is_a_sentence(content, folder, capsys):
    (folder / NAME).write_bytes(content)
    for command in ("status", "export", "agreement", "backup", "open", "repair"):
        assert run(command, folder) == 1
        said = capsys.readouterr().err
        assert NAME in said
        assert said.count("\n") == 1
        assert "Traceback" not in said
    assert (folder / NAME).read_bytes() == content


def test_a_folder_or_a_device_in_its_place_is_a_sentence(folder, capsys):
    (folder / NAME).symlink_to("/dev/zero")
    for command in ("status", "export", "backup", "open", "repair"):
        assert run(command, folder) == 1
        assert "labels are kept in a file" in capsys.readouterr().err
    (folder / NAME).unlink()
    (folder / NAME).mkdir()
    assert run("status", folder) == 1


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


def test_labels_from_before_comments_keep_their_standings(tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(database, "MIGRATIONS", MIGRATIONS[:5])
        database.connect(write_hills(tmp_path, count=1)).close()
    with closing(sqlite3.connect(tmp_path / NAME)) as old, old:
        old.execute("INSERT INTO photos VALUES (1, 'old', 'hill-0.png', 70, 48, 0, 0, NULL, NULL)")
        old.execute("INSERT INTO labels (id, photo, annotator, number) VALUES (1, 1, 'ann', 1)")
        body = '{"kind": "status", "status": "needs review"}'
        old.execute(f"INSERT INTO operations VALUES (1, 1, 2.0, 'status', '{body}', NULL, NULL)")
        old.execute("INSERT INTO standings VALUES (1, 1, 1, 'needs review', '[\"fog\"]', 9.0)")
    store = Store(tmp_path)
    card = store.cards("ann", 1)[1]
    assert (card.status, card.tags, card.seconds) == (
        "needs review",
        ("fog",),
        9.0,
    )  # not made anew
    assert (card.comment, store.state(1).comment) == (None, None)
    words = {"status": "needs review", "comment": "the hut", "by": "eve"}
    store.append(1, -1, "status", words)
    assert str(store.cards("ann", 1)[1].comment) == "eve: the hut"
    store.close()


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
