"""Window sums: those of numpy, in the same order of sums."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.planes import padded_planes
from skyline_viz.kernels.tensor_sums import TAPS, window_sums
from skyline_viz.tensor import WINDOW
from testing.examples import examples


def plainly(planes, rows, columns):
    channels = planes.astype(np.float32)
    falling = channels[:, 1:, 1:] - channels[:, :-1, :-1]
    rising = channels[:, :-1, 1:] - channels[:, 1:, :-1]
    gx, gy = (falling + rising) / 2, (falling - rising) / 2
    height, width = planes.shape[1] - TAPS, planes.shape[2] - TAPS
    sums = []
    for one, other in ((gx, gx), (gx, gy), (gy, gy)):
        product = (one * other).sum(axis=0)
        down = np.zeros((height, width + TAPS - 1), np.float32)
        total = np.zeros((height, width), np.float32)
        for tap in range(TAPS):
            down += WINDOW[tap] * product[tap : tap + height]
        for tap in range(TAPS):
            total += WINDOW[tap] * down[:, tap : tap + width]
        sums.append(total[rows, columns])
    return np.array(sums)


@examples(60)
@given(
    st.integers(1, 30),
    st.integers(1, 70),
    st.integers(0, 2**32 - 1),
    st.sampled_from([0.0, 0.02, 0.3, 1.0]),
)
def test_sums_are_those_of_numpy_to_the_bit(height, width, seed, share):
    rng = np.random.default_rng(seed)
    planes = padded_planes(rng.integers(0, 256, (height, width, 3), dtype=np.uint8))
    rows, columns = (
        one.astype(np.int32) for one in np.nonzero(rng.random((height, width)) < share)
    )
    sums = np.empty((3, len(rows)), np.float32)
    first = np.searchsorted(rows, np.arange(height + 1))
    window_sums(planes, columns, first, WINDOW, sums)
    assert np.array_equal(sums, plainly(planes, rows, columns))
