"""Reading labels writes nothing beside them, wherever they lie."""

import shutil
import sqlite3
from contextlib import closing

import pytest

import annotate.store.snapshot as snapshots
from annotate.store.database import NAME
from annotate.store.store import Store
from testing.labelling import served, write_hills
from testing.labels import label, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


@pytest.fixture
def labelled(folder):
    return label(folder, row=11, photos=3)


def names_below(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


READING = [
    ["status"],
    ["export", "--out", "out"],
    ["export", "--format", "json", "--out", "out"],
    ["backup", "--out", "kept.sqlite"],
    ["agreement"],
]


@pytest.mark.parametrize("words", READING)
@pytest.mark.parametrize("journal", [False, True])
def test_labels_are_read_and_nothing_is_written_beside_them(
    words, journal, labelled, tmp_path, monkeypatch, capsys
):
    label(labelled, "bob", row=13, photos=3)
    if journal:  # as a server leaves it that was killed: a journal, and nothing to share it with
        with closing(sqlite3.connect(labelled / NAME)) as database:
            database.execute("PRAGMA wal_autocheckpoint = 0")
            database.execute("UPDATE photos SET size = size")
            database.commit()
            for end in ("", "-wal"):
                shutil.copy(labelled / (NAME + end), tmp_path / (NAME + end))
        for end in ("", "-wal"):
            (tmp_path / (NAME + end)).rename(labelled / (NAME + end))
    monkeypatch.chdir(tmp_path)
    before = {name: (labelled / name).read_bytes() for name in names_below(labelled)}
    who = ["--annotator", "ann"] if words[0] == "export" else []
    assert run(words[0], labelled, *words[1:], *who) == 0
    assert {name: (labelled / name).read_bytes() for name in names_below(labelled)} == before


def test_labels_are_read_where_sqlite_cannot_even_open_them(labelled, monkeypatch, capsys):
    """As on a disk that is full, or read-only: SQLite reads nothing but a copy."""
    copy = snapshots._copy

    def refuses(target, path, how):
        if path.parent == labelled and how == "mode=ro":
            raise sqlite3.OperationalError("unable to open database file")
        copy(target, path, how)

    monkeypatch.setattr(snapshots, "_copy", refuses)
    with served(labelled) as page:  # which has a journal
        assert page.get("/api/photos").status_code == 200
        store = Store(labelled, reading=True)
        assert len(list(store.labels())) == 3
        store.close()


def test_reading_a_folder_without_labels_makes_none(folder, capsys):
    for command in ("status", "export", "agreement", "backup", "repair"):
        assert run(command, folder) in (1, 2)
        assert "has no labels" in capsys.readouterr().err
    assert NAME not in names_below(folder)


def test_labels_of_an_older_version_are_read_and_stay_as_they_are(labelled, capsys):
    with closing(sqlite3.connect(labelled / NAME)) as database:
        database.execute("PRAGMA journal_mode = DELETE")
        for statement in (
            "DROP TABLE folder",
            "DROP TABLE set_aside",
            "ALTER TABLE photos DROP COLUMN pixels",
            "ALTER TABLE photos DROP COLUMN touched",
            "ALTER TABLE labels RENAME COLUMN confidence TO margin",
            "ALTER TABLE standings DROP COLUMN comment",
            "ALTER TABLE standings DROP COLUMN commented_by",
            "PRAGMA user_version = 2",
        ):
            database.execute(statement)
        database.commit()
    before = (labelled / NAME).read_bytes()
    assert run("status", labelled) == 0
    assert run("export", labelled, "--out", labelled.parent / "out") == 0
    assert "3 labels in" in capsys.readouterr().out
    assert (labelled / NAME).read_bytes() == before


def test_a_full_disk_beside_the_labels_is_told_as_what_it_is(labelled, monkeypatch, capsys):
    def full(*_):
        raise OSError(28, "No space left on device")

    (labelled / f"{NAME}-wal").write_bytes(b"x" * 100)
    monkeypatch.setattr(shutil, "copyfile", full)
    assert run("status", labelled) == 1
    assert "there is no room for one in" in capsys.readouterr().err
