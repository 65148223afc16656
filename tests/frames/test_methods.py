"""Methods other than ours are not led astray by frames."""

import pytest

from skyline_viz.edges import find_edges
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.methods.edges_only import EdgesOnly
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
        assert find_edges(photo, "grey", 50, 220)[:4].mean(axis=1).max() > 0.5
        assert a_err(method.detect(photo).skyline, one.truth) < 2
