"""Views at dusk and dawn, in the last light, and at night."""

import numpy as np
import pytest

from skyline_viz.rendering import hour_views
from skyline_viz.rendering.air import Glow, Stars
from skyline_viz.rendering.terrain import Frame
from skyline_viz.rendering.views import Choice

FRAME = Frame(640, 360)


def made(view, seed=0):
    return view(Choice(FRAME, np.random.default_rng(seed)))


@pytest.mark.parametrize("seed", range(6))
def test_dusk_is_a_dark_ridge_before_a_glow(seed):
    view = made(hour_views.dusk, seed)
    assert isinstance(view.layers[0], Glow)
    assert max(view.light.sunlight) < max(view.sky.horizon)


def test_alpenglow_is_red():
    for seed in range(6):
        red, green, blue = made(hour_views.alpenglow, seed).light.sunlight
        assert red < 0.1 or red > green > blue


@pytest.mark.parametrize("seed", range(6))
def test_night_is_dark_and_has_stars(seed):
    view = made(hour_views.night, seed)
    assert isinstance(view.layers[0], Stars)
    assert max(*view.sky.zenith, *view.sky.horizon) < 0.15
