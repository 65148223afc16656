"""Tables of skylines: what a row holds, and that others read it."""

import json

import duckdb
import numpy as np
import polars as pl
import pyarrow.parquet as pq
import pytest

import skyline_viz as sv
from skyline_viz.running import line_table
from skyline_viz.running.line_table import (
    QUANTILES,
    TableError,
    failed_row,
    found_row,
    photos_in,
    read_about,
    read_rows,
    schema,
    write_lines,
)
from testing.programs.commands import scene


@pytest.fixture(scope="module")
def found():
    return sv.Detector().detect(scene(0)[0])


@pytest.fixture
def table(found, tmp_path):
    rows = [found_row("s3://b/a.jpg", "ETag 1", "ab", found), failed_row("b.jpg", "it is empty.")]
    assert write_lines(tmp_path / "t.parquet", rows, {"digest": "d", "run": {"é": 1}}) == 2
    return tmp_path / "t.parquet"


def test_a_row_holds_what_was_found(found, table):
    one, other = pq.read_table(table).to_pylist()
    assert (one["photo"], one["stamp"], one["sha256"]) == ("s3://b/a.jpg", "ETag 1", "ab")
    assert (one["height"], one["width"]) == found.photo.shape[:2]
    assert sv.Skyline(rows=one["rows"], visible=np.array(one["visible"])) == found.skyline
    wanted = np.quantile(found.margins(), QUANTILES, method="lower")
    assert [one[f"margin_{name}"] for name in ("05", "25", "50", "75", "95")] == wanted.tolist()
    assert (one["confidence"], one["case"]) == (found.confidence, found.visibility.case)
    assert one["seconds"] == found.total_seconds
    assert one["error"] is None
    told = {name: value for name, value in other.items() if value is not None}
    assert told == {"photo": "b.jpg", "error": "it is empty."}


def test_it_is_read_by_others_with_one_line(table):
    folder = table.parent
    assert pl.read_parquet(table)["photo"].to_list() == ["s3://b/a.jpg", "b.jpg"]
    assert pl.scan_parquet(folder / "*.parquet").collect().height == 2
    count = duckdb.sql(f"select count(*) from '{table}' where error is null").fetchall()
    assert count == [(1,)]
    assert pq.read_table(folder).num_rows == 2


def test_many_rows_go_in_groups_and_come_out_the_same(found, tmp_path, monkeypatch):
    monkeypatch.setattr(line_table, "_GROUP", 2)
    rows = [found_row(f"{number}.jpg", "", f"{number}", found) for number in range(5)]
    path = tmp_path / "t.parquet"
    write_lines(path, iter(rows), {})
    assert pq.ParquetFile(path).num_row_groups == 3
    read = list(read_rows(path))
    assert [known["photo"] for known, _ in read] == [f"{number}.jpg" for number in range(5)]
    write_lines(tmp_path / "again.parquet", [row for _, row in read], {})
    assert pq.read_table(tmp_path / "again.parquet").equals(pq.read_table(path))


def test_a_table_without_a_photo_is_one(tmp_path):
    assert write_lines(tmp_path / "t.parquet", [], {}) == 0
    assert pq.read_schema(tmp_path / "t.parquet").equals(schema())


def test_what_made_it_stands_in_it(table):
    assert read_about(table) == {"digest": "d", "run": {"é": 1}}


@pytest.mark.parametrize("content", [b"", b"PAR1 and no more", b"a,b\n1,2\n" * 20])
def test_other_files_are_refused(tmp_path, content):
    (tmp_path / "t.parquet").write_bytes(content)
    with pytest.raises(TableError, match=r"t\.parquet is damaged, or no Parquet table\.$"):
        read_about(tmp_path / "t.parquet")


def test_damage_within_is_said_in_plain_words(found, tmp_path):
    path = tmp_path / "t.parquet"
    write_lines(path, [found_row("a.jpg", "", "ab", found)], {})
    data = bytearray(path.read_bytes())
    data[4 : len(data) // 2] = bytes(len(data) // 2 - 4)
    path.write_bytes(data)
    for read in (read_rows, photos_in):
        with pytest.raises(TableError) as caught:
            list(read(path))
        assert str(caught.value) == f"{path} is damaged."


def test_photos_of_a_table_are_named(table):
    assert list(photos_in(table)) == ["s3://b/a.jpg", "b.jpg"]


def test_tables_of_others_are_refused(table, tmp_path):
    other = tmp_path / "o.parquet"
    pq.write_table(pq.read_table(table).replace_schema_metadata(None), other)
    with pytest.raises(TableError, match=r"is no table of skylines\.$"):
        read_about(other)
    about = {"skyline": json.dumps({})}
    pq.write_table(pq.read_table(table).drop(["case"]).replace_schema_metadata(about), other)
    with pytest.raises(TableError, match=r"is a table of skylines of another version\.$"):
        read_about(other)


def test_a_missing_table_is_an_error_of_the_disk(tmp_path):
    with pytest.raises(FileNotFoundError):
        read_about(tmp_path / "gone.parquet")


def test_a_run_that_breaks_off_leaves_the_table_that_was_there(table):
    def rows():
        yield failed_row("c.jpg", "x")
        raise KeyboardInterrupt

    before = table.read_bytes()
    with pytest.raises(KeyboardInterrupt):
        write_lines(table, rows(), {})
    assert table.read_bytes() == before
    assert [file.name for file in table.parent.iterdir()] == [table.name]
