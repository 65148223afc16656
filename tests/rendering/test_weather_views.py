"""Views in haze, between clouds, and under a deep blue sky."""

import numpy as np
import pytest

from skyline_viz.rendering import weather_views
from skyline_viz.rendering.air import Bank, Overcast
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.terrain import Frame
from skyline_viz.rendering.views import Choice

FRAME = Frame(640, 360)


def made(view, seed=0):
    return view(Choice(FRAME, np.random.default_rng(seed)))


@pytest.mark.parametrize("seed", range(8))
def test_the_last_ridge_of_blue_is_nearly_air(seed):
    hazes = [one.haze for one in made(weather_views.blue, seed).layers if isinstance(one, Range)]
    assert max(hazes) > 0.9
    assert hazes[-1] == 0


@pytest.mark.parametrize("seed", range(4))
def test_banks_lie_behind_and_before_the_mountains(seed):
    kinds = [type(one) for one in made(weather_views.banks, seed).layers]
    first = kinds.index(Range)
    assert Bank in kinds[:first]
    assert Bank in kinds[first:]


def test_overcast_begins_with_its_sheet():
    assert isinstance(made(weather_views.overcast).layers[0], Overcast)


@pytest.mark.parametrize("seed", range(6))
def test_under_a_glacier_sky_snow_is_brighter(seed):
    view = made(weather_views.glacier, seed)
    assert max(view.sky.zenith) < 0.6 < max(view.light.sunlight)
    assert any(one.cover == "snow" for one in view.layers if isinstance(one, Range))
