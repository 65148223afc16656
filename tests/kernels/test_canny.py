"""Canny's edge map: bit for bit that of OpenCV on the photo turned upside down."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.canny import STEEPEST, _suppress, canny
from skyline_viz.kernels.planes import padded_planes
from testing.examples import examples

SIDES = st.integers(1, 150)
SEEDS = st.integers(0, 2**32 - 1)
THRESHOLDS = st.one_of(st.floats(0, STEEPEST + 50), st.floats(-5, 1e6), st.integers(0, STEEPEST))


def by_opencv(photo, low, high):
    return cv2.Canny(np.ascontiguousarray(photo[::-1]), low, high)[::-1] > 0


def some_photo(height, width, channels, seed, contrast=255, blur=0.0):
    """Random pixels, of which some are alike."""
    photo = np.random.default_rng(seed).integers(0, contrast, (height, width, *channels), np.uint8)
    return cv2.GaussianBlur(photo, (0, 0), blur) if blur else photo


@examples(200)
@given(
    st.builds(
        some_photo,
        SIDES,
        SIDES,
        st.sampled_from([(), (3,)]),
        SEEDS,
        st.sampled_from([1, 2, 10, 255]),
        st.floats(0, 3),
    ),
    THRESHOLDS,
    THRESHOLDS,
)
def test_edges_are_those_of_opencv(photo, low, high):
    found = canny(padded_planes(photo), low, high)
    assert found.dtype == np.bool_
    assert np.array_equal(found, by_opencv(photo, low, high))


@pytest.mark.parametrize("width", [1, 63, 64, 65, 128, 200])
@pytest.mark.parametrize("start", ["first", "last"])
def test_an_edge_is_followed_as_far_as_it_winds(width, start):
    """Level bars, of which only one end is strong, joined at their ends to one long edge."""
    photo = np.zeros((82, width), np.uint8)
    for bar in range(10):
        photo[8 * bar + 4 : 8 * bar + 8] = 30
        photo[8 * bar : 8 * bar + 4, (bar % 2 - 1) * 3 :][:, :3] = 30
    row, column = (4, 0) if start == "first" else (76, width - 1)
    assert not canny(padded_planes(photo), 50, 220).any()
    photo[row : row + 4, column] = 255
    found = canny(padded_planes(photo), 50, 220)
    assert found.any()
    assert np.array_equal(found, by_opencv(photo, 50, 220))


def test_every_direction_is_told_apart_as_opencv_does():
    """Ramps that rise by all pairs of steps: their gradients have every slope that there is."""
    rows, columns = np.mgrid[:40, :40]
    for down in range(-6, 7):
        for right in range(-6, 7):
            ramp = np.clip(128 + down * (rows - 20) + right * (columns - 20), 90, 166)
            photo = ramp.astype(np.uint8)
            assert np.array_equal(canny(padded_planes(photo), 9, 20), by_opencv(photo, 9, 20))


@pytest.mark.parametrize("shape", [(0, 0), (0, 5), (5, 0)])
def test_nothing_has_no_edges(shape):
    planes = np.zeros((1, shape[0] + 6, shape[1] + 6), np.uint8)
    assert canny(planes, 50, 220).shape == shape


@pytest.mark.parametrize("sign", [1, -1])
def test_directions_are_those_of_the_fixed_point_numbers_of_opencv(sign):
    """Every pair of gradients; the neighbours tell which of the three directions was asked."""
    wide = np.arange(1021, dtype=np.int16)
    flags = np.empty((2, len(wide)), np.uint8)

    def asked(tall, above, below):
        """Where a pixel as strong as its row is kept between rows of other strengths."""
        rim, down = np.ones(len(wide) + 2, np.int16), np.full_like(wide, sign * tall)
        rows = (np.int16(one) * rim for one in (above, 5, below))
        _suppress(wide, down, *rows, np.int16(0), np.int16(9), *flags)
        return flags[0] > 0

    for tall in range(1021):
        some = wide + tall > 0  # where there is no gradient, no pixel is above a threshold
        along_row = tall * 32768 < wide * np.int64(13573)
        along_column = (tall - 2 * wide.astype(np.int64)) * 32768 > wide * np.int64(13573)
        assert np.array_equal(asked(tall, 4, 4)[some], ~along_row[some])
        assert np.array_equal(asked(tall, 5, 4)[some], along_column[some])
