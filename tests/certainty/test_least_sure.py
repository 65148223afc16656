"""The least sure stretches of a line."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from skyline_viz.certainty.least_sure import SHARE, least_sure

MARGINS = hnp.arrays(np.float64, st.integers(1, 300), elements=st.floats(0, 9) | st.just(np.inf))


@given(margins=MARGINS, data=st.data())
def test_no_other_column_is_less_sure(margins, data):
    visible = data.draw(hnp.arrays(np.bool_, margins.shape))
    found = least_sure(margins, visible, most=len(margins))
    inside = np.zeros(len(margins), np.bool_)
    for first, last in found:
        assert 0 <= first <= last < len(margins)
        assert visible[first] and visible[last]
        inside[first : last + 1] = True
    counted = visible & np.isfinite(margins)
    assert bool(found) == bool(counted.any())
    if found and counted.sum() > 1 / SHARE:
        assert margins[counted & ~inside].min(initial=np.inf) >= margins[inside & counted].min()
    least = [margins[first : last + 1].min() for first, last in found]
    assert least == sorted(least)


def test_neighbours_are_one_stretch_and_only_a_few_are_told():
    margins = np.full(1000, 5.0)
    margins[[100, 101, 105]] = 0.5  # nearer than a hundredth of the width
    margins[[300, 500, 700]] = 0.1, 0.2, 0.3
    margins[900:943] = 0.9
    assert least_sure(margins, np.ones(1000, np.bool_)) == [(300, 300), (500, 500), (700, 700)]
    assert (100, 105) in least_sure(margins, np.ones(1000, np.bool_), most=5)


def test_of_few_columns_there_is_one():
    assert least_sure(np.array([0.3]), np.array([True])) == [(0, 0)]
    assert least_sure(np.array([0.3]), np.array([False])) == []
