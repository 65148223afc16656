"""What speaks against a truth: no contrast along it, and much beside it."""

from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.diagnosis.doubt import doubt_of

TOLERANCE = 4.0


@pytest.fixture(scope="module")
def flat():
    """A level ridge in row 60, which the detector finds, and a weaker one in row 90."""
    photo = np.full((160, 300, 3), 200, np.uint8)
    photo[60:] = 120
    photo[90:] = 60
    return sv.Detector().detect(photo)


def case(flat, rows, visible=None):
    return Case(flat, sv.Skyline(rows, visible), TOLERANCE)


@pytest.mark.parametrize(("off", "where"), [(-9, "lower"), (9, "higher")])
def test_a_truth_beside_the_only_contrast_is_doubtful(flat, off, where):
    rows = np.full(300, 60.0)
    rows[100:200] += off
    found = doubt_of(case(flat, rows), 100, 199)
    assert (found.columns, found.repaired) == (100, 1.0)
    assert f"With the truth 9 px {where}, 100% of the wrong columns are right" in found.evidence


def test_hidden_columns_are_not_asked(flat):
    rows, visible = np.full(300, 60.0), np.ones(300, bool)
    rows[100:200] += 9
    visible[110:150] = False
    assert doubt_of(case(flat, rows, visible), 100, 199).columns == 60


@pytest.mark.parametrize("off", [30, 70])
def test_a_truth_on_contrast_of_its_own_or_far_away_is_not(flat, off):
    rows = np.full(300, 60.0)
    rows[100:200] += off  # 30 rows below is the other ridge
    assert doubt_of(case(flat, rows), 100, 199) is None


def test_a_truth_that_wanders_or_is_short_is_not(flat):
    rows = np.full(300, 60.0)
    rows[100:200] += np.linspace(5, 20, 100)
    assert doubt_of(case(flat, rows), 100, 199) is None
    rows = np.full(300, 60.0)
    rows[100:107] += 9
    assert doubt_of(case(flat, rows), 100, 106) is None


def test_a_truth_that_is_uneven_or_right_in_too_few_columns_is_not(flat):
    rows = np.full(300, 60.0)
    rows[100:200] += np.tile([6, 12], 50)  # within the tolerance of the middle, but no line beside
    assert doubt_of(case(flat, rows), 100, 199) is None
    rows = np.full(300, 60.0)
    rows[100:165] += 9
    rows[165:200] += 20
    assert doubt_of(case(flat, rows), 100, 199) is None


def test_where_the_path_is_on_no_edge_either_nothing_speaks_against_the_truth(flat):
    rows = np.full(300, 60.0)
    rows[100:200] += 9
    assert doubt_of(case(flat, rows), 100, 199) is not None
    bare = replace(flat, edges=np.zeros_like(flat.edges))
    assert doubt_of(case(bare, rows), 100, 199) is None
