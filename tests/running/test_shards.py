"""Shards: parts that fit together, and what is said of those that do not."""

import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.running.line_table import TableError, failed_row, read_about, write_lines
from skyline_viz.running.shards import Shard, join, shards_in

PHOTOS = [f"s3://photos/{number}.jpg" for number in range(20)]


def write_shards(folder, of=3, **about):
    for number in range(1, of + 1):
        shard = Shard(number, of)
        rows = [failed_row(photo, "x") for photo in PHOTOS if shard.holds(photo)]
        told = {"digest": "d", "shard": str(shard), **about}
        write_lines(folder / shard.file, rows, told)
    return folder


@given(st.integers(1, 9), st.text(st.characters(codec=None, exclude_categories=()), max_size=20))
def test_a_photo_belongs_to_exactly_one_shard(of, photo):
    photo = photo.encode(errors="replace").decode()
    assert sum(Shard(number, of).holds(photo) for number in range(1, of + 1)) == 1


def test_names_that_are_no_text_belong_to_one_too():
    assert Shard(1, 2).holds("a\udcfc.jpg") != Shard(2, 2).holds("a\udcfc.jpg")


@pytest.mark.parametrize("text", ["", "0/3", "4/3", "1", "a/b", "1/0", "-1/3", "1/3/5"])
def test_what_is_no_shard_is_refused(text):
    with pytest.raises(ValueError, match=r"^--shard is I/N, "):
        Shard.parse(text)


def test_a_shard_is_read_and_written_alike():
    assert str(Shard.parse("3/8")) == "3/8"
    assert Shard.parse("3/8") == Shard(3, 8)


def test_shards_make_one_table(tmp_path):
    assert join(write_shards(tmp_path), tmp_path / "all.parquet") == len(PHOTOS)
    found = pq.read_table(tmp_path / "all.parquet")["photo"].to_pylist()
    assert sorted(found) == sorted(PHOTOS)
    assert read_about(tmp_path / "all.parquet") == {"digest": "d", "shards": 3}


def test_missing_shards_are_named(tmp_path):
    write_shards(tmp_path, 4)
    (tmp_path / Shard(2, 4).file).unlink()
    with pytest.raises(TableError, match=r"lacks the shard 2/4\.$"):
        shards_in(tmp_path)
    (tmp_path / Shard(3, 4).file).unlink()
    with pytest.raises(TableError, match=r"lacks the shard 2/4, and 1 more\.$"):
        shards_in(tmp_path)


def test_shards_of_two_kinds_are_refused(tmp_path):
    write_shards(tmp_path, 2)
    write_shards(tmp_path, 3)
    with pytest.raises(TableError, match=r"holds shards of 2 and 3; remove"):
        join(tmp_path, tmp_path / "all.parquet")
    with pytest.raises(TableError, match=r"holds no shards"):
        (tmp_path / "empty").mkdir()
        join(tmp_path / "empty", tmp_path / "all.parquet")


def test_a_shard_that_was_made_otherwise_is_refused(tmp_path):
    write_shards(tmp_path, 2)
    write_lines(tmp_path / Shard(2, 2).file, [], {"digest": "other"})
    with pytest.raises(TableError, match=r"00002\.parquet was made by another method or version"):
        join(tmp_path, tmp_path / "all.parquet")


@pytest.mark.parametrize("own", [True, False])
def test_a_photo_that_does_not_belong_is_refused(tmp_path, own):
    write_shards(tmp_path, 2)
    photo = next(one for one in PHOTOS if Shard(2, 2).holds(one) == own)
    write_lines(tmp_path / Shard(2, 2).file, [failed_row(photo, "x")] * 2, {"digest": "d"})
    with pytest.raises(TableError, match=f"holds {photo}, which it should not, or twice"):
        join(tmp_path, tmp_path / "all.parquet")
    assert not (tmp_path / "all.parquet").exists()
