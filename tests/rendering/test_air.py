"""Clouds, glow and stars."""

import numpy as np

from skyline_viz.rendering.air import Bank, Glow, Overcast, Stars, draw_air
from testing.level_ground import HORIZON, SKY, dice, level, noise

WHITE, GREY = (1.0, 1.0, 1.0), (0.4, 0.4, 0.4)


def drawn(spec, seed=1):
    picture = level()
    draw_air(picture, noise(seed), dice(seed), spec)
    return picture


def test_a_bank_hides_the_line_and_does_not_move_it():
    picture = drawn(Bank(0.3, 0.4, WHITE, GREY))
    assert (picture.line() == HORIZON).all()
    assert np.mean(picture.hidden[HORIZON] > 0.8) > 0.8
    assert picture.hidden[:6].max() == 0
    thin = drawn(Bank(0.3, 0.4, WHITE, GREY, strength=0.5))
    assert thin.hidden.max() <= 0.5


def test_a_bank_out_of_sight_draws_nothing():
    assert np.array_equal(drawn(Bank(3.0, 0.1, WHITE, GREY)).photo, level().photo)


def test_overcast_hides_the_sky():
    picture = drawn(Overcast(0.5, WHITE, GREY))
    assert np.std(picture.photo[:30]) > 0.02
    assert (picture.line() == HORIZON).all()


def test_a_glow_is_brightest_at_its_middle():
    photo = drawn(Glow(0.25, 0.5, (0.3, 0.2, 0.1))).photo - level().photo
    assert photo[40, 30, 0] > photo[40, 110, 0] > 0
    assert photo[40, 30, 0] > photo[5, 30, 0] > 0
    assert photo[40, 30, 0] > photo[40, 30, 2]
    disc = drawn(Glow(0.25, 0.25, (0.3, 0.2, 0.1), disc=60.0)).photo
    assert disc[20, 30].min() > SKY


def test_stars_are_counted():
    changed = (drawn(Stars(20)).photo != level().photo).any(axis=2)
    assert 15 <= changed.sum() <= 20
