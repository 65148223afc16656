"""Parquet files here and in storages."""

import pytest

from skyline_viz.datasets.dataset import DatasetError
from skyline_viz.datasets.tables.parquet_files import files_of, is_label_table, parquet
from testing.datasets import SKYLINE, row_of, write_labels


@pytest.mark.parametrize("where", ["a.parquet", "A.PARQUET", "s3://b/a.parquet/", "x\\a.parquet\\"])
def test_the_ending_tells(where):
    assert is_label_table(where)


@pytest.mark.parametrize("where", ["parquet", "a.parquet.csv", "s3://a.parquet/b"])
def test_other_endings_do_not(where):
    assert not is_label_table(where)


def test_files_are_in_order_and_others_are_not_looked_at(tmp_path):
    for name in ("b", "a"):
        write_labels(tmp_path / "t.parquet" / f"{name}.parquet", [row_of("a.png", SKYLINE)])
    (tmp_path / "t.parquet" / "_SUCCESS").touch()
    names = [file.rpartition("/")[2] for file in files_of(f"{tmp_path}/t.parquet")]
    assert names == ["a.parquet", "b.parquet"]


def test_a_file_that_may_not_be_read_is_named(tmp_path):
    (tmp_path / "t.parquet").mkdir()
    with (
        pytest.raises(DatasetError, match=r"t\.parquet cannot be read: is a directory"),
        parquet(str(tmp_path / "t.parquet")),
    ):
        pass
