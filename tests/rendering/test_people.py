"""People stand before the line."""

import numpy as np

from skyline_viz.rendering.people import People, draw_people
from testing.level_ground import HORIZON, SUN, dice, level, noise


def drawn(spec, seed=1):
    picture = level()
    draw_people(picture, noise(seed), dice(seed), spec, SUN)
    return picture


def test_people_hide_the_line_and_do_not_move_it():
    picture = drawn(People(1, 0.9))
    assert (picture.line() == HORIZON).all()
    hidden = np.count_nonzero(picture.hidden[HORIZON] > 0.8)
    assert 8 < hidden < 40


def test_small_people_stay_below_the_line():
    picture = drawn(People(4, 0.3))
    assert picture.hidden[: HORIZON + 1].max() == 0
    assert picture.hidden[60:].max() == 1
