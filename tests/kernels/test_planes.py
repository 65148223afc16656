"""Padded planes: the channels, with their rim repeated."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.planes import REACH, padded_planes
from testing.examples import examples


@examples(60)
@given(st.integers(1, 20), st.integers(1, 20), st.sampled_from([(), (3,)]))
def test_planes_are_those_of_numpy(height, width, channels):
    photo = np.arange(height * width * (3 if channels else 1)).astype(np.uint8)
    photo = photo.reshape(height, width, *channels)
    planes = padded_planes(photo)
    expected = np.pad(
        np.moveaxis(np.atleast_3d(photo), 2, 0), ((0, 0), (REACH,) * 2, (REACH,) * 2), "edge"
    )
    assert planes.flags.c_contiguous
    assert np.array_equal(planes, expected)


def test_a_part_of_a_photo_has_its_own_rim():
    photo = np.arange(5 * 7 * 3, dtype=np.uint8).reshape(5, 7, 3)
    part = photo[1:4, 2:6]
    assert np.array_equal(padded_planes(part), padded_planes(part.copy()))
