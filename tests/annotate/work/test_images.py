"""Pictures for the page: every stage and term of every detection as an overlay."""

import cv2
import numpy as np
import pytest

import skyline_viz as sv
from annotate.work import images
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.rendering import render

PHOTO = render("clear", 1, 180, 120).photo
METHODS = {"ours": sv.Detector(), "edges": EdgesOnly(), "gradient": GradientCost()}


def overlay(detection, name):
    """RGBA of an overlay."""
    data = np.frombuffer(images.stage(detection, name), np.uint8)
    return cv2.cvtColor(cv2.imdecode(data, cv2.IMREAD_UNCHANGED), cv2.COLOR_BGRA2RGBA)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("blank", [False, True])
def test_every_overlay_is_a_picture_of_the_photos_size(method, blank):
    found = METHODS[method].detect(np.full((120, 180, 3), 128, np.uint8) if blank else PHOTO)
    names = images.overlays(found)
    assert len(names) == len(set(names))
    for name in names:
        assert overlay(found, name).shape == (120, 180, 4)


def test_our_stages_and_terms_can_all_be_laid_over_the_photo():
    found = METHODS["ours"].detect(PHOTO)
    assert images.overlays(found) == (*images.STAGES, "no edge", "clear sky", "terrain")
    for name in images.STAGES:
        assert overlay(found, name)[..., 3].any()


def test_edge_pixels_alone_are_shown_where_others_have_no_value():
    found = METHODS["ours"].detect(PHOTO)
    for name in ("edges", "bin", "score"):
        assert np.array_equal(overlay(found, name)[..., 3] > 0, found.edges)
    legend = np.array([colour for _, colour in found.stages["bin"].legend])
    shown = overlay(found, "bin")[found.edge_rows, found.edge_columns, :3]
    assert np.array_equal(shown, legend[found.bins])


def test_a_stage_that_a_method_has_not_is_transparent():
    assert not overlay(METHODS["edges"].detect(PHOTO), "bin").any()


def test_orientation_ends_with_the_colour_that_it_begins_with():
    found = METHODS["ours"].detect(PHOTO)
    orientation, shown = found.stages["orientation"].map(), overlay(found, "orientation")
    colours = [shown[orientation < 2, :3], shown[orientation > 178, :3]]
    assert all(len(one) for one in colours)
    first, last = (one.mean(axis=0) for one in colours)
    assert np.abs(first - last).max() < 16
