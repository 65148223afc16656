"""Products of vectors: the sums that numpy gives, in the order that is promised."""

import numba
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.vectors import LANES, dot_lanes
from testing.examples import examples


@numba.njit
def dot(taps, first_tap, tap_stride, values, first_value, stride, rows):
    places = np.uintp(first_tap), np.uintp(tap_stride), np.uintp(first_value)
    return dot_lanes(taps, places[0], places[1], values, places[2], np.uintp(stride), rows)


@examples(80)
@given(
    st.integers(0, 2**32 - 1), st.sampled_from([1, 3, 7, 9]), st.integers(0, 9), st.integers(0, 9),
    st.integers(8, 40), st.integers(8, 40),
)  # fmt: skip
def test_sums_are_rounded_in_the_order_that_is_promised(seed, rows, first, begin, wide, stride):
    rng = np.random.default_rng(seed)
    taps, values = rng.normal(0, 1, (2, 9 * 40 + 9 + LANES)).astype(np.float32)
    lanes = np.zeros(LANES, np.float32)
    for row in range(rows):
        one = taps[first + row * wide :][:LANES]
        lanes += one * values[begin + row * stride :][:LANES]
    for half in (4, 2, 1):
        lanes = lanes[:half] + lanes[half:]
    assert dot(taps, first, wide, values, begin, stride, (0,) * rows) == lanes[0]
