"""Which pixels a lean recording shows; what is logged of them is tested with the recording."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.viewer.maps.stage_maps import _kth_cheapest
from testing.examples import examples


@examples(60)
@given(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 9))), st.integers(1, 5))
def test_the_kth_cheapest_pixel_of_each_column_against_sorting(pixels, count):
    told = np.array(pixels, np.int32).reshape(-1, 2)
    columns, costs = np.ascontiguousarray(told[:, 0]), told[:, 1].astype(np.float32)
    found = _kth_cheapest(columns, costs, 5, count)
    assert found.dtype == np.float32
    for column in range(5):
        here = [*np.sort(costs[columns == column]), *[np.inf] * count]
        assert found[column] == here[count - 1]
