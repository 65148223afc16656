"""Skylines written with the margin of each column."""

import json

import numpy as np
import pytest

from skyline_viz.skyline import Skyline, SkylineError


def test_margins_stand_in_a_fourth_column_and_are_passed_over(tmp_path):
    line = Skyline([3, 2.5], np.array([True, False]))
    line.write_csv(tmp_path / "a.csv", np.array([0.25, np.inf]))
    told = (tmp_path / "a.csv").read_text()
    assert told == "column,row,visible,margin\n0,3,1,0.25\n1,2.5,0,inf\n"
    assert Skyline.read_csv(tmp_path / "a.csv") == line
    line.write_json(tmp_path / "a.json", np.array([0.25, np.inf]))
    assert json.loads((tmp_path / "a.json").read_text())["margins"] == [0.25, None]
    assert Skyline.read_json(tmp_path / "a.json") == line
    for write in (line.write_csv, line.write_json):
        with pytest.raises(SkylineError, match="2 rows, but margins of the shape"):
            write(tmp_path / "b", np.zeros(3))
