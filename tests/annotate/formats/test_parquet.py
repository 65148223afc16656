"""Labels as one Parquet table, which is a data set."""

import pyarrow.parquet as pq
import pytest

import skyline_viz as sv
from annotate.formats import FormatError, export_labels, import_labels
from skyline_viz.photo import read_photo
from testing.datasets import row_of, write_labels
from testing.exports import HEIGHT, WIDTH, label, put, there_and_back


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


def test_an_export_is_a_data_set(tmp_path, photos):
    put(photos, "deep/a.png", seed=1)
    given = [label(photos, name, tags=["fog"]) for name in ("a.png", "deep/a.png")]
    export_labels(given, photos, tmp_path / "out", "parquet")
    dataset = sv.open_dataset(tmp_path / "out" / "labels.parquet")
    assert dataset.problems == ()
    assert [item.name for item in dataset] == ["a", "deep/a"]
    assert [item.truth() for item in dataset] == [one.skyline for one in given]
    assert [item.size() for item in dataset] == [(HEIGHT, WIDTH)] * 2
    assert (dataset.items[1].photo() == read_photo(photos / "deep" / "a.png")).all()


def test_tags_come_back(tmp_path, photos):
    _, (found,) = there_and_back(tmp_path, photos, "parquet", [label(photos, "a.png", tags=["x"])])
    assert found.tags == ("x",)


def test_tables_of_others_are_read(tmp_path, photos):
    line = label(photos, "a.png").skyline
    rows = [row_of(f"s3://alps/{one}.png", line if one != "b" else None) for one in "abz"]
    put(photos, "b.png")
    table = write_labels(tmp_path / "t.parquet", rows)
    imports = import_labels(table, photos, ["a.png", "b.png"])
    assert [(one.name, one.skyline, one.tags) for one in imports] == [("a.png", line, ())]
    assert imports.notes == (
        "without a line in t.parquet: b.png.",
        "belong to no photo of the folder: s3://alps/z.png.",
    )


def test_what_does_not_fit_is_said(tmp_path, photos):
    short = sv.Skyline([3, 4])
    imports_of = [row_of("a.png", short), row_of("b.png", label(photos, "a.png").skyline, height=9)]
    put(photos, "b.png")
    table = write_labels(tmp_path / "t.parquet", imports_of[:1])
    with pytest.raises(FormatError, match=r"a\.png has 24 columns, its label 2"):
        import_labels(table, photos, ["a.png"])
    table = write_labels(tmp_path / "t.parquet", [{"width": 24, **imports_of[1]}])
    with pytest.raises(FormatError, match=r"b\.png has 16 rows, its label is for 9"):
        import_labels(table, photos, ["b.png"])
    table.write_bytes(b"PAR1")
    with pytest.raises(FormatError, match="is damaged, or no Parquet table"):
        import_labels(table, photos, ["a.png"])


def test_without_pyarrow_the_extra_is_named(tmp_path, photos, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    with pytest.raises(FormatError, match=r"pip install 'skyline-viz\[cluster\]'"):
        export_labels([label(photos, "a.png")], photos, tmp_path / "out", "parquet")
    assert not (tmp_path / "out").exists()


def test_its_columns_are_those_of_a_table_of_labels(tmp_path, photos):
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", "parquet")
    names = pq.read_schema(tmp_path / "out" / "labels.parquet").names
    assert names == ["photo", "name", "sha256", "height", "width", "rows", "visible", "tags"]
