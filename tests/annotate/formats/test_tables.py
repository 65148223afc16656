"""Labels as CSV files, one a photo."""

import csv
from dataclasses import replace

import numpy as np
import pytest

from annotate.engine.hidden import Hidden
from annotate.formats import export_labels
from skyline_viz.skyline import Skyline
from testing.exports import WIDTH, label, put, there_and_back


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


def test_what_hides_columns_is_a_fourth_value_and_comes_back(tmp_path, photos):
    visible = np.arange(WIDTH) >= 6
    why = 'a "big" cloud, low'
    hidden = (Hidden(0, 2), Hidden(3, 5, why))
    given = replace(label(photos, "a.png", visible=visible), hidden=hidden)
    export, (found,) = there_and_back(tmp_path, photos, "csv", [given])
    assert export.notes == ()
    assert found.hidden == (Hidden(3, 5, why),)
    assert found.skyline == given.skyline
    file = tmp_path / "out" / "a.csv"
    with file.open(newline="") as opened:
        lines = list(csv.reader(opened))
    assert lines[0] == ["column", "row", "visible", "why"]
    assert [line[3] for line in lines[1:8]] == ["", "", "", why, why, why, ""]
    assert Skyline.read_csv(file) == given.skyline  # whoever reads lines alone passes it over
