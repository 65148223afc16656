"""Labels as CSV files, one a photo."""

import csv

import pytest

from annotate.formats import export_labels
from testing.exports import WIDTH, label, put


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


def test_tables_have_a_line_a_column(tmp_path, photos):
    export_labels([label(photos, "a.png")], photos, tmp_path / "out", "csv")
    with (tmp_path / "out" / "a.csv").open(newline="") as file:
        lines_read = list(csv.reader(file))
    assert lines_read[0] == ["column", "row", "visible"]
    assert len(lines_read) == WIDTH + 1
