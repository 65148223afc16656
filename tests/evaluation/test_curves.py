"""Error curves: shares of photos and columns within tolerances."""

import csv

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from skyline_viz.evaluation.curves import TOLERANCES, curve, draw_curves, write_curves
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.skyline import Skyline
from testing.examples import examples


def result(name, *errors):
    return PhotoResult.of(name, Skyline([*map(float, errors)]), Skyline([0.0] * len(errors)), 100)


@examples(40)
@given(st.lists(st.lists(st.floats(0, 90), min_size=1, max_size=5), min_size=1, max_size=5))
def test_more_is_right_within_more(photos):
    for shares in curve([result(str(place), *one) for place, one in enumerate(photos)]):
        assert (np.diff(shares) >= 0).all()
        assert ((shares >= 0) & (shares <= 1)).all()


def test_photos_count_by_their_mean_and_columns_each():
    photos, columns = curve([result("a", 0, 0, 0, 8), result("b", 20)])
    assert tuple(range(1, 21)) == TOLERANCES
    assert photos[[0, 1, 18, 19]].tolist() == [0, 0.5, 0.5, 1]
    assert columns[[0, 7, 19]].tolist() == [0.375, 0.5, 1]


def test_the_table_and_the_picture_show_each_method(tmp_path):
    known = {"ours": [result("a", 1)], "theirs $x$": [result("a", 9)]}
    write_curves(tmp_path / "c.csv", known)
    with (tmp_path / "c.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert len(lines) == 2 * len(TOLERANCES)
    assert [float(one["photos"]) for one in lines[:2]] == [1, 1]
    assert [float(one["columns"]) for one in lines[20:30]] == [0] * 8 + [1] * 2
    draw_curves(tmp_path / "c.png", known, "two\nlines")
    with Image.open(tmp_path / "c.png") as picture:
        assert picture.size[0] > 1000


def test_results_without_errors_of_columns_have_no_curve_of_them(tmp_path):
    bare = PhotoResult(**{**vars(result("a", 1)), "errors": None})
    assert np.isnan(curve([bare])[1]).all()
    write_curves(tmp_path / "c.csv", {"old": [bare]})
    assert (tmp_path / "c.csv").read_text().splitlines()[1] == "old,1,1,"
