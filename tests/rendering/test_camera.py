"""Cameras: a line that is tilted exactly, and what films make of light."""

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from skyline_viz.rendering.camera import PLAIN, Camera, any_camera
from skyline_viz.rendering.picture import Picture
from skyline_viz.rendering.terrain import Frame

FRAME = Frame(90, 60)


def drawn(camera, horizon=0.5):
    """Black ground below a grey sky, of the size that the camera asks for."""
    frame = camera.canvas(FRAME)
    picture = Picture.of(frame, np.full((frame.height, frame.width, 3), 0.5, np.float32))
    ground = np.arange(frame.height)[:, None] >= horizon * frame.height
    share = np.broadcast_to(np.float32(ground), picture.cover.shape)
    picture.paint(share, np.zeros(3, np.float32), "terrain")
    return picture


@given(st.floats(-0.45, 0.45))
def test_a_level_horizon_becomes_a_straight_line_of_the_angle(roll):
    camera = Camera(roll=roll)
    rows = camera.take(drawn(camera), FRAME).line()
    slope = -2 * roll / (1 - roll * roll)  # the tangent of the whole angle
    x = np.arange(90) - 44.5
    expected = 30 + x * slope
    inside = (expected > 1) & (expected < 59)
    assert np.abs(rows - expected)[inside].max() < 1.6


def test_an_upright_camera_takes_the_picture_as_it_is():
    picture = drawn(PLAIN)
    assert PLAIN.canvas(FRAME) == FRAME
    assert PLAIN.take(picture, FRAME) is picture


def test_a_window_frame_hides_and_does_not_move_the_line():
    camera = Camera(border="window", margin=0.1, shade=0.3)
    picture = camera.take(drawn(camera), FRAME)
    assert (picture.line() == 30).all()
    assert picture.hidden[30, 0] > 0.8
    assert picture.hidden[30, 20] < 0.1


def pixels(camera, light=0.3):
    photo = np.full((60, 90, 3), light, np.float32)
    file = camera.expose(photo, np.random.default_rng(1), contrast=0.0, grain=2.0)
    return np.array(Image.open(io.BytesIO(file)).convert("RGB")).astype(int)


def test_what_a_film_makes_of_light():
    plain = pixels(PLAIN)
    assert pixels(Camera(exposure=2)).mean() > plain.mean() + 30
    assert pixels(Camera(flare=0.1)).mean() > plain.mean() + 10
    assert pixels(Camera(grain=5)).std() > 1.5 * plain.std()
    assert np.ptp(pixels(Camera(grey=True)), axis=2).max() == 0
    red, _, blue = pixels(Camera(cast=(1.2, 1.0, 0.8))).mean(axis=(0, 1))
    assert red > blue + 20
    corner, middle = plain[:5, :5].mean(), plain[28:32, 43:47].mean()
    assert corner < middle - 8
    assert abs(pixels(Camera(vignette=0))[:5, :5].mean() - middle) < 4


def test_a_letterbox_is_dark_and_a_date_is_bright():
    photo = pixels(Camera(border="letterbox", margin=0.1))
    assert photo[:5].max() < 25
    assert photo[10:50].min() > 60
    changed = np.abs(pixels(Camera(stamp=True)) - pixels(PLAIN)).max(axis=2) > 60
    assert changed[-16:].any()
    assert not changed[:30].any()


def test_any_camera_is_one_of_many():
    cameras = [any_camera(np.random.default_rng(seed)) for seed in range(60)]
    assert cameras[0] == any_camera(np.random.default_rng(0))
    assert len({camera.border for camera in cameras}) >= 4
    assert max(abs(camera.roll) for camera in cameras) > 0.15
    assert max(camera.pitch for camera in cameras) > 0.2
    assert min(camera.pitch for camera in cameras) < -0.1
    assert all(1 <= camera.quality <= 95 for camera in cameras)
    assert any(camera.grey for camera in cameras)


@pytest.mark.parametrize("roll", [-0.4, 0.0, 0.23])
def test_the_canvas_reaches_into_all_corners(roll):
    camera = Camera(roll=roll)
    picture = camera.take(drawn(camera, horizon=0.0), FRAME)
    assert (picture.cover == 1).all()
