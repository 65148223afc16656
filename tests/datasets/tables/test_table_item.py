"""A photo of a table: its truth, what travels, and photos that are not those that were labelled."""

import hashlib
import pickle
from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.datasets.tables.table_item import row_group
from testing.datasets import NOISE, PHOTO, SKYLINE, put, row_of, write_labels


def table_of(tmp_path, *rows):
    return sv.open_dataset(write_labels(tmp_path / "t.parquet", list(rows))).items


def test_a_truth_travels_with_its_photo(tmp_path):
    put(tmp_path / "a.png")
    (item,) = table_of(tmp_path, row_of("a.png", SKYLINE))
    sent = pickle.loads(pickle.dumps(item))
    (tmp_path / "t.parquet").unlink()
    assert sent.truth() == SKYLINE
    assert sent.has_truth
    assert [*sent.contents()] == [*pickle.loads(pickle.dumps(sent)).contents()]
    assert (sent.photo() == PHOTO).all()


def test_contents_change_with_photo_and_truth_and_with_nothing_else(tmp_path):
    put(tmp_path / "a.png")
    (item,) = table_of(tmp_path, row_of("a.png", SKYLINE))
    first = [*item.contents()]
    (alike,) = table_of(tmp_path, row_of("a.png", SKYLINE, height=16, width=24))
    before = [*alike.contents()]
    assert first == before
    (moved,) = table_of(tmp_path, row_of("a.png", sv.Skyline(SKYLINE.rows + 1)))
    assert before != [*moved.contents()]
    assert before[:1] == [*moved.without_truth().contents()]
    put(tmp_path / "a.png", NOISE)
    (again,) = table_of(tmp_path, row_of("a.png", SKYLINE))
    assert [*again.contents()] != before


def test_values_that_are_missing_are_not_visible(tmp_path):
    rows = SKYLINE.rows.tolist()
    rows[3], rows[4] = None, float("nan")
    first = {"photo": "a.png", "rows": rows, "visible": [True] * len(rows)}
    second = {"photo": "b.png", "rows": rows, "visible": [one != 0 for one in range(len(rows))]}
    third = {"photo": "c.png", "rows": rows, "visible": None}
    lines = [item.truth() for item in table_of(tmp_path, first, second, third)]
    hidden = [np.flatnonzero(~line.visible).tolist() for line in lines]
    assert hidden == [[3, 4], [0, 3, 4], [3, 4]]


def test_a_damaged_line_is_named(tmp_path):
    rows = [
        {"photo": "a.png", "rows": [], "visible": None},
        {"photo": "b.png", "rows": [1.0, 2.0], "visible": [True]},
    ]
    for item in table_of(tmp_path, *rows):
        with pytest.raises(sv.SkylineError, match=rf"{item.name}\.png: its row of the table"):
            item.truth()


def test_a_table_that_changes_meanwhile_is_noticed(tmp_path):
    (item,) = table_of(tmp_path, row_of("a.png", SKYLINE))
    table_of(tmp_path, row_of("a.png", sv.Skyline(SKYLINE.rows + 1)))
    with pytest.raises(sv.SkylineError, match="it has changed since the table was opened"):
        item.truth()
    (last,) = table_of(tmp_path, row_of("c.png", SKYLINE))
    (tmp_path / "t.parquet").unlink()
    with pytest.raises(sv.SkylineError, match=r"c\.png: its row of the table cannot be read"):
        last.truth()


def test_what_is_wrong_with_a_truth_travels_as_well(tmp_path):
    """Else the photos that are sent along with it would be lost."""
    (item,) = table_of(tmp_path, {"photo": "a.png", "rows": [], "visible": None})
    sent = pickle.loads(pickle.dumps(item))
    assert sent.has_truth
    for one in (item, sent, pickle.loads(pickle.dumps(sent))):
        with pytest.raises(sv.SkylineError, match=r"a\.png: its row of the table cannot be read"):
            one.truth()
    assert not sent.without_truth().has_truth


def test_a_table_of_a_storage_stays_as_it_was_when_it_was_opened(tmp_path, memory):
    lines = [SKYLINE, sv.Skyline(SKYLINE.rows + 1)]
    items = []
    for line in lines:
        table = write_labels(tmp_path / "t.parquet", [row_of("a.png", line)])
        memory.pipe_file("/t.parquet", table.read_bytes())
        items += sv.open_dataset("memory://t.parquet")
        assert items[-1].truth() == line
    row_group.cache_clear()
    assert [item.truth() for item in items] == lines


def test_another_photo_than_was_labelled_is_refused(tmp_path):
    digest = hashlib.sha256(put(tmp_path / "a.png").read_bytes()).hexdigest()
    (item,) = table_of(tmp_path, row_of("a.png", SKYLINE, sha256=digest.upper()))
    assert (item.photo() == PHOTO).all()
    put(tmp_path / "a.png", NOISE)
    (item,) = table_of(tmp_path, row_of("a.png", SKYLINE, sha256=digest))
    with pytest.raises(sv.PhotoError, match=r"a\.png is not the file that was labelled"):
        item.photo()
    (item,) = table_of(tmp_path, row_of("a.png", SKYLINE, height=17, width=24))
    with pytest.raises(sv.PhotoError, match="has 24x16 pixels, and its label is for 24x17"):
        item.photo()


def test_another_truth_can_be_named(tmp_path):
    put(tmp_path / "a.png")
    (item,) = table_of(tmp_path, row_of("a.png", None))
    other = sv.Skyline(SKYLINE.rows + 2)
    other.write_csv(tmp_path / "other.csv")
    named = replace(item, truth_path=tmp_path / "other.csv")
    assert named.has_truth
    assert named.truth() == other
    assert pickle.loads(pickle.dumps(named)).truth() == other
