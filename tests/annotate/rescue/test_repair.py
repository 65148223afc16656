"""Labels can be read wherever they lie; what is damaged is a sentence, and can be repaired."""

import json
import os
import random
import shutil
import sqlite3
from contextlib import closing

import pytest

import annotate.store.snapshot as snapshots
from annotate.cli import main
from annotate.store.database import NAME, DamagedError, Place, StoreError
from annotate.store.store import Store
from testing.labelling import served, workbench, write_hills
from tests.annotate.commands.test_cli import label
from tests.annotate.work.test_importing import POISON, poisoned


def run(*words):
    return main([str(word) for word in words])


@pytest.fixture
def folder(tmp_path):
    return write_hills(tmp_path / "alps")


@pytest.fixture
def labelled(folder):
    return label(folder, row=11, photos=3)


def names_below(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


def change(folder, statement, *values):
    with closing(sqlite3.connect(folder / NAME)) as database, database:
        database.execute("PRAGMA ignore_check_constraints = ON")
        return database.execute(statement, values).fetchone()


# Reading writes nothing


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


# A database that is moved away


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


# Damaged files


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
