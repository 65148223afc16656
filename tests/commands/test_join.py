"""``skyline-viz join``: what it refuses; that shards come together, `test_to_table` tells."""

import fsspec
import pyarrow.parquet as pq
import pytest

from skyline_viz.running.line_table import failed_row, write_lines
from skyline_viz.running.shards import Shard
from skyline_viz.storage.copies import CACHE
from testing.programs.s3 import s3 as started_s3


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("gone", "--out", "t.parquet"), "gone is no folder of shards."),
        (
            ("parts", "--out", "t.csv"),
            "name a file that ends in .parquet for a table, or in .npz for a detector, not t.csv.",
        ),
        (("parts", "--out", "t.parquet"), "parts holds no shards, shard-00001-of-0000N.parquet"),
    ],
)
def test_what_cannot_be_joined_is_said(say, tmp_path, words, said):
    (tmp_path / "parts").mkdir()
    status, out, err = say("join", *words)
    assert (status, out) == (2, "")
    assert err.startswith(f"skyline-viz: {said}")


def test_a_missing_shard_is_named_and_nothing_is_written(say, tmp_path):
    write_lines(tmp_path / "parts" / Shard(1, 2).file, [], {"digest": "d"})
    status, _, err = say("join", "parts", "--out", "t.parquet")
    assert (status, err) == (2, "skyline-viz: parts lacks the shard 2/2.\n")
    assert not (tmp_path / "t.parquet").exists()


@pytest.fixture
def results(monkeypatch, tmp_path):
    """A storage, and a table of a shard that is there, one of two."""
    with started_s3(monkeypatch):
        monkeypatch.setenv(CACHE, str(tmp_path / "caches"))
        write_lines(tmp_path / "t.parquet", [failed_row(ODD[1], "so")], {"digest": "d"})
        storage = fsspec.filesystem("s3")
        storage.put(str(tmp_path / "t.parquet"), f"photos/t.parquet/{Shard(1, 2).file}")
        yield storage


ODD = {
    shard: next(name for name in map(str, range(99)) if Shard(shard, 2).holds(name))
    for shard in (1, 2)
}


def test_shards_of_a_storage_become_a_table_there(say, results, tmp_path):
    write_lines(tmp_path / "u.parquet", [failed_row(ODD[2], "so")], {"digest": "d"})
    results.put(str(tmp_path / "u.parquet"), f"photos/t.parquet/{Shard(2, 2).file}")
    for out in ("s3://photos/all.parquet", "all.parquet"):
        status, said, _ = say("join", "s3://photos/t.parquet", "--out", out)
        assert (status, said) == (0, f"2 photos in {out}\n")
    results.get("photos/all.parquet", str(tmp_path / "there.parquet"))
    for table in ("there.parquet", "all.parquet"):
        found = pq.read_table(tmp_path / table).column("photo").to_pylist()
        assert found == [ODD[1], ODD[2]]


def test_what_a_storage_lacks_is_named_by_its_address(say, results):
    status, _, err = say("join", "s3://photos/t.parquet", "--out", "s3://photos/all.parquet")
    assert (status, err) == (2, "skyline-viz: s3://photos/t.parquet lacks the shard 2/2.\n")
    assert not results.exists("photos/all.parquet")


def test_a_detector_goes_to_no_address(say, results):
    status, _, err = say("join", "s3://photos/t.parquet", "--out", "s3://photos/bank.npz")
    assert status == 2
    assert "name a file that ends in .parquet for a table" in err


@pytest.mark.parametrize(
    "out", ["all.parquet", "shard-00001-of-00002.parquet", "b.npz", "in/a.npz"]
)
def test_nothing_is_written_among_the_shards(say, tmp_path, out):
    for shard in (1, 2):
        rows = [failed_row(ODD[shard], "so")]
        write_lines(tmp_path / "j.parquet" / Shard(shard, 2).file, rows, {"digest": "d"})
    before = {path: path.read_bytes() for path in (tmp_path / "j.parquet").iterdir()}
    status, _, err = say("join", "j.parquet", "--out", f"j.parquet/{out}")
    said = f"j.parquet/{out} is the folder of the shards or lies in it, and that is to hold shards"
    assert (status, err) == (2, f"skyline-viz: {said} alone; name another --out.\n")
    assert {path: path.read_bytes() for path in (tmp_path / "j.parquet").iterdir()} == before


def test_nothing_is_written_among_the_shards_of_a_storage(say, results):
    words = ("join", "s3://photos/t.parquet/", "--out", "s3://photos/t.parquet/all.parquet")
    assert "lies in it, and that is to hold shards alone" in say(*words)[2]
    assert results.ls("photos/t.parquet") == [f"photos/t.parquet/{Shard(1, 2).file}"]


def test_a_table_by_the_name_of_another_shard_is_refused(say, tmp_path):
    for shard in (1, 2):
        about = {"digest": "d", "shard": "2/2"}
        write_lines(tmp_path / "parts" / Shard(shard, 2).file, [], about)
    assert say("join", "parts", "--out", "t.parquet")[2] == (
        "skyline-viz: parts/shard-00001-of-00002.parquet holds the shard 2/2, and by its name it "
        "is 1/2.\n"
    )
