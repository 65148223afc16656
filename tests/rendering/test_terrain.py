"""What all terrain of the renderer shares: its frame, its light, and how it is drawn."""

import numpy as np
import pytest

from skyline_viz.rendering.terrain import Frame, Light, Terrain, lighting, project, tint

SUN = Light((0.6, 0.0, 0.8), (1.0, 1.0, 1.0), (0.1, 0.2, 0.3), (0.5, 0.5, 0.5))
WEST = Light((-0.6, 0.0, 0.8), (1.0, 1.0, 1.0), (0.1, 0.2, 0.3), (0.5, 0.5, 0.5))


def test_a_frame_has_about_720_by_720_reference_pixels():
    frame = Frame(960, 540)
    assert frame.unit == pytest.approx(1.0)
    assert frame.across * frame.down == pytest.approx(720**2)
    assert Frame(1920, 1080).across == pytest.approx(frame.across)


def test_level_ground_gets_the_sun_and_the_sky():
    height = np.zeros((4, 5), np.float32)
    x = np.arange(5, dtype=np.float32)[None, :]
    light = lighting(height, x, (1.0, 1.0), SUN, height)
    np.testing.assert_allclose(light, np.broadcast_to(0.8 + 0.8 * tint(SUN.skylight), (4, 5, 3)))


@pytest.mark.parametrize(("sun", "shadow"), [(SUN, slice(5, 20)), (WEST, slice(21, 36))])
def test_a_wall_throws_its_shadow_away_from_the_sun(sun, shadow):
    height = np.zeros((3, 41), np.float32)
    height[:, 20] = 60
    x = np.arange(41, dtype=np.float32)[None, :]
    light = lighting(height, x, (1.0, 1.0), sun, np.zeros_like(height))
    dark = light[1, shadow, 0].mean()
    other = slice(41 - shadow.stop, 41 - shadow.start)
    assert dark < 0.2
    assert light[1, other, 0].mean() > 0.6


def test_the_outline_is_the_highest_row_and_covers_its_share_of_a_pixel():
    rows = np.repeat(np.float32([9, 6.25, 7]), 4).reshape(3, 4)  # the far sample is hidden
    colour = np.ones((3, 4, 3), np.float32) * np.float32([0.2, 0.4, 0.9])[:, None, None]
    photo = np.zeros((10, 4, 3), np.float32)
    outline = project(Terrain(rows, colour), photo)
    np.testing.assert_array_equal(outline, 6.25)
    assert (photo[:6] == 0).all()
    np.testing.assert_allclose(photo[6], 0.75 * 0.4, atol=0.02)
    assert (photo[7:] <= 0.4 + 1e-6).all()  # nothing of the hidden one is seen
    assert (photo[7:] >= 0.2 - 1e-6).all()
