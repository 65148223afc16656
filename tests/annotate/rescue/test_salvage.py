"""Files of labels with damaged pages: every row that can be read is saved."""

import json
import os
import random
import sqlite3
from contextlib import closing

import pytest

from annotate.store.database import NAME, DamagedError
from annotate.store.store import Store
from testing.labelling import write_hills
from testing.labels import change, label, run


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


@pytest.fixture
def labelled(folder):
    return label(folder, row=11, photos=3)


def many(folder, count=12):
    """A folder with many labels, so that its file has many pages."""
    write_hills(folder, count)
    return label(folder, row=11, photos=count)


def test_a_damaged_file_is_saved_as_far_as_it_can_be_read(tmp_path, capsys):
    folder = many(tmp_path / "alps", 40)
    path = folder / NAME
    with closing(sqlite3.connect(path)) as database:
        database.execute("PRAGMA journal_mode = DELETE")
        size = database.execute("PRAGMA page_size").fetchone()[0]
        (page,) = (
            database.execute(
                "SELECT pageno FROM dbstat WHERE name = 'operations' AND pagetype = 'leaf'"
                " ORDER BY pageno DESC"
            ).fetchone()
            if _has_dbstat(database)
            else (None,)
        )
    if page is None:
        pytest.skip("this SQLite does not tell where its pages are")
    data = bytearray(path.read_bytes())
    data[(page - 1) * size : page * size] = os.urandom(size)
    path.write_bytes(data)
    with pytest.raises(DamagedError, match="skyline-annotate repair"):
        Store(folder)
    assert run("export", folder, "--out", tmp_path / "no") == 1
    capsys.readouterr()
    assert run("repair", folder) == 1
    said = capsys.readouterr().err
    assert "what can be read is in a new one" in said
    assert "operations are lost" in said
    (kept,) = folder.glob("skyline-labels-damaged-*.sqlite")
    assert kept.read_bytes() == data
    store = Store(folder, reading=True)
    left = list(store.labels())
    assert all(set(one.skyline.rows) == {11} for one in left if one.status == "accepted")
    assert store.unreadable == []
    assert 0 < len([one for one in left if one.status == "accepted"]) < 40
    assert len(left) + len(store.set_aside()) == 40
    store.close()


def _has_dbstat(database):
    try:
        database.execute("SELECT 1 FROM dbstat LIMIT 1")
    except sqlite3.OperationalError:
        return False
    return True


def ruin(folder, *tables):
    """Fill the first page of tables, or indexes, with random bytes; return the numbers of these."""
    with closing(sqlite3.connect(folder / NAME)) as database:
        database.execute("PRAGMA journal_mode = DELETE")
        size = database.execute("PRAGMA page_size").fetchone()[0]
        marks = ", ".join("?" * len(tables))
        roots = database.execute(
            f"SELECT rootpage FROM sqlite_schema WHERE name IN ({marks})",
            tables,
        )
        pages = [root for (root,) in roots]
    with (folder / NAME).open("r+b") as file:
        for page in pages:
            file.seek((page - 1) * size)
            file.write(random.Random(page).randbytes(size))
    return pages


@pytest.mark.parametrize("table", ["photos", "labels", "standings", "sqlite_autoindex_photos_1"])
def test_a_damaged_page_of_a_table_costs_no_line(table, labelled, tmp_path, capsys):
    (page,) = ruin(labelled, table)
    for words in (["status"], ["export", "--out", tmp_path / "no"], ["open"], ["backup"]):
        assert run(words[0], labelled, *words[1:]) == 1
        said = capsys.readouterr().err
        assert f"{NAME} is damaged (page {page}); skyline-annotate repair {labelled} saves" in said
        assert said.count("\n") == 1
        assert "***" not in said
    assert run("repair", labelled) in (0, 1)
    said = capsys.readouterr().err
    assert "lost" not in said
    assert "set aside" not in said
    store = Store(labelled, reading=True)
    store.find()
    lines = {one.name: set(one.skyline.rows) for one in store.labels() if one.skyline}
    store.close()
    assert lines == {f"hill-{number}.png": {11} for number in range(3)}


def test_a_label_whose_photo_is_lost_is_kept_as_one_without_its_photo(labelled, tmp_path, capsys):
    ruin(labelled, "photos", "sqlite_autoindex_photos_1")
    assert run("repair", labelled) == 1
    assert "3 photos of labels are lost, and nothing tells which" in capsys.readouterr().err
    assert run("status", labelled) == 0
    assert "3 labels belong to photos that are not here any more" in capsys.readouterr().err
    out = tmp_path / "out"
    assert run("export", labelled, "--orphans", "--out", out) == 0
    for file in out.glob("*.csv"):
        rows = [line.split(",")[1] for line in file.read_text().splitlines()[1:]]
        assert rows == ["11"] * 70
    assert len(list(out.glob("*.csv"))) == 3


def test_operations_whose_label_is_lost_are_set_aside_in_a_file(labelled, capsys):
    count = change(labelled, "SELECT count(*) FROM operations")[0]
    ruin(labelled, "labels", "sqlite_autoindex_labels_1")
    assert run("repair", labelled) == 1
    said = capsys.readouterr().err
    (file,) = labelled.glob("skyline-labels-set-aside-*.json")
    assert (
        f"{count} operations belong to labels that are lost, and are set aside in {file.name}"
        in (said)
    )
    kept = json.loads(file.read_text())
    assert len(kept) == count
    assert [11] * 70 in [one["line"] for one in kept]


def test_a_label_that_cannot_be_read_is_not_counted_as_what_it_was(labelled, capsys):
    label = "(SELECT label FROM operations WHERE line IS NOT NULL LIMIT 1)"
    lines = f"SELECT max(id) FROM operations WHERE line IS NOT NULL AND label = {label}"
    with closing(sqlite3.connect(labelled / NAME)) as database, database:
        database.execute("DROP TRIGGER operations_stay")
        database.execute(f"UPDATE operations SET line = x'0102' WHERE id = ({lines})")
    assert run("status", labelled) == 0
    said = capsys.readouterr()
    (row,) = [line.split() for line in said.out.splitlines() if line.startswith("ann ")]
    assert row[:7] == ["ann", "1", "0", "0", "2", "1", "0"]
    assert "cannot be read" in said.err


@pytest.mark.parametrize("seed", range(12))
def test_random_damage_is_a_sentence_and_never_another_line(seed, tmp_path, capsys):
    folder = many(tmp_path / "alps", 6)
    chance = random.Random(seed)
    path = folder / NAME
    data = bytearray(path.read_bytes())
    for _ in range(chance.randint(1, 7)):
        data[chance.randrange(100, len(data))] = chance.randrange(256)
    path.write_bytes(data)
    for words in (["status"], ["export", "--out", tmp_path / "out", "--annotator", "ann"]):
        assert run(words[0], folder, *words[1:]) in (0, 1, 2)
    assert run("repair", folder) in (0, 1)
    run("status", folder)
    assert "Traceback" not in capsys.readouterr().err
    for file in (tmp_path / "out").glob("*.csv"):
        rows = {line.split(",")[1] for line in file.read_text().splitlines()[1:]}
        assert rows == {"11"}
