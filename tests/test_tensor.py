"""Structure tensor: dense against sparse against plain Python, and the angles of known ramps."""

from dataclasses import astuple
from math import atan2, degrees, sqrt

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.tensor import WINDOW, tensor_at, tensor_map
from testing.examples import examples

STEADY = examples(40)


def noise(height=17, width=23, seed=0):
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), dtype=np.uint8)


def smooth(height=40, width=50, seed=0):
    return cv2.GaussianBlur(noise(height, width, seed), (0, 0), 3)


def step(height=20, width=30, row=9):
    photo = np.full((height, width, 3), 200, np.uint8)
    photo[row:] = (40, 60, 30)
    return photo


def ramp(down, right, height=24, width=24):
    """Grey photo that brightens by `down` levels a row and `right` levels a column."""
    rows, columns = np.mgrid[:height, :width]
    grey = 128 + down * (rows - height // 2) + right * (columns - width // 2)
    return np.repeat(grey.astype(np.uint8)[:, :, None], 3, axis=2)


def every_pixel(photo):
    rows, columns = np.mgrid[: photo.shape[0], : photo.shape[1]]
    return rows.ravel().astype(np.int32), columns.ravel().astype(np.int32)


def turned(one, other):
    """Angle between two orientations, in degrees."""
    return np.abs((one - other + 90) % 180 - 90)


def coherences_agree(one, other):
    """To 1e-4, and to 1e-3 where float32 sums cannot tell the small eigenvalue from zero."""
    close = np.isclose(one, other, rtol=1e-4, atol=1e-5)
    return (close | ((other > 0.99) & np.isclose(one, other, atol=1e-3))).all()


def slow_tensor(photo, row, column):
    """Strength, coherence and orientation by the published formulas, pixel by pixel."""
    height, width = photo.shape[:2]

    def value(r, c, channel):
        return int(photo[min(max(r, 0), height - 1), min(max(c, 0), width - 1), channel])

    xx = xy = yy = 0.0
    for down in range(6):
        for right in range(6):
            weight = float(WINDOW[down]) * float(WINDOW[right])
            r, c = row + down - 3, column + right - 3
            for channel in range(3):
                corners = [value(r + i, c + j, channel) for i in (0, 1) for j in (0, 1)]
                north_west, north_east, south_west, south_east = corners
                gx = (north_east + south_east - north_west - south_west) / 2
                gy = (south_west + south_east - north_west - north_east) / 2
                xx += weight * gx * gx
                xy += weight * gx * gy
                yy += weight * gy * gy
    root = sqrt(((xx - yy) / 2) ** 2 + xy**2)
    large, small = sqrt((xx + yy) / 2 + root), sqrt(max((xx + yy) / 2 - root, 0))
    coherence = (large - small) / (large + small) if large > 0 else 0.0
    return large, coherence, degrees(atan2(2 * xy, xx - yy)) / 2 % 180


PHOTOS = {"noise": noise(), "smooth": smooth(), "step": step(), "ramp": ramp(3, 2)}


@pytest.mark.parametrize("name", PHOTOS)
def test_dense_and_sparse_agree_everywhere(name):
    photo = PHOTOS[name]
    dense, sparse = tensor_map(photo), tensor_at(photo, *every_pixel(photo))
    for feature in ("strength", "coherence", "orientation"):  # both round in the same order
        assert np.array_equal(getattr(dense, feature).ravel(), getattr(sparse, feature)), feature


@STEADY
@given(st.integers(2, 12), st.integers(2, 12), st.integers(0, 2**32 - 1))
def test_dense_and_sparse_agree_on_small_photos(height, width, seed):
    photo = noise(height, width, seed)
    dense, sparse = tensor_map(photo), tensor_at(photo, *every_pixel(photo))
    for feature in ("strength", "coherence", "orientation"):  # both round in the same order
        assert np.array_equal(getattr(dense, feature).ravel(), getattr(sparse, feature)), feature


@pytest.mark.parametrize("name", PHOTOS)
def test_plain_python_gives_the_same(name):
    photo = PHOTOS[name]
    height, width = photo.shape[:2]
    rng = np.random.default_rng(1)
    corners = [(0, 0), (0, width - 1), (height - 1, 0), (height - 1, width - 1), (9, 0), (8, 4)]
    inside = zip(rng.integers(0, height, 30), rng.integers(0, width, 30), strict=True)
    pixels = [*corners, *((int(row), int(column)) for row, column in inside)]
    rows, columns = np.array(pixels, np.int32).T
    found = tensor_at(photo, np.ascontiguousarray(rows), np.ascontiguousarray(columns))
    for index, (row, column) in enumerate(pixels):
        strength, coherence, orientation = slow_tensor(photo, row, column)
        assert found.strength[index] == pytest.approx(strength, rel=1e-4, abs=1e-4)
        # float32 loses the square root of the small eigenvalue below a thousandth of the large one
        assert found.coherence[index] == pytest.approx(coherence, abs=2e-3)
        assert turned(found.orientation[index], orientation) * coherence < 0.02


@pytest.mark.parametrize(
    ("down", "right", "orientation"),
    [(5, 0, 90), (-5, 0, 90), (0, 5, 0), (0, -5, 0), (4, 4, 45), (-4, -4, 45), (4, -4, 135)],
)
def test_orientation_of_ramps(down, right, orientation):
    tensor = tensor_map(ramp(down, right))
    inside = (slice(4, -4), slice(4, -4))
    assert turned(tensor.orientation[inside], orientation).max() < 1e-3
    assert tensor.coherence[inside].min() > 0.99


def test_strength_of_a_ramp_is_its_slope_over_all_channels():
    photo = ramp(0, 5)
    total = float(WINDOW.sum()) ** 2
    expected = sqrt(total * 3 * 5**2)  # 2x2 differences halve and add twice: 5 levels a pixel
    assert tensor_map(photo).strength[12, 12] == pytest.approx(expected, rel=1e-5)
    photo[:, :, 1] = 128
    expected = sqrt(total * 2 * 5**2)
    assert tensor_map(photo).strength[12, 12] == pytest.approx(expected, rel=1e-5)


def test_a_horizontal_ridge_is_seen_at_90_degrees():
    photo = step(row=9)
    tensor = tensor_map(photo)
    assert (tensor.orientation[8:10] == 90).all()
    assert (tensor.coherence[8:10] == 1).all()
    assert (tensor.strength[[8, 9]] > 0.9 * tensor.strength.max()).all()
    assert (tensor.strength[:5] == 0).all()


def test_a_vertical_ridge_is_seen_at_0_degrees():
    tensor = tensor_map(np.ascontiguousarray(step().transpose(1, 0, 2)))
    assert (tensor.orientation[:, 8:10] == 0).all()


def test_orientations_stay_below_180_degrees():
    # nearly vertical edges: angles fall on both sides of the wrap
    photo = np.zeros((60, 60, 3), np.uint8)
    photo[:, 30:] = 250
    photo = np.clip(photo + np.random.default_rng(0).integers(0, 3, photo.shape), 0, 255)
    orientation = tensor_map(photo.astype(np.uint8)).orientation
    assert orientation.min() >= 0
    assert orientation.max() < 180
    assert (orientation[:, 29] > 170).any()
    assert (orientation[:, 29] < 10).any()


def test_an_angle_a_hair_below_180_degrees_is_0():
    photo = np.zeros((20, 60, 3), np.uint8)
    photo[:, 30:] = 255
    photo[13, 26] = 1  # in the outermost corner of the window around row 10, column 29
    assert slow_tensor(photo, 10, 29)[2] > 179.9999
    sparse = tensor_at(photo, np.array([10], np.int32), np.array([29], np.int32))
    assert sparse.orientation.tolist() == [0]
    assert tensor_map(photo).orientation[10, 29] == 0


@pytest.mark.parametrize("slope", range(-3, 4))
def test_ranges(slope):
    tensor = tensor_map(np.maximum(noise(seed=9), ramp(1, slope, 17, 23)))
    assert tensor.strength.min() >= 0
    assert 0 <= tensor.coherence.min() <= tensor.coherence.max() <= 1
    assert 0 <= tensor.orientation.min() <= tensor.orientation.max() < 180


def test_flat_photos_have_no_strength_and_no_coherence():
    tensor = tensor_map(np.full((9, 9, 3), 77, np.uint8))
    assert not tensor.strength.any()
    assert not tensor.coherence.any()
    assert np.isfinite(tensor.orientation).all()


@pytest.mark.parametrize("name", PHOTOS)
def test_flipping_left_right_mirrors_the_angles(name):
    photo = PHOTOS[name]
    here, there = tensor_map(photo), tensor_map(np.ascontiguousarray(photo[:, ::-1]))
    assert np.allclose(there.strength[:, ::-1], here.strength, rtol=1e-4, atol=1e-6)
    assert coherences_agree(there.coherence[:, ::-1], here.coherence)
    angle = turned(there.orientation[:, ::-1], 180 - here.orientation) / 180
    assert (angle * here.coherence).max() < 1e-4


def test_swapping_the_channels_changes_nothing():
    photo = noise()
    for one, other in zip(
        astuple(tensor_map(photo)), astuple(tensor_map(photo[:, :, [2, 0, 1]].copy())), strict=True
    ):
        assert np.allclose(one, other, rtol=1e-4, atol=1e-4)


def test_pixels_in_any_order_and_twice():
    photo = smooth()
    rows = np.array([39, 0, 5, 5, 20, 0, 39, 5], np.int32)
    columns = np.array([49, 0, 7, 7, 3, 49, 0, 6], np.int32)
    found = astuple(tensor_at(photo, rows, columns))
    for values, dense in zip(found, astuple(tensor_map(photo)), strict=True):
        assert values.shape == (8,)
        assert values.dtype == np.float32
        assert np.allclose(values, dense[rows, columns], rtol=1e-4, atol=1e-3)


def test_no_pixel_at_all():
    none = np.zeros(0, np.int32)
    assert [values.shape for values in astuple(tensor_at(noise(), none, none))] == [(0,)] * 3


def test_the_window_is_even_and_symmetric():
    assert len(WINDOW) == 6
    assert np.array_equal(WINDOW, WINDOW[::-1])
    assert WINDOW.sum() == pytest.approx(1, abs=1e-3)
