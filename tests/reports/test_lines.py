"""Lines as paths of SVG: where they are, and by how much they may be off."""

import re

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.reports.lines import curve_path, line_path, path_of, rows_path
from skyline_viz.skyline import Skyline


def points(path):
    """The runs of a path, each a list of (x, y)."""
    runs = [one for one in path.split("M") if one]
    return [[tuple(map(float, point.split())) for point in run.split("L")] for run in runs]


def test_a_line_reaches_from_rim_to_rim_and_ends_where_it_is_not_visible():
    line = Skyline([5, 5, 7, 7], visible=[True, True, False, True])
    assert points(line_path(line, 0.01)) == [[(0, 5), (2, 5)], [(3, 7), (4, 7)]]


def test_no_line_is_no_path():
    assert rows_path(np.array([3.0]), np.array([False]), 0.1) == ""
    assert path_of([]) == ""


def distance(point, run):
    """From a point to the nearest one of a run."""
    start, end = np.array(run[:-1]), np.array(run[1:])
    way = end - start
    lengths = np.maximum((way**2).sum(axis=1), 1e-12)
    share = (((point - start) * way).sum(axis=1) / lengths).clip(0, 1)
    return np.hypot(*(start + share[:, None] * way - point).T).min()


@given(st.lists(st.integers(0, 500), min_size=2, max_size=80), st.sampled_from([0.1, 0.5, 2.0]))
def test_every_column_is_as_near_as_was_asked(rows, tolerance):
    (run,) = points(line_path(Skyline(rows), tolerance))
    assert (run[0][0], run[-1][0]) == (0, len(rows))
    for column, row in enumerate(rows):
        assert distance((column + 0.5, row), run) <= tolerance + 0.1  # and a tenth is what is told


def test_a_curve_has_its_largest_value_at_the_top_and_gaps():
    path = curve_path(np.array([0.0, np.nan, 4.0]), 0.0, 4.0, (30, 8))
    assert points(path) == [[(5, 8)], [(25, 0)]]
    assert re.fullmatch(r"M5 8M25 0", path)
