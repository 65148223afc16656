"""A journal that SQLite would read in part only is said, refused to be written, and repaired."""

import os
import shutil
import sqlite3
from contextlib import closing

import pytest

from annotate.cli import main
from annotate.store import journal
from annotate.store.database import NAME, DamagedError
from annotate.store.store import Store
from testing.labelling import workbench, write_hills
from testing.labels import label

WAL = f"{NAME}-wal"
SHM = f"{NAME}-shm"


def run(*words):
    return main([str(word) for word in words])


@pytest.fixture
def killed(tmp_path):
    """A folder as a server leaves it that was killed after four photos had been accepted."""
    folder = write_hills(tmp_path / "alive", 4)
    workbench(folder).close()  # makes the file
    with closing(sqlite3.connect(folder / NAME)) as other:  # keeps the journal from being ended
        other.execute("SELECT * FROM photos").fetchall()
        label(folder, row=11, photos=4)
        shutil.copytree(folder, tmp_path / "alps")
    return tmp_path / "alps"


def flip(path, at):
    data = bytearray(path.read_bytes())
    data[int(at * len(data)) if isinstance(at, float) else at] ^= 1
    path.write_bytes(data)


def accepted(folder):
    store = Store(folder, reading=True)
    found = [one for one in store.labels() if one.status == "accepted"]
    store.close()
    assert all(set(one.skyline.rows) == {11} for one in found)
    return len(found)


def test_a_sound_journal_is_no_fault(killed):
    assert journal.fault(killed / NAME) == ""
    assert accepted(killed) == 4


DAMAGES = {
    "a third": lambda wal: flip(wal, 1 / 3),
    "salts": lambda wal: flip(wal, 32 + 4 * 4120 + 8),
    "the last frame": lambda wal: flip(wal, -9),
    "the beginning": lambda wal: flip(wal, 17),
    "the end": lambda wal: os.truncate(wal, wal.stat().st_size * 2 // 3),
    "zeros": lambda wal: wal.write_bytes(bytes(wal.stat().st_size)),
    "missing": lambda wal: wal.unlink(),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_journal_is_said_by_every_command_and_kept(damage, killed, tmp_path, capsys):
    DAMAGES[damage](killed / WAL)
    before = {file.name: file.read_bytes() for file in killed.iterdir()}
    for words in (
        ["status"],
        ["export", "--annotator", "ann", "--out", tmp_path / "out"],
        ["agreement"],
        ["backup", "--out", tmp_path / "kept.sqlite"],
        ["open", "--no-browser"],
    ):
        assert run(words[0], killed, *words[1:]) in (1, 2)
        said = capsys.readouterr().err
        assert f"{WAL} is " in said
        assert f"skyline-annotate repair {killed}" in said
    with pytest.raises(DamagedError, match="journal"):
        Store(killed)
    assert {name: (killed / name).read_bytes() for name in before} == before
    assert run("repair", killed) == 1
    assert "changes that were kept last may be missing" in capsys.readouterr().err
    kept = {file.name.partition(".")[2]: file for file in killed.glob("*-damaged-*")}
    assert kept["sqlite"].read_bytes() == before[NAME]
    if damage != "missing":
        assert kept["sqlite-wal"].read_bytes() == (before[WAL])
    assert run("status", killed) == 0
    Store(killed).close()


@pytest.mark.parametrize("damage", ["a third", "salts", "the beginning"])
def test_what_lies_behind_the_damage_is_saved(damage, killed):
    DAMAGES[damage](killed / WAL)
    assert accepted(killed) < 4
    assert run("repair", killed) == 1
    assert accepted(killed) == 4


def test_a_frame_that_was_torn_by_a_power_failure_is_no_damage(killed):
    """Nothing was called saved on it, as the index would say, which goes with the machine."""
    (killed / SHM).unlink()
    whole = (killed / WAL).read_bytes()
    flip(killed / WAL, -9)
    assert journal.fault(killed / NAME) == ""
    (killed / WAL).write_bytes(whole + whole[-4120:-2000])
    assert journal.fault(killed / NAME) == ""
    flip(killed / WAL, 32 + 100)
    assert "at frame 1 of" in journal.fault(killed / NAME)


def test_frames_from_before_the_journal_was_begun_anew_are_no_damage(killed):
    with closing(sqlite3.connect(killed / NAME)) as database:
        size = (killed / WAL).stat().st_size
        database.execute("PRAGMA wal_checkpoint(RESTART)").fetchall()
        database.execute("UPDATE photos SET size = size + 1")
        database.commit()
        assert (killed / WAL).stat().st_size == size
        assert journal.fault(killed / NAME) == ""


def test_the_file_can_be_told_without_its_journal(tmp_path, capsys):
    folder = write_hills(tmp_path / "alps", 1)
    store = Store(folder)
    with closing(sqlite3.connect(f"file:{folder / NAME}?immutable=1", uri=True)) as database:
        assert database.execute("PRAGMA application_id").fetchone() == (0x534B594C,)
    store.close()
    (folder / NAME).unlink()
    with closing(sqlite3.connect(folder / NAME)) as database:
        database.execute("PRAGMA journal_mode = WAL")
    assert run("status", folder) == 1
    assert "its journal skyline-labels.sqlite-wal is missing" in capsys.readouterr().err
