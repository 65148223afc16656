"""Open ground of the renderer: level up to the horizon, stony or covered with bushes."""

from dataclasses import replace

import numpy as np

from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.plain import Plain, plain
from skyline_viz.rendering.terrain import Frame, Light

FRAME = Frame(96, 64)
LIGHT = Light((0.6, -0.38, 0.7), (1.2, 1.1, 1.0), (0.2, 0.25, 0.3), (0.6, 0.65, 0.7))
GROUND = Plain(0.5, "desert", rocks=0.0, haze=0.0)


def built(spec):
    return plain(FRAME, Noise(np.random.default_rng(1)), spec, LIGHT)


def test_it_reaches_from_below_the_photo_to_the_horizon():
    terrain = built(GROUND)
    assert terrain.rows[0].min() > FRAME.height  # what stands there may reach into the photo
    horizon = np.minimum.accumulate(terrain.rows, axis=0)[-1]
    np.testing.assert_allclose(horizon, 0.5 * FRAME.height, atol=1.0)


def test_stones_and_bushes_stand_on_it():
    bare = built(GROUND)
    for spec in (replace(GROUND, rocks=1.0), replace(GROUND, shrubs=1.0)):
        clothed = built(spec)
        assert (clothed.rows <= bare.rows + 0.5).mean() > 0.9  # they only stand up from it
        assert np.abs(clothed.rows - bare.rows).max() > 0.05
        assert np.abs(clothed.colour - bare.colour).max() > 0.05


def test_the_horizon_is_hazier_than_the_ground_at_the_feet():
    clear, hazy = built(GROUND).colour, built(replace(GROUND, haze=0.9)).colour
    change = np.abs(hazy - clear).mean(axis=(1, 2))
    assert change[0] < 0.01
    assert change[-1] > 0.1


def test_fields_differ_in_colour_and_lie_flat():
    bare, fields = built(GROUND), built(replace(GROUND, cover="heath", fields=80.0))
    green = fields.colour[..., 1] - fields.colour[..., 0]
    assert np.std(green) > 1.2 * np.std(bare.colour[..., 1] - bare.colour[..., 0])
    np.testing.assert_allclose(fields.rows[-1], bare.rows[-1], atol=1.0)
