"""A table of labels as a data set: names, places, what it lacks, and what is no table."""

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.datasets.tables.label_table import names_of, open_label_table, place_of_photo
from skyline_viz.datasets.tables.table_item import TableItem
from skyline_viz.running.line_table import failed_row, found_row, write_lines
from skyline_viz.storage.addresses import StorageError
from testing.datasets import PHOTO, SKYLINE, put, row_of, write_labels


def test_photos_and_truths_are_those_of_its_rows(tmp_path):
    photos = [put(tmp_path / "photos" / f"{name}.png") for name in "cab"]
    other = sv.Skyline(SKYLINE.rows + 1, SKYLINE.rows % 2 > 0)
    rows = [row_of(photo, line) for photo, line in zip(photos, [SKYLINE, None, other], strict=True)]
    dataset = sv.open_dataset(write_labels(tmp_path / "hills.parquet", rows))
    assert (dataset.name, dataset.layout, dataset.problems) == ("hills", "table", ())
    assert [item.name for item in dataset] == ["c", "a", "b"]  # in the order of its rows
    assert [item.truth() for item in dataset] == [SKYLINE, None, other]
    assert [item.has_truth for item in dataset] == [True, False, True]
    assert (dataset.items[0].photo() == PHOTO).all()


def test_photos_lie_from_the_table_or_else_from_here(tmp_path, monkeypatch):
    put(tmp_path / "set" / "a.png")
    put(tmp_path / "b.png")
    monkeypatch.chdir(tmp_path)
    rows = [row_of(photo, SKYLINE) for photo in ("a.png", "b.png", "lost.png")]
    write_labels(tmp_path / "set" / "t.parquet", rows)
    a, b, lost = sv.open_dataset("set/t.parquet")
    assert [a.where, b.where, lost.where] == ["set/a.png", "b.png", "set/lost.png"]
    with pytest.raises(sv.PhotoError, match=r"set/lost\.png does not exist|no such file"):
        lost.photo()


@pytest.mark.parametrize(
    ("table", "photo", "where"),
    [
        ("s3://labels/alps/t.parquet", "a/b.jpg", "s3://labels/alps/a/b.jpg"),
        ("s3://labels/alps/t.parquet", "../b.jpg", "s3://labels/b.jpg"),
        ("memory://t.parquet", "b.jpg", "memory://b.jpg"),
        ("zip://in/t.parquet::s3://all/a.zip", "b.jpg", "zip://in/b.jpg::s3://all/a.zip"),
        ("https://host/t.parquet?raw=1", "b.jpg", "https://host/b.jpg"),
        ("s3://labels/t.parquet", "gs://photos/b.jpg", "gs://photos/b.jpg"),
    ],
)
def test_a_table_in_a_storage_names_photos_beside_it(table, photo, where):
    assert place_of_photo(table, photo) == where


def test_photos_of_a_storage_are_downloaded_when_they_are_asked_for(tmp_path, memory):
    memory.pipe_file("/set/a.png", put(tmp_path / "a.png").read_bytes())
    table = write_labels(tmp_path / "t.parquet", [row_of("a.png", SKYLINE)])
    memory.pipe_file("/set/t.parquet", table.read_bytes())
    dataset = sv.open_dataset("memory://set/t.parquet")
    (item,) = dataset
    assert (item.where, item.size()) == ("memory://set/a.png", None)
    assert (item.photo() == PHOTO).all()
    assert item.truth() == SKYLINE
    with pytest.raises(StorageError, match=r"memory://none\.parquet does not exist"):
        sv.open_dataset("memory://none.parquet")


def test_a_folder_of_tables_is_one(tmp_path, memory):
    for number, name in enumerate("abc"):
        table = tmp_path / "all.parquet" / f"part-{number}.parquet"
        write_labels(table, [row_of(f"memory://{name}.png", SKYLINE)])
        memory.pipe_file(f"/all.parquet/part-{number}.parquet", table.read_bytes())
    for where in (tmp_path / "all.parquet", f"{tmp_path}/all.parquet/", "memory://all.parquet"):
        dataset = sv.open_dataset(where)
        assert dataset.name == "all"
        assert [item.where for item in dataset] == [f"memory://{name}.png" for name in "abc"]
    (tmp_path / "empty.parquet").mkdir()
    with pytest.raises(sv.DatasetError, match="holds no table"):
        sv.open_dataset(tmp_path / "empty.parquet")


@pytest.mark.parametrize(
    ("photos", "names"),
    [
        (["/x/a.jpg", "/y/b.jpg"], ["a", "b"]),
        (["s3://p/x/a.jpg", "s3://p/y/a.jpg", "s3://p/y/b.jpg"], ["x/a", "y/a", "y/b"]),
        (["/p/x/a.jpg", "/p/x/a.png"], ["a.jpg", "a.png"]),
        (["/p/xa/a.jpg", "/p/xb/a.jpg"], ["xa/a", "xb/a"]),
        (["https://h/a.jpg?raw=1", "https://h/b.jpg?raw=1"], ["a", "b"]),
    ],
)
def test_names_tell_photos_apart(tmp_path, photos, names):
    table = write_labels(tmp_path / "t.parquet", [row_of(one, SKYLINE) for one in photos])
    assert [item.name for item in sv.open_dataset(table)] == names


PATHS = st.from_regex(r"/?(a|b|aa|\.\.|ä b|a\.b)(/(a|b|aa)){0,3}\.(jpg|png)", fullmatch=True)


