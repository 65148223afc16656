"""What was found about passes, as files."""

import csv
import json

import numpy as np
import pytest

from annotate.agreement.pairs import compared
from annotate.agreement.tables import write_tables
from testing.labels import made

PASSES = [("ann", 1), ("bob", 1), ("eve", 2)]


def test_both_files_have_a_row_for_each_photo_and_two_passes(tmp_path):
    rows = np.full(100, 10)
    rows[40:50] += 7
    labels = [made([10] * 100), made(rows, "bob"), made([11] * 100, "eve", 2, blind=True)]
    write_tables(compared(labels, PASSES), PASSES, tmp_path / "out")
    document = json.loads((tmp_path / "out" / "agreement.json").read_text())
    assert [one["mean"] for one in document["pairs"]] == pytest.approx([0.7, 1.0, 1.5])
    assert document["made"]["one blind"]["photos"] == 1
    assert document["proposed_below_blind"]["mean"] == pytest.approx(-0.65)
    first = document["photos"][0]
    assert (first["first"], first["second"]) == ("ann", "bob")
    assert (first["first_column"], first["last_column"], first["worst"]) == (40, 49, 7.0)
    assert (first["lower"], first["within_5"]) == (pytest.approx(0.7), 0.9)
    with (tmp_path / "out" / "photos.csv").open(newline="") as text:
        table = list(csv.DictReader(text))
    assert [list(row) for row in table] == [list(row) for row in document["photos"]]
    assert [row["second"] for row in table] == ["bob", "eve:2", "eve:2"]
    assert float(table[0]["mean"]) == first["mean"]


def test_where_no_column_can_be_compared_there_are_no_numbers(tmp_path):
    hidden = np.arange(20) < 10
    labels = [made([1] * 20, visible=hidden), made([2] * 20, "bob", visible=~hidden)]
    write_tables(compared(labels, PASSES[:2]), PASSES[:2], tmp_path)
    document = json.loads((tmp_path / "agreement.json").read_text())
    (row,) = document["photos"]
    assert (row["mean"], row["worst"], row["seen_by_first"], row["columns"]) == (None, None, 10, 0)
