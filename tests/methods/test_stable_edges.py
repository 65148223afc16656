"""Edges at most thresholds."""

import cv2
import numpy as np
import pytest

from skyline_viz.methods.stable_edges import stable_edges
from skyline_viz.rendering import render


@pytest.fixture(scope="module")
def scene():
    return render("clear", 8, 320, 200)


@pytest.fixture(scope="module")
def even_scene():
    return render("cloudy", 3, 480, 270)


def test_stable_edges_are_a_share_of_the_canny_maps(scene):
    loose = stable_edges(scene.photo, share=0.01)
    half = stable_edges(scene.photo)
    strict = stable_edges(scene.photo, share=1.0)
    assert strict.sum() < half.sum() < loose.sum()
    assert not (strict & ~half).any()
    assert not (half & ~loose).any()


def test_stable_edges_lie_on_the_skyline(even_scene):
    edges = stable_edges(even_scene.photo).astype(np.uint8)
    near = cv2.dilate(edges, np.ones((5, 1), np.uint8))
    rows = even_scene.truth.pixel_rows(270).clip(0, 269)
    assert near[rows, np.arange(480)].mean() > 0.95
    assert edges.mean() < 0.2


def test_a_photo_of_one_colour_has_no_stable_edges():
    assert not stable_edges(np.full((20, 30, 3), 77, np.uint8)).any()


def test_most_thresholds_are_half_of_them_unless_said(scene):
    stable = stable_edges(scene.photo)
    np.testing.assert_array_equal(stable, stable_edges(scene.photo, share=0.5))
    assert stable.sum() < stable_edges(scene.photo, share=0.3).sum()
