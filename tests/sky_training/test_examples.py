"""What a sky model learns from."""

import numpy as np
import pytest

from skyline_viz.arrays import U8
from skyline_viz.sky_training.examples import COLUMNS, ROWS, Example
from skyline_viz.skyline import Skyline, SkylineError


def photo(height=60, width=90) -> U8:
    return np.random.default_rng(0).integers(0, 256, (height, width, 3), np.uint8)


def test_the_sky_of_an_example_ends_at_the_line_to_a_part_of_a_pixel():
    example = Example.of(photo(), Skyline(rows=np.full(90, 20.5, np.float32)), "made")
    assert example.photo.shape == (ROWS, COLUMNS, 3)
    np.testing.assert_allclose(example.sky.sum(axis=0) / 255, 20.5 * ROWS / 60, atol=0.2)
    np.testing.assert_allclose(example.line, 20.5 * ROWS / 60, atol=0.2)


def test_columns_without_a_line_take_that_between_their_neighbours():
    rows = np.full(90, 30, np.float32)
    rows[40:50] = 0
    visible = np.ones(90, bool)
    visible[40:50] = False
    example = Example.of(photo(), Skyline(rows=rows, visible=visible), "made")
    np.testing.assert_allclose(example.line, ROWS / 2, atol=0.2)


def test_sky_below_terrain_is_no_line():
    sky = np.zeros((ROWS, COLUMNS), np.uint8)
    sky[100:200] = 255
    assert Example(np.zeros((ROWS, COLUMNS, 3), np.uint8), sky, "made").line is None


def test_a_truth_that_does_not_fit_is_refused():
    with pytest.raises(SkylineError, match="90"):
        Example.of(photo(), Skyline(rows=np.zeros(80, np.float32)), "made")
    hidden = Skyline(rows=np.zeros(90, np.float32), visible=np.zeros(90, bool))
    with pytest.raises(SkylineError, match="visible"):
        Example.of(photo(), hidden, "made")
