"""Water is terrain, and mirrors what is above it."""

import numpy as np
import pytest

from skyline_viz.rendering.water import Water, draw_water
from testing.level_ground import SUN, level, noise


def drawn(spec, horizon=80):
    picture = level(horizon)
    picture.photo[20:30, 40:60] = 0.0  # something dark in the sky
    draw_water(picture, noise(), spec, SUN)
    return picture


def test_the_horizon_of_water_is_the_line():
    assert (drawn(Water(0.5)).line() == 40).all()
    assert (drawn(Water(0.5), horizon=25).line() == 25).all()


def test_a_lake_mirrors_and_a_rough_sea_hardly():
    calm, rough = (drawn(Water(0.5, waves)).photo for waves in (0.0, 1.0))
    dark = calm[52:58, 45:55].mean()
    assert dark < 0.3 < calm[52:58, 80:100].mean()
    assert abs(rough[52:58, 45:55].mean() - rough[52:58, 80:100].mean()) < 0.2


@pytest.mark.parametrize("horizon", [0.001, 0.985, 1.2])
def test_water_may_begin_anywhere(horizon):
    picture = drawn(Water(horizon))
    assert np.isfinite(picture.photo).all()
    assert (picture.line() == picture.line()[0]).all()
