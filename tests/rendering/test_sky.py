"""Skies of the renderer: from the zenith down to the horizon, with veils and clouds."""

from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.sky import Sky, paint_sky
from skyline_viz.rendering.terrain import Frame

FRAME = Frame(160, 120)
BLUE = Sky((0.1, 0.2, 0.5), (0.5, 0.6, 0.7))


def painted(sky, sunward=1, seed=0):
    rng = np.random.default_rng(seed)
    return paint_sky(FRAME, Noise(rng), rng, sky, sunward=sunward)


def test_a_bare_sky_goes_from_the_zenith_to_the_horizon():
    photo = painted(BLUE)
    assert photo.shape == (120, 160, 3)
    middle = photo[:, 80]
    np.testing.assert_allclose(middle[0], BLUE.zenith, atol=0.02)
    np.testing.assert_allclose(middle[-1], BLUE.horizon, atol=0.02)
    assert (np.diff(middle, axis=0) >= -1e-6).all()


def test_it_is_brighter_on_the_side_of_the_sun():
    right = painted(BLUE)
    assert right[40, -1].sum() > right[40, 0].sum()
    np.testing.assert_allclose(painted(BLUE, -1)[40, ::-1], right[40], atol=0.01)


@pytest.mark.parametrize("what", [{"veil": 0.8}, {"heaps": 4}])
def test_veils_and_heaps_whiten_some_of_it(what):
    sky = replace(BLUE, **what)
    changed = np.abs(painted(sky) - painted(BLUE)).sum(axis=2) > 0.05
    assert 0.01 < changed.mean() < 1
    assert painted(sky).max() < 1.4
    np.testing.assert_array_equal(painted(sky), painted(sky))
