"""The picture that scenes are drawn into, and flat shapes."""

import numpy as np
import pytest

from skyline_viz.rendering.picture import Picture
from skyline_viz.rendering.terrain import Frame, Terrain

FRAME = Frame(96, 64)
WHITE = np.ones(3, np.float32)


@pytest.fixture
def picture():
    return Picture.of(FRAME, np.zeros((64, 96, 3), np.float32))


def share(picture, mask):
    return np.broadcast_to(np.float32(mask), picture.cover.shape)


def test_a_picture_begins_as_sky_alone(picture):
    assert (picture.line() == 64).all()
    assert not picture.hidden.any()


def test_ground_covers_what_is_below_its_outline(picture):
    rows = np.full((3, 96), 20.25, np.float32) + np.float32([[20], [10], [0]])
    picture.ground(Terrain(rows, np.ones((3, 96, 3), np.float32)))
    assert (picture.line() == 20).all()
    assert picture.cover[20, 0] == pytest.approx(0.75)
    assert (picture.cover[21:] == 1).all()


def test_terrain_moves_the_line_and_a_thing_hides_it(picture):
    below = share(picture, np.arange(64)[:, None] >= 30)
    picture.paint(below, WHITE, "terrain")
    post = share(picture, np.arange(96)[None, :] == 7)
    picture.paint(post, WHITE, "thing")
    assert (picture.line() == 30).all()
    assert np.flatnonzero(picture.hidden[30]).tolist() == [7]
    picture.paint(below, WHITE, "terrain")  # nearer than the post
    assert not picture.hidden[30].any()
    assert picture.hidden[29, 7] == 1


def test_a_tree_is_rooted_in_terrain(picture):
    assert picture.root(50, 10) * FRAME.unit > 64
    picture.paint(share(picture, np.arange(64)[:, None] >= 30), WHITE, "terrain")
    assert picture.root(50, 10) * FRAME.unit > 31
    assert picture.root(50, 600) == 600


def test_shapes_have_their_area(picture):
    window = picture.everywhere()
    unit = FRAME.unit
    square = window.polygon((100, 100), (300, 100), (300, 250), (100, 250))
    assert square.sum() == pytest.approx(200 * 150 * unit * unit, rel=0.02)
    assert window.box(100, 100, 300, 250).sum() == pytest.approx(square.sum(), rel=0.02)
    assert window.box(100, 100, 101, 250).sum() == pytest.approx(150 * unit * unit, rel=0.02)
    disc = window.disc(300, 200, 100).sum()
    assert disc == pytest.approx(np.pi * 1e4 * unit * unit, rel=0.03)
    assert window.limb((300, 200), (300, 200), (100, 100)).sum() == pytest.approx(disc, rel=0.01)


def test_what_is_painted_in_a_window_is_in_the_picture(picture):
    window = picture.window(-50, 100, 200, 9000)
    window.picture.paint(window.box(0, 200, 100, 9000), WHITE, "terrain")
    assert picture.photo[-1, 0].min() > 0.999
    assert picture.line()[0] == round(200 * FRAME.unit)
    assert picture.window(5000, 0, 6000, 10).empty
