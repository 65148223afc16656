"""What a sky model learns from."""

import numpy as np
import pytest

from skyline_viz.arrays import U8
from skyline_viz.datasets.item import LoadedItem
from skyline_viz.sky_training.examples import COLUMNS, ROWS, Example, example_of
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


class Teacher:
    """Says that the left half is sky, whatever it sees."""

    def sky(self, photo: U8):
        del photo
        return np.repeat(np.arange(8)[None] < 4, 6, axis=0).astype(np.float32)


def test_a_photo_without_truth_takes_what_a_teacher_says_of_it_and_its_mirror():
    item = LoadedItem("p", photo())
    assert example_of(item, "made") is None
    example = example_of(item, "made", Teacher())
    assert example.source == "made"
    np.testing.assert_allclose(example.sky, 128, atol=1)  # left and right, half of each


def test_a_truth_counts_for_more_than_a_teacher():
    item = LoadedItem("p", photo(), Skyline(rows=np.full(90, 30, np.float32)))
    example = example_of(item, "made", Teacher())
    np.testing.assert_allclose(example.line, ROWS / 2, atol=0.2)
