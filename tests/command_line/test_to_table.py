"""``detect`` into a table: storages, shards, clusters, and what is refused."""

import os
import sys

import boto3
import fsspec
import pyarrow.parquet as pq
import pytest
import s3fs

import skyline_viz as sv
from skyline_viz.command_line.messages import UsageError
from skyline_viz.command_line.to_table import is_table_name, shard_of, table_of
from skyline_viz.running.line_table import read_about
from skyline_viz.running.shards import Shard
from testing.programs.commands import scene, write_scene
from testing.programs.s3 import s3 as started_s3


@pytest.fixture
def bucket(monkeypatch, tmp_path):
    monkeypatch.setattr(s3fs.S3FileSystem, "retries", 1)
    monkeypatch.setattr("skyline_viz.storage.fetching.pause", lambda _: None)
    with started_s3(monkeypatch) as moods:
        for number in range(5):
            data = write_scene(tmp_path / "x.png", number).read_bytes()
            fsspec.filesystem("s3").pipe(f"photos/in/p{number}.png", data)
        (tmp_path / "x.png").unlink()
        yield moods


def rows(path):
    return {row["photo"]: row for row in pq.read_table(path).to_pylist()}


def test_a_bucket_becomes_a_table_and_the_next_run_downloads_nothing(say, bucket, tmp_path):
    bucket.busy, bucket.torn = 2, 1
    status, out, err = say("detect", "s3://photos/in", "--out", "t.parquet", "--workers", "1")
    assert (status, out, err) == (0, "5 skylines in t.parquet\n", "")
    found = rows(tmp_path / "t.parquet")
    assert list(found) == [f"s3://photos/in/p{number}.png" for number in range(5)]
    for number, row in enumerate(found.values()):
        line = sv.Detector().detect(scene(number)[0]).skyline
        assert row["rows"] == line.rows.tolist()
    run = read_about(tmp_path / "t.parquet")["run"]
    assert run["command"][:3] == ["skyline-viz", "detect", "s3://photos/in"]
    bucket.downloads.clear()
    status, out, _ = say("detect", "s3://photos/in", "--out", "t.parquet")
    assert (status, bucket.downloads) == (0, [])
    assert out == "5 of 5 photos were done already.\n5 skylines in t.parquet\n"


def test_photos_that_cannot_be_had_are_named_at_the_end(say, bucket, tmp_path):
    words = [f"s3://photos/in/{name}.png" for name in ("p0", "gone", "lost")]
    status, out, err = say("detect", *words, "--out", "t.parquet", "--workers", "1")
    assert (status, out) == (1, "1 skyline in t.parquet\n")
    assert err.splitlines() == [
        "skyline-viz: 2 photos failed:",
        "skyline-viz: s3://photos/in/gone.png does not exist.",
        "skyline-viz: s3://photos/in/lost.png does not exist.",
    ]
    assert rows(tmp_path / "t.parquet")[words[1]]["error"] == f"{words[1]} does not exist."


def test_a_bucket_becomes_a_folder_of_lines_too(say, bucket, tmp_path):
    status, out, err = say("detect", "s3://photos/in", "--out", "out", "--workers", "1")
    assert (status, err) == (0, "")
    assert "5 skylines in out" in out
    found = sv.Skyline.read_csv(tmp_path / "out" / "p3.csv")
    assert found == sv.Detector().detect(scene(3)[0]).skyline
    assert "s3://photos/in/p3.png" in (tmp_path / "out" / "skylines.csv").read_text()


def test_shards_are_joined(say, bucket, tmp_path):
    assert say("detect", "s3://photos/in", "--out", "whole.parquet", "--workers", "1")[0] == 0
    for number in (1, 2):
        words = ("--out", "parts.parquet", "--shard", f"{number}/2", "--workers", "1")
        assert say("detect", "s3://photos/in", *words)[0] == 0
    assert say("join", "parts.parquet", "--out", "joined.parquet")[:2] == (
        0,
        "5 photos in joined.parquet\n",
    )
    joined, whole = rows(tmp_path / "joined.parquet"), rows(tmp_path / "whole.parquet")
    assert joined.keys() == whole.keys()
    assert all(joined[photo]["rows"] == whole[photo]["rows"] for photo in whole)


def test_a_cluster_finds_the_same(say, hills, tmp_path):
    assert say("detect", hills, "--out", "pool.parquet", "--workers", "1")[0] == 0
    status, out, err = say("detect", hills, "--out", "two.parquet", "--cluster", "local:2")
    assert (status, out) == (0, "4 skylines in two.parquet\n")
    assert err.startswith("skyline-viz: the cluster shows what it does at http://127.0.0.1:")
    one, two = rows(tmp_path / "pool.parquet"), rows(tmp_path / "two.parquet")
    assert [row["rows"] for row in one.values()] == [row["rows"] for row in two.values()]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--out", "d", "--shard", "1/2"), "--shard writes one table"),
        (("--out", "d", "--cluster", "local:2", "--workers", "2"), "--workers are processes"),
        (("--out", "t.parquet", "--mask"), "--mask writes files into a folder"),
        (("--out", "t.parquet", "--shard", "3/2"), "--shard is I/N"),
        (("--out", "t.parquet", "--cluster", "here"), "a cluster is tcp://HOST:PORT"),
        (("--out", "t.parquet", "--cluster", "local:1", "--workers", "2"), "--workers are"),
    ],
)
def test_what_makes_no_sense_is_refused(say, hills, words, said):
    status, out, err = say("detect", hills, *words)
    assert (status, out) == (2, "")
    assert err.startswith(f"skyline-viz: {said}")
    assert len(err.splitlines()) == 1