@given(st.sets(PATHS, min_size=1, max_size=12))
def test_no_two_photos_have_the_same_name(paths):
    names = names_of(sorted(paths))
    assert len(set(names)) == len(paths)


def test_a_photo_counts_once(tmp_path):
    rows = [row_of(name, SKYLINE) for name in ("a.png", "b.png", "./a.png")]
    rows[2]["rows"] = rows[2]["rows"] + 1
    dataset = sv.open_dataset(write_labels(tmp_path / "t.parquet", rows))
    assert [item.truth() for item in dataset] == [SKYLINE, SKYLINE]
    (said,) = dataset.problems
    assert said == f"of several rows of a photo the first counts: {tmp_path}/a.png."


def test_a_row_without_a_photo_is_told(tmp_path):
    rows = [row_of("a.png", SKYLINE), {**row_of("", SKYLINE), "photo": None}]
    dataset = sv.open_dataset(write_labels(tmp_path / "t.parquet", rows))
    assert (len(dataset), dataset.problems) == (1, ("row 2 of group 1 names no photo.",))
    with pytest.raises(sv.DatasetError, match=r"t\.parquet names no photo\."):
        sv.open_dataset(write_labels(tmp_path / "t.parquet", rows[1:]))


def test_what_a_detector_has_found_is_told(tmp_path):
    found = sv.Detector().detect(sv.render("clear", 1, 96, 64).photo)
    rows = [found_row("a.png", "", "0" * 64, found), failed_row("b.png", "it is broken.")]
    write_lines(tmp_path / "lines.parquet", rows, {})
    dataset = sv.open_dataset(tmp_path / "lines.parquet")
    assert dataset.problems == ("lines that a detector found are taken for truths: lines.parquet.",)
    assert [item.truth() for item in dataset] == [found.skyline, None]
    assert dataset.items[0].size() == (64, 96)


@pytest.mark.parametrize(
    ("rows", "kinds", "said"),
    [
        ([{"photo": "a"}], {}, "has no column rows; a table of labels has photo and rows."),
        ([{"rows": [1.0]}], {}, "has no column photo; a table of labels has photo and rows."),
        (
            [{"photo": 1, "rows": [1.0]}],
            {"photo": pa.int64()},
            "the column photo of .* holds int64, and not text.",
        ),
        (
            [{"photo": "a", "rows": 1.0}],
            {"rows": pa.float32()},
            "the column rows of .* holds float, and not lists of numbers.",
        ),
        (
            [{"photo": "a", "rows": ["x"]}],
            {"rows": pa.list_(pa.string())},
            "the column rows of .* holds list<.*>, and not lists of numbers.",
        ),
        (
            [{"photo": "a", "rows": [1.0], "height": "9"}],
            {"height": pa.string()},
            "the column height of .* holds string, and not numbers.",
        ),
        (
            [{"photo": "a", "rows": [1.0], "visible": [1]}],
            {"visible": pa.list_(pa.int8())},
            "the column visible of .* and not lists of true and false.",
        ),
    ],
)
def test_columns_of_another_kind_are_refused(tmp_path, rows, kinds, said):
    with pytest.raises(sv.DatasetError, match=said):
        sv.open_dataset(write_labels(tmp_path / "t.parquet", rows, **kinds))


@pytest.mark.parametrize(
    "kinds",
    [
        {"rows": pa.large_list(pa.float64()), "photo": pa.large_string()},
        {"rows": pa.list_(pa.int16(), SKYLINE.width), "photo": pa.string_view()},
        {"rows": pa.list_(pa.float16()), "photo": pa.dictionary(pa.int8(), pa.string())},
    ],
)
def test_columns_are_read_as_other_programs_write_them(tmp_path, kinds):
    rows = [{"photo": "a.png", "rows": SKYLINE.rows.astype(int).tolist()}]
    if kinds["rows"].value_type == pa.float16():
        rows[0]["rows"] = [np.float16(one) for one in rows[0]["rows"]]
    (item,) = sv.open_dataset(write_labels(tmp_path / "t.parquet", rows, **kinds))
    assert item.truth() == SKYLINE


@pytest.mark.parametrize("content", [b"", b"PAR1", b"column,row\n0,1\n"])
def test_what_is_no_table_is_said(tmp_path, content):
    (tmp_path / "t.parquet").write_bytes(content)
    with pytest.raises(sv.DatasetError, match=r"t\.parquet is damaged, or no Parquet table\."):
        sv.open_dataset(tmp_path / "t.parquet")
    with pytest.raises(sv.DatasetError, match=r"none\.parquet cannot be read: no such file"):
        sv.open_dataset(tmp_path / "none.parquet")


def test_without_pyarrow_the_extra_is_named(tmp_path, monkeypatch):
    write_labels(tmp_path / "t.parquet", [row_of("a.png", SKYLINE)])
    monkeypatch.setitem(__import__("sys").modules, "pyarrow.parquet", None)
    with pytest.raises(StorageError, match=r"pip install 'skyline-viz\[cluster\]'"):
        open_label_table(str(tmp_path / "t.parquet"))


def test_its_photos_are_items_of_a_table(tmp_path):
    table = write_labels(tmp_path / "t.parquet", [row_of("a.png", SKYLINE, height=16, width=24)])
    (item,) = open_label_table(str(table))
    assert isinstance(item, TableItem)
    assert item.size() == (16, 24)
