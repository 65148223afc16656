"""Sobel gradients: those of OpenCV, of the strongest channel."""

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.planes import padded_planes
from skyline_viz.kernels.sobel import gradients, sampled_strengths
from testing.examples import examples


def plainly(photo):
    """The same with numpy and OpenCV's own filter."""
    every = [photo] if photo.ndim == 2 else list(np.moveaxis(photo, 2, 0))
    across, down = (
        np.array(
            [cv2.Sobel(one, cv2.CV_16S, *order, borderType=cv2.BORDER_REPLICATE) for one in every]
        )
        for order in ((1, 0), (0, 1))
    )
    strongest = (np.abs(across) + np.abs(down)).argmax(axis=0)[None]
    return [np.take_along_axis(one, strongest, axis=0)[0] for one in (across, down)]


def row_by_row(photo):
    """Gradients along rows and columns, and their L1 norm, each ``(H, W)``."""
    planes = padded_planes(photo)
    height, width = photo.shape[:2]
    x, y = np.empty((2, height, width), np.int16)
    strength = np.empty((height, width + 2), np.int16)
    columns = np.empty((2, width + 2), np.int16)
    for row in range(height):
        gradients(planes, row, columns, x[row], y[row], strength[row])
    return x, y, strength[:, 1:-1]


def some_photo(height, width, channels, seed, levels):
    steps = 255 // max(levels - 1, 1)
    levels = np.random.default_rng(seed).integers(0, levels, (height, width, *channels))
    return (levels * steps).astype(np.uint8)


PHOTOS = st.builds(
    some_photo,
    st.integers(1, 40),
    st.integers(1, 80),
    st.sampled_from([(), (3,)]),
    st.integers(0, 2**32 - 1),
    st.sampled_from([1, 6, 256]),
)


@examples(80)
@given(PHOTOS)
def test_gradients_are_those_of_the_strongest_channel(photo):
    across, down = plainly(photo)
    found = row_by_row(photo)
    for one, expected in zip(found, (across, down, np.abs(across) + np.abs(down)), strict=True):
        assert np.array_equal(one, expected)


@examples(80)
@given(PHOTOS, st.integers(1, 9))
def test_a_sample_counts_rows_from_below(photo, step):
    across, down = (one[::-step, ::step] for one in plainly(photo))
    found = sampled_strengths(padded_planes(photo), step)
    assert found.dtype == np.int16
    assert np.array_equal(found, (np.abs(across) + np.abs(down)).ravel())


def test_the_steepest_step_fits():
    photo = np.zeros((4, 4, 3), np.uint8)
    photo[2:] = 255
    assert row_by_row(photo)[1].max() == row_by_row(photo)[2].max() == 1020
    assert row_by_row(255 - photo)[1].min() == -1020
