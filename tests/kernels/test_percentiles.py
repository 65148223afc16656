"""Percentiles: those of numpy, to the bit."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from skyline_viz.kernels.percentiles import percentiles_of_counts, upper_percentile

PERCENTILES = st.floats(0, 100)


@given(
    values=hnp.arrays(np.float32, st.integers(1, 700), elements=st.floats(0, 500, width=32)),
    percentile=st.sampled_from([99.0, 95.0, 80.0, 100.0, 1.0]) | PERCENTILES,
)
def test_a_tail_has_the_percentile_of_the_whole(values, percentile):
    assert upper_percentile(values, percentile) == np.float32(np.percentile(values, percentile))


def test_a_sample_that_is_wrong_about_the_tail_is_not_believed():
    values = np.zeros(6400, np.float32)
    values[::64] = np.arange(100)  # all that is sampled, and nothing else, is large
    assert upper_percentile(values, 95.0) == 0


@given(
    numbers=hnp.arrays(np.int16, st.integers(1, 300), elements=st.integers(0, 2040)),
    percentiles=st.lists(PERCENTILES, min_size=1, max_size=3),
)
def test_whole_numbers_have_the_percentiles_of_numpy(numbers, percentiles):
    assert (
        percentiles_of_counts(numbers, percentiles) == np.percentile(numbers, percentiles).tolist()
    )
