"""Photos without the frames around them."""

import numpy as np
import pytest

from skyline_viz.edges import find_edges
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.frames import without_frame
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.rendering import render


@pytest.fixture(scope="module")
def scene():
    return render("clear", 8, 320, 200)


@pytest.fixture(scope="module")
def even_scene():
    return render("cloudy", 3, 480, 270)


def framed(photo, rows=2):
    photo = photo.copy()
    photo[:rows] = photo[-rows:] = 0
    return photo


def test_a_frame_is_no_skyline(scene, even_scene):
    for method, one in ((EdgesOnly(), scene), (GradientCost(), even_scene)):
        photo = framed(one.photo)
        assert find_edges(photo, "grey", 50, 220)[0][:4].mean(axis=1).max() > 0.5
        assert a_err(method.detect(photo).skyline, one.truth) < 2


def test_a_frame_is_painted_over_and_nothing_else(scene):
    assert without_frame(scene.photo) is scene.photo
    photo = framed(scene.photo)
    inside = without_frame(photo)
    assert (inside[4:-4] == photo[4:-4]).all()
    assert inside[0].any()
    assert inside[-1].any()
    assert without_frame(np.zeros((2, 2, 3), np.uint8)).shape == (2, 2, 3)


def test_a_photo_that_would_be_all_frame_stays_as_it_is():
    photo = np.repeat(np.uint8([0, 255, 0, 255]), 30 * 3).reshape(4, 30, 3)
    np.testing.assert_array_equal(without_frame(photo), photo)
