"""Ranges of the renderer: how high they stand, and what they are clothed in."""

from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.rendering.mountains import Range, mountain_range
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.terrain import Frame, Light

FRAME = Frame(96, 64)
LIGHT = Light((0.6, -0.38, 0.7), (1.2, 1.1, 1.0), (0.2, 0.25, 0.3), (0.6, 0.65, 0.7))
PLAIN = Range(0.3, 200, "rock")


def built(spec, seed=2):
    rng = np.random.default_rng(seed)
    return mountain_range(FRAME, Noise(rng), rng, spec, LIGHT)


@pytest.mark.parametrize("top", [0.2, 0.45])
def test_the_highest_point_stands_in_the_row_that_was_asked_for(top):
    terrain = built(replace(PLAIN, top=top))
    assert terrain.rows.min() == pytest.approx(top * FRAME.height, abs=1e-3)
    assert terrain.rows.shape == terrain.colour.shape[:2]
    assert terrain.rows.shape[1] == FRAME.width
    assert np.isfinite(terrain.colour).all()


def test_one_generator_builds_one_range():
    np.testing.assert_array_equal(built(PLAIN).rows, built(PLAIN).rows)
    other = built(PLAIN, seed=3).rows
    assert other.shape != built(PLAIN).rows.shape or np.abs(other - built(PLAIN).rows).max() > 1


def test_haze_fades_far_terrain_into_its_colour():
    near, far = (built(replace(PLAIN, haze=haze, mist=0.0)).colour for haze in (0.0, 0.9))
    haze = np.float32(LIGHT.haze)
    assert np.abs(far - haze).mean() < 0.2 * np.abs(near - haze).mean()


def test_snow_lies_above_its_line():
    snowy = Range(0.3, 200, "snow", snow=0.2)
    bare = replace(snowy, snow=3.0)
    assert built(snowy).colour.mean() > 1.2 * built(bare).colour.mean()
