"""How errors are distributed."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.evaluation.distribution import TOP, cumulative, shares

ERRORS = st.lists(st.floats(0, 1e4), min_size=1, max_size=50)


@given(ERRORS)
def test_every_photo_is_in_one_bin(errors):
    found = shares(errors)
    assert found.shape == (TOP + 1,)
    assert np.isclose(found.sum(), 1)


@given(ERRORS, st.floats(0, 1e4))
def test_the_curve_counts_what_is_within(errors, tolerance):
    (found,) = cumulative(errors, [tolerance])
    assert found == sum(error <= tolerance for error in errors) / len(errors)


def test_no_photos_are_no_shares():
    assert shares([]).sum() == 0
    assert cumulative([], [1, 2]).tolist() == [0, 0]
