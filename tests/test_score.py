"""Scores against a plain dot product, at the border too."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.config import FILTER_SIZES
from skyline_viz.score import score_at
from testing.examples import examples

STEADY = examples(40)


def slow_score(grey, row, column, taps):
    """The filter's output at one pixel, border pixels repeated, clipped to [0, 255], over 255."""
    height, width = grey.shape
    reach = len(taps) // 2
    total = 0.0
    for down in range(len(taps)):
        for right in range(len(taps)):
            r = min(max(row + down - reach, 0), height - 1)
            c = min(max(column + right - reach, 0), width - 1)
            total += float(taps[down, right]) * int(grey[r, c])
    return min(max(total, 0), 255) / 255


def noise(height=20, width=30, seed=0):
    return np.random.default_rng(seed).integers(0, 256, (height, width), dtype=np.uint8)


def whole(*values):
    return np.array(values, np.int32)


@pytest.mark.parametrize("size", FILTER_SIZES)
def test_every_pixel_and_border_against_plain_python(size):
    rng = np.random.default_rng(size)
    grey = noise(18, 21, size)
    filters = rng.normal(0.5 / size**2, 1 / size, (5, size, size)).astype(np.float32)
    rows, columns = (pixels.ravel().astype(np.int32) for pixels in np.mgrid[:18, :21])
    bins = rng.integers(0, 5, rows.size).astype(np.int32)
    found = score_at(grey, rows, columns, bins, filters)
    assert found.dtype == np.float32
    assert found.shape == rows.shape
    pixels = zip(rows, columns, bins, strict=True)
    expected = [slow_score(grey, row, column, filters[own]) for row, column, own in pixels]
    assert np.allclose(found, expected, atol=2e-5)
    assert 0.2 < np.mean((found > 0) & (found < 1)) < 1


@STEADY
@given(st.integers(1, 12), st.integers(1, 12), st.sampled_from([3, 7, 15]), st.integers(0, 999))
def test_small_photos(height, width, size, seed):
    rng = np.random.default_rng(seed)
    grey = noise(height, width, seed)
    filters = rng.normal(0.02, 0.1, (2, size, size)).astype(np.float32)
    rows = rng.integers(0, height, 6).astype(np.int32)
    columns = rng.integers(0, width, 6).astype(np.int32)
    bins = rng.integers(0, 2, 6).astype(np.int32)
    expected = [slow_score(grey, rows[i], columns[i], filters[bins[i]]) for i in range(len(rows))]
    assert np.allclose(score_at(grey, rows, columns, bins, filters), expected, atol=2e-5)


@pytest.mark.parametrize("size", FILTER_SIZES)
def test_a_single_tap_reads_a_single_pixel(size):
    grey = noise()
    for down, right in ((0, 0), (size - 1, 0), (0, size - 1), (size // 2, size // 2)):
        filters = np.zeros((1, size, size), np.float32)
        filters[0, down, right] = 1
        row, column = 10 - down + size // 2, 15 - right + size // 2
        found = score_at(grey, whole(row), whole(column), whole(0), filters)
        assert found[0] == pytest.approx(grey[10, 15] / 255, abs=1e-6)


def test_scores_are_clipped():
    filters = np.stack([np.full((7, 7), tap, np.float32) for tap in (-1, 0, 1 / 49, 1)])
    grey = np.full((9, 9), 100, np.uint8)
    found = score_at(grey, whole(4, 4, 4, 4), whole(4, 4, 4, 4), whole(0, 1, 2, 3), filters)
    assert found.tolist() == [0, 0, pytest.approx(100 / 255, rel=1e-5), 1]


def test_no_pixel():
    none = np.zeros(0, np.int32)
    assert score_at(noise(), none, none, none, np.ones((1, 7, 7), np.float32)).shape == (0,)


def test_the_photo_and_the_filters_are_left_alone():
    grey, filters = noise(), np.random.default_rng(0).normal(size=(3, 7, 7)).astype(np.float32)
    before = grey.copy(), filters.copy()
    grey.setflags(write=False)
    filters.setflags(write=False)
    score_at(grey, whole(0, 19), whole(29, 0), whole(2, 1), filters)
    assert np.array_equal(grey, before[0])
    assert np.array_equal(filters, before[1])
