"""Sobel gradients: those of OpenCV, of the strongest channel."""

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.planes import padded_planes
from skyline_viz.kernels.sobel import sobel
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


@examples(80)
@given(
    st.integers(1, 40),
    st.integers(1, 80),
    st.sampled_from([(), (3,)]),
    st.integers(0, 2**32 - 1),
    st.sampled_from([1, 6, 256]),
)
def test_gradients_are_those_of_the_strongest_channel(height, width, channels, seed, levels):
    rng = np.random.default_rng(seed)
    steps = 255 // max(levels - 1, 1)
    photo = (rng.integers(0, levels, (height, width, *channels)) * steps).astype(np.uint8)
    found = sobel(padded_planes(photo, 1))
    for one, expected in zip(found, plainly(photo), strict=True):
        assert one.dtype == np.int16
        assert np.array_equal(one, expected)


def test_the_steepest_step_fits():
    photo = np.zeros((4, 4, 3), np.uint8)
    photo[2:] = 255
    assert sobel(padded_planes(photo, 1))[1].max() == 1020
    assert sobel(padded_planes(255 - photo, 1))[1].min() == -1020
