"""Canny's edge map: bit for bit that of OpenCV on the photo turned upside down."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.canny import STEEPEST, canny
from testing.examples import examples

SIDES = st.integers(1, 150)
SEEDS = st.integers(0, 2**32 - 1)
THRESHOLDS = st.one_of(st.floats(0, STEEPEST + 50), st.floats(-5, 1e6), st.integers(0, STEEPEST))


def by_opencv(across, down, low, high):
    turned = (np.ascontiguousarray(one[::-1]) for one in (across, -down))
    return cv2.Canny(*turned, low, high)[::-1] > 0


def gradients(height, width, seed, steepest, blur=0.0):
    """Random gradients, of which some are alike or 0, as those of a photo."""
    rng = np.random.default_rng(seed)
    both = rng.integers(-steepest, steepest, (2, height, width), endpoint=True).astype(np.int16)
    return [cv2.GaussianBlur(one, (0, 0), blur) if blur else one for one in both.astype(np.float32)]


@examples(200)
@given(
    SIDES, SIDES, SEEDS, st.sampled_from([1, 3, 40, 1020]), st.floats(0, 3), THRESHOLDS, THRESHOLDS
)
def test_edges_are_those_of_opencv(height, width, seed, steepest, blur, low, high):
    across, down = (
        np.rint(one).astype(np.int16) for one in gradients(height, width, seed, steepest, blur)
    )
    found = canny(across, down, low, high)
    assert found.dtype == np.bool_
    assert np.array_equal(found, by_opencv(across, down, low, high))


@pytest.mark.parametrize("width", [1, 63, 64, 65, 128, 200])
@pytest.mark.parametrize("start", ["first", "last"])
def test_an_edge_is_followed_as_far_as_it_winds(width, start):
    """A snake over the whole photo, of which only one end is strong."""
    snake = np.zeros((41, width), np.int16)
    snake[::4] = 100
    snake[2::8, -1:] = snake[6::8, :1] = 100
    snake[1::8, -1:] = snake[3::8, -1:] = snake[5::8, :1] = snake[7::8, :1] = 100
    row, column = (0, 0) if start == "first" else (40, width - 1)
    across, down = np.zeros_like(snake), snake
    assert not canny(across, down, 50, 220).any()
    down[row, column] = 500
    found = canny(across, down, 50, 220)
    assert found[row, column]
    assert np.array_equal(found, by_opencv(across, down, 50, 220))


@pytest.mark.parametrize("shape", [(0, 0), (0, 5), (5, 0)])
def test_nothing_has_no_edges(shape):
    nothing = np.zeros(shape, np.int16)
    assert canny(nothing, nothing, 50, 220).shape == shape


def test_a_part_of_a_photo_gives_what_a_copy_of_it_does():
    across, down = (one.astype(np.int16) for one in gradients(60, 90, 1, 300))
    part = (slice(7, 50), slice(11, 83))
    copies = [np.ascontiguousarray(one[part]) for one in (across, down)]
    found = canny(across[part], down[part], 50, 220)
    assert found.any()
    assert np.array_equal(found, canny(*copies, 50, 220))