def test_a_table_and_a_folder_of_shards_are_told_apart(tmp_path):
    (tmp_path / "folder.parquet").mkdir()
    (tmp_path / "file.parquet").touch()
    assert is_table_name("s3://b/a.Parquet")
    assert not is_table_name("b/parquet")
    assert shard_of(None) is None
    shard = shard_of("1/2")
    assert table_of(tmp_path / "new.parquet", shard) == tmp_path / "new.parquet" / Shard(1, 2).file
    with pytest.raises(UsageError, match="is a folder of shards"):
        table_of(tmp_path / "folder.parquet", None)
    with pytest.raises(UsageError, match="is a file; shards go into a folder"):
        table_of(tmp_path / "file.parquet", shard)


def test_a_table_goes_to_an_address_and_the_next_run_goes_on(say, bucket, tmp_path, monkeypatch):
    monkeypatch.setenv("SKYLINE_VIZ_CACHE", str(tmp_path / "cache"))
    words = ("detect", "s3://photos/in", "--out", "s3://photos/out/t.parquet", "--workers", "1")
    assert say(*words) == (0, "5 skylines in s3://photos/out/t.parquet\n", "")
    (tmp_path / "t.parquet").write_bytes(fsspec.filesystem("s3").cat("photos/out/t.parquet"))
    assert len(rows(tmp_path / "t.parquet")) == 5
    status, out, _ = say(*words)
    assert (status, out.splitlines()[0]) == (0, "5 of 5 photos were done already.")
    assert [one for one in (tmp_path / "cache").rglob("*") if one.is_file()] == []
    said = say("detect", "s3://photos/in", "--out", "s3://photos/out")[2]
    assert said == "skyline-viz: files go into a folder; an address takes a table, FILE.parquet.\n"


@pytest.mark.parametrize(
    ("out", "said"),
    [
        ("s3://nobucket/t.parquet", "there is no such bucket or folder."),
        ("s3://t.parquet", "it names a bucket, and no file in it."),
        ("https://host.invalid/t.parquet", "web servers give files, and take none."),
    ],
)
def test_where_no_table_can_be_written_no_photo_is_read(
    say, bucket, tmp_path, monkeypatch, out, said
):
    monkeypatch.setenv("SKYLINE_VIZ_CACHE", str(tmp_path / "cache"))
    status, told, err = say("detect", "s3://photos/in", "--out", out, "--workers", "1")
    assert (status, told, err) == (2, "", f"skyline-viz: {out} cannot be written: {said}\n")
    assert bucket.downloads == []


def test_rows_that_go_with_other_photos_are_said(say, hills, bucket):
    assert say("detect", "s3://photos/in", "--out", "t.parquet", "--workers", "1")[0] == 0
    words = ("detect", "s3://photos/in/p1.png", "--out", "t.parquet", "--workers", "1")
    assert say(*words)[1].splitlines() == [
        "1 of 1 photo was done already.",
        "4 rows of the earlier table went: of photos that this command does not name.",
        "1 skyline in t.parquet",
    ]


def test_odd_keys_are_detected_or_named(say, bucket, tmp_path):
    data = write_scene(tmp_path / "x.png", 1).read_bytes()
    client = boto3.client("s3")
    for key in ("q?.png", "q?x.png", "d//dbl.png", "dots/../up.png", "::x.png"):
        client.put_object(Bucket="photos", Key=f"odd/{key}", Body=data)
    words = ("detect", "s3://photos/odd", "--out", "t.parquet", "--workers", "1")
    status, out, err = say(*words)
    assert (status, out) == (1, "4 skylines in t.parquet\n")
    reason = "s3://photos/odd/::x.png cannot be downloaded: a name that holds :: has no address."
    assert err == f"skyline-viz: {reason}\n"
    assert len(rows(tmp_path / "t.parquet")) == 5


def test_names_that_are_no_text_fail_alone_also_in_shards(say, tmp_path):
    for name in (b"a.png", b"b\xff.png", b"c\xfe.png", b"d.png"):
        write_scene(tmp_path / "x.png", 1).rename(tmp_path / os.fsdecode(name))
    odd = os.fsdecode(b"c\xfe.png")
    for number in (1, 2):
        words = ("--out", "t.parquet", "--shard", f"{number}/2", "--workers", "1")
        say("detect", "a.png", os.fsdecode(b"b\xff.png"), odd, "d.png", *words)
    assert say("join", "t.parquet", "--out", "all.parquet")[:2] == (0, "4 photos in all.parquet\n")
    found = rows(tmp_path / "all.parquet")
    assert [row["error"] for name, row in sorted(found.items()) if row["error"]] == [
        f"{name} has a name that is no text, and a table holds text; rename it."
        for name in ("b\\xff.png", "c\\xfe.png")
    ]


def test_without_pyarrow_nothing_is_left_behind(say, hills, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    status, _, err = say("detect", hills, "--out", "t.parquet")
    assert (status, err[:45]) == (2, "skyline-viz: a Parquet table needs pyarrow; i")
    assert [*tmp_path.glob("t.parquet*")] == []
