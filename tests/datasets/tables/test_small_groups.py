"""Tables in a storage or in large groups: what is kept near, for how long, and what fails."""

import errno
import os
from pathlib import Path

import fsspec
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import skyline_viz as sv
from skyline_viz.datasets.tables import small_groups as module
from skyline_viz.datasets.tables.parquet_files import version_of
from skyline_viz.datasets.tables.small_groups import in_small_groups
from skyline_viz.storage.addresses import StorageError
from skyline_viz.storage.copies import KEPT
from testing.datasets import SKYLINE, row_of, write_labels


@pytest.fixture(autouse=True)
def caches(tmp_path, monkeypatch):
    monkeypatch.setenv("SKYLINE_VIZ_CACHE", str(tmp_path / "caches"))
    monkeypatch.setattr("skyline_viz.storage.fetching.pause", lambda _: None)
    return tmp_path / "caches" / "labels"


def rows(count, **more):
    return [row_of(f"{number}.png", SKYLINE, **more) for number in range(count)]


def test_a_table_of_this_machine_in_small_groups_serves_as_it_is(tmp_path, caches):
    table = str(write_labels(tmp_path / "t.parquet", rows(5)))
    assert in_small_groups(table) == (table, version_of(table))
    assert not caches.exists()


def test_large_groups_become_small_ones_and_the_copy_is_used_again(tmp_path, caches, monkeypatch):
    monkeypatch.setattr(module, "LARGE", 4)
    monkeypatch.setattr(module, "_SMALL", 2)
    table = write_labels(tmp_path / "t.parquet", rows(5, width=24, height=16), group=5)
    near, _ = in_small_groups(str(table))
    assert pq.ParquetFile(near).metadata.row_group(0).num_rows == 2
    before = version_of(near)
    os.utime(near, (1, Path(near).stat().st_mtime))
    assert in_small_groups(str(table)) == (near, "")
    assert Path(near).stat().st_ino == int(before.split()[2])
    assert Path(near).stat().st_atime > 1  # it has been used
    write_labels(table, rows(6), group=6)
    assert in_small_groups(str(table))[0] != near
    dataset = sv.open_dataset(table)
    assert [item.truth() for item in dataset] == [SKYLINE] * 6
    assert len([*caches.iterdir()]) == 2


def test_only_what_is_needed_is_kept_with_what_made_it(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "LARGE", 1)
    table = pa.table({"photo": ["a", "b"], "rows": [[1.0], None], "name": ["x", "y"]})
    pq.write_table(table.replace_schema_metadata({"skyline": "{}"}), tmp_path / "t.parquet")
    near, _ = in_small_groups(str(tmp_path / "t.parquet"))
    schema = pq.read_schema(near)
    assert (schema.names, schema.metadata[b"skyline"]) == (["photo", "rows"], b"{}")


def test_what_nobody_has_used_for_a_month_goes(tmp_path, caches, monkeypatch):
    monkeypatch.setattr(module, "LARGE", 1)
    near, _ = in_small_groups(str(write_labels(tmp_path / "a.parquet", rows(2))))
    os.utime(near, (1, 1))
    monkeypatch.setattr(module.time, "time", lambda: KEPT + 2)
    in_small_groups(str(write_labels(tmp_path / "b.parquet", rows(2))))
    assert len([*caches.iterdir()]) == 1
    assert not Path(near).exists()


def test_a_storage_that_throttles_is_asked_again(tmp_path, s3):
    table = write_labels(tmp_path / "t.parquet", rows(3))
    fsspec.filesystem("s3").pipe("photos/t.parquet", table.read_bytes())
    s3.busy = 3
    assert len(sv.open_dataset("s3://photos/t.parquet")) == 3
    downloads = len(s3.downloads)
    items = sv.open_dataset("s3://photos/t.parquet").items
    assert [item.truth() for item in items] == [SKYLINE] * 3
    assert len(s3.downloads) == downloads  # by its ETag it is as it was


def test_a_storage_that_tells_nothing_is_read_anew(tmp_path, memory):
    for line in (SKYLINE, sv.Skyline(SKYLINE.rows + 1)):
        table = write_labels(tmp_path / "t.parquet", [row_of("a.png", line)])
        memory.pipe_file("/t.parquet", table.read_bytes())
        (item,) = sv.open_dataset("memory://t.parquet")
        assert item.truth() == line


