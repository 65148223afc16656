"""What a run has finished: kept at once, found again, forgotten when it no longer fits."""

import errno
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.running import line_store as module
from skyline_viz.running.line_store import Known, LineStore, StoreError, line_store, store_of

KEEP = """
import os, sys
from pathlib import Path
from skyline_viz.running.line_store import line_store
with line_store(Path(sys.argv[1]), "digest") as store:
    store.keep("a.jpg", "stamp", "ab", b"row")
    os._exit(9)
"""


def test_what_is_kept_is_there_after_a_kill(tmp_path):
    table = tmp_path / "new" / "t.parquet"
    killed = subprocess.run([sys.executable, "-c", KEEP, str(table)], check=False)
    assert killed.returncode == 9
    with line_store(table, "digest") as store:
        assert (len(store), store.known("a.jpg")) == (1, Known("stamp", "ab"))
        assert store.row("a.jpg") == b"row"
        assert (store.known("b.jpg"), store.row("b.jpg")) == (None, None)


def test_another_digest_forgets_it(tmp_path):
    table = tmp_path / "t.parquet"
    with line_store(table, "one") as store:
        store.keep("a.jpg", "", "ab", b"row")
    with line_store(table, "other") as store:
        assert len(store) == 0
    with line_store(table, "one") as store:
        assert len(store) == 0


def test_two_runs_do_not_write_one_table(tmp_path):
    table = tmp_path / "t.parquet"
    with (
        line_store(table, "d"),
        pytest.raises(StoreError, match=r"^another run is writing .*t\.parquet\.$"),
        line_store(table, "d"),
    ):
        pass


def test_a_damaged_store_is_named(tmp_path):
    table = tmp_path / "t.parquet"
    store_of(table).write_bytes(b"no database at all " * 100)
    with (
        pytest.raises(StoreError, match=r"t\.parquet\.unfinished is damaged; remove it"),
        line_store(table, "d"),
    ):
        pass


@pytest.mark.parametrize(
    ("said", "kind", "match"),
    [
        ("database or disk is full", OSError, "space"),
        ("odd", StoreError, r"/t\.parquet cannot be written: odd\.$"),
    ],
)
def test_what_a_disk_refuses_is_said(tmp_path, said, kind, match):
    with pytest.raises(kind, match=match) as raised, line_store(tmp_path / "t.parquet", "d"):
        raise sqlite3.OperationalError(said)
    if kind is OSError:
        assert raised.value.errno == errno.ENOSPC


@given(st.lists(st.tuples(st.text(max_size=3), st.text(max_size=3), st.binary(max_size=5))))
def test_each_photo_is_in_it_once_as_it_was_kept_last(kept):
    database = sqlite3.connect(":memory:", isolation_level=None)
    try:
        database.executescript(module._MAKE)
        store = LineStore(database)
        for photo, stamp, row in kept:
            store.keep(photo, stamp, "ab", row)
        last = {photo: (stamp, row) for photo, stamp, row in kept}
        assert len(store) == len(last)
        for photo, (stamp, row) in last.items():
            assert (store.known(photo), store.row(photo)) == (Known(stamp, "ab"), row)
    finally:
        database.close()


@pytest.mark.skipif(sys.platform != "linux", reason="there is /proc")
def test_a_place_that_takes_no_file_is_named_by_the_table():
    said = r"^/proc/t\.parquet cannot be written: /proc takes no file\.$"
    with pytest.raises(StoreError, match=said), line_store(Path("/proc/t.parquet"), "d"):
        pass


def test_a_folder_in_its_place_is_named_by_the_table(tmp_path):
    store_of(tmp_path / "t.parquet").mkdir()
    said = r"/t\.parquet cannot be written: is a directory\.$"
    with pytest.raises(StoreError, match=said), line_store(tmp_path / "t.parquet", "d"):
        pass
