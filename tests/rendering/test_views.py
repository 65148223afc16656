"""A view through another camera."""

import numpy as np
import pytest

from skyline_viz.rendering.camera import PLAIN, Camera
from skyline_viz.rendering.kinds import KINDS, compose
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.terrain import Frame
from skyline_viz.rendering.views import shaded


def made(kind, seed=0):
    return compose(kind, Frame(640, 360), np.random.default_rng(seed))


def test_the_plain_camera_changes_nothing():
    view = made("clear")
    assert view.through(PLAIN) == view


def tops(view):
    return [layer.top for layer in view.layers if isinstance(layer, Range)]


def test_a_camera_that_looks_up_moves_all_down():
    view = made("clear")
    moved = view.through(Camera(pitch=0.3))
    assert moved.sky.low == pytest.approx(view.sky.low + 0.3)
    assert tops(moved)[:2] == pytest.approx([top + 0.3 for top in tops(view)[:2]])


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("pitch", [-0.9, -0.2, 0.5])
def test_ground_stays_in_the_photo(kind, pitch):
    moved = made(kind, 3).through(Camera(pitch=pitch))
    assert all(0.02 < top < 0.96 for top in tops(moved))


def test_tilts_add_up_and_grey_stays():
    assert made("aerial").through(Camera(roll=0.1)).camera.roll == pytest.approx(
        made("aerial").camera.roll + 0.1
    )
    assert made("rover").through(Camera()).camera.grey


def test_shaded_colours():
    assert shaded((0.2, 0.4, 1.0), 0.5) == pytest.approx((0.1, 0.2, 0.5))
