"""Colour maps: those of matplotlib, to within what nobody sees."""

import numpy as np
import pytest
from matplotlib import colormaps

from skyline_viz.colours import colour_map, coloured

THEIRS = {
    "viridis": "viridis",
    "inferno": "inferno",
    "magma": "magma",
    "magma_r": "magma_r",
    "twilight_shifted": "twilight_shifted",
    "blue_red": "RdBu_r",
    "gray": "gray",
}


@pytest.mark.parametrize("ours", THEIRS)
def test_a_colour_map_is_the_one_of_its_name(ours):
    places = np.linspace(0, 1, 256)
    wanted = colormaps[THEIRS[ours]](places, bytes=True)[:, :3].astype(int)
    assert np.abs(colour_map(ours) - wanted).max() <= 2


def test_of_scores_red_is_the_brightest_and_blue_the_darkest():
    grey = colour_map("blue_grey_red").astype(float) @ (0.2126, 0.7152, 0.0722)
    low, middle, high = grey[0], grey[128], colour_map("blue_grey_red")[255].max()
    assert low < middle < high
    assert colour_map("blue_grey_red")[0].argmax() == 2
    assert colour_map("blue_grey_red")[255].argmax() == 0


def test_values_beyond_the_ends_take_the_colour_of_the_end():
    table = colour_map("viridis")
    found = coloured("viridis", np.array([[-0.5, 0.0], [1.0, 7.0]]))
    assert np.array_equal(found, table[[[0, 0], [255, 255]]])


def test_a_cyclic_map_ends_where_it_begins():
    first, last = colour_map("twilight_shifted")[[0, -1]].astype(int)
    assert np.abs(first - last).max() <= 4


def test_tables_cannot_be_written_to_and_unknown_ones_are_refused():
    with pytest.raises(ValueError, match="read-only"):
        colour_map("magma")[0] = 0
    with pytest.raises(KeyError):
        colour_map("rainbow")
