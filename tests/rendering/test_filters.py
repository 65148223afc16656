"""Curves and filters of the renderer, against what they say they are."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from skyline_viz.rendering.filters import box_blur, enlarge, mix, ramp, slopes, soften

FIELDS = arrays(np.float32, (7, 9), elements=st.integers(-640, 640).map(lambda one: one / 64))


def test_a_ramp_goes_from_0_to_1_and_falls_where_its_ends_are_swapped():
    values = np.float32([-1, 2, 3, 4, 9])
    np.testing.assert_allclose(ramp(2, 4, values), [0, 0, 0.5, 1, 1])
    np.testing.assert_allclose(ramp(4, 2, values), [1, 1, 0.5, 0, 0])


def test_a_mixture_is_the_one_the_other_or_between():
    first, second = np.float32([2, 4]), np.float32([6, 0])
    np.testing.assert_array_equal(mix(first, second, 0), first)
    np.testing.assert_array_equal(mix(first, second, 1), second)
    np.testing.assert_array_equal(mix(first, second, np.float32([0.5, 0.25])), [4, 3])


@given(values=FIELDS, radius=st.integers(1, 3))
def test_a_box_blur_is_the_mean_of_the_square(values, radius):
    padded = np.pad(values.astype(np.float64), radius, mode="edge")
    size = 2 * radius + 1
    windows = np.lib.stride_tricks.sliding_window_view(padded, (size, size))
    np.testing.assert_allclose(
        box_blur(values, radius), windows.mean(axis=(2, 3)), rtol=1e-5, atol=1e-5
    )


def test_softening_spreads_a_point_over_three_pixels_and_keeps_its_sum():
    point = np.zeros((5, 5), np.float32)
    point[2, 2] = 1
    soft = soften(point, 0.25)
    np.testing.assert_allclose(soft[1:4, 1:4], np.outer([0.25, 0.5, 0.25], [0.25, 0.5, 0.25]))
    assert soft.sum() == pytest.approx(1)
    np.testing.assert_array_equal(soften(np.full((4, 3), 7, np.float32), 0.3), 7)


def test_enlarging_goes_through_the_samples_and_straight_between_them():
    samples = np.float32([[0, 4], [8, 12]])
    large = enlarge(samples, (5, 5), 4)
    np.testing.assert_array_equal(large[::4, ::4], samples)
    np.testing.assert_array_equal(large[0], [0, 1, 2, 3, 4])
    np.testing.assert_array_equal(large[:, 0], [0, 2, 4, 6, 8])


def test_slopes_of_a_plane_are_its_own_everywhere():
    rows, columns = np.mgrid[:6, :8].astype(np.float32)
    across, away = slopes(3 * columns - 2 * rows, (0.5, 4.0))
    np.testing.assert_allclose(across, 6)
    np.testing.assert_allclose(away, -0.5)