def test_what_is_wrong_with_a_table_of_a_storage_is_said_at_once(tmp_path, memory, caches):
    memory.pipe_file("/bad.parquet", b"PAR1")
    with pytest.raises(sv.DatasetError, match=r"^memory://bad\.parquet is damaged, or no Parquet"):
        in_small_groups("memory://bad.parquet")
    pq.write_table(pa.table({"photo": ["a"]}), tmp_path / "t.parquet")
    memory.pipe_file("/t.parquet", (tmp_path / "t.parquet").read_bytes())
    with pytest.raises(sv.DatasetError, match=r"^memory://t\.parquet has no column rows"):
        in_small_groups("memory://t.parquet")
    with pytest.raises(StorageError, match=r"^memory://none\.parquet does not exist"):
        in_small_groups("memory://none.parquet")
    assert [*caches.iterdir()] == []


def test_where_the_disk_is_small_nothing_is_copied(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "LARGE", 1)
    table = write_labels(tmp_path / "t.parquet", rows(2))
    usage = type("Usage", (), {"free": 10})
    monkeypatch.setattr("skyline_viz.storage.copies.shutil.disk_usage", lambda _: usage)
    with pytest.raises(StorageError, match=r"t\.parquet needs .* SKYLINE_VIZ_CACHE names another"):
        in_small_groups(str(table))


@pytest.mark.parametrize("address", [False, True])
def test_a_full_disk_is_told_at_once_and_as_what_it_is(tmp_path, monkeypatch, memory, address):
    table = write_labels(tmp_path / "t.parquet", rows(2))
    memory.pipe_file("/t.parquet", table.read_bytes())
    monkeypatch.setattr(module, "LARGE", 1)
    tries = []

    def full(*_, **__):
        tries.append(1)
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(pq, "ParquetWriter", full)
    with pytest.raises(OSError, match="No space left") as raised:
        in_small_groups("memory://t.parquet" if address else str(table))
    assert raised.value.errno == errno.ENOSPC
    assert str(tmp_path / "caches") in str(raised.value.filename)
    assert len(tries) == 1


def test_a_table_that_does_not_fit_into_memory_is_not_called_damaged(tmp_path, monkeypatch):
    table = str(write_labels(tmp_path / "t.parquet", rows(2)))

    def full(*_, **__):
        raise pa.ArrowMemoryError("malloc of size 128 failed")

    monkeypatch.setattr(pq, "ParquetFile", full)
    with pytest.raises(MemoryError):
        in_small_groups(table)


def test_columns_without_a_value_and_numbers_with_a_gap_are_fine(tmp_path):
    first = {"photo": "a.png", "rows": None, "visible": None, "height": None, "sha256": None}
    kinds = dict.fromkeys(("rows", "visible", "height", "sha256"), pa.null())
    (item,) = sv.open_dataset(write_labels(tmp_path / "t.parquet", [first], **kinds))
    assert (item.has_truth, item.size()) == (False, None)
    gaps = [
        row_of("a.png", SKYLINE, height=16.0, width=24.0),
        row_of("b.png", SKYLINE, height=None, width=float("nan")),
    ]
    kinds = {"height": pa.float64(), "width": pa.float64()}
    a, b = sv.open_dataset(write_labels(tmp_path / "t.parquet", gaps, **kinds))
    assert (a.size(), b.size()) == ((16, 24), None)


@pytest.mark.parametrize("size", [(0, 24), (16, -2), (16.5, 24), (1e30, 24)])
def test_a_size_that_is_none_is_told(tmp_path, size):
    labels = [row_of("a.png", SKYLINE, height=size[0], width=size[1]), row_of("b.png", SKYLINE)]
    labels[1] |= {"height": 16, "width": 24}
    kinds = {"height": pa.float64(), "width": pa.float64()}
    a, b = (dataset := sv.open_dataset(write_labels(tmp_path / "t.parquet", labels, **kinds)))
    assert (a.size(), b.size()) == (None, (16, 24))
    assert dataset.problems == (
        f"heights or widths that are no size are not looked at: {a.where}.",
    )
