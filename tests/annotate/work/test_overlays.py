"""Stages and terms of the cost, laid over the photo."""

import cv2
import numpy as np
import pytest

import skyline_viz as sv
from annotate.work import images
from annotate.work.overlays import overlay as made
from annotate.work.overlays import overlays
from skyline_viz.colours import coloured
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.rendering import render
from skyline_viz.stage import OURS
from skyline_viz.tensor import tensor_map
from testing.labelling import DETECTOR, hills

STAGES = tuple(one.name for one in OURS)


def overlay(detection, name):
    """Pixels of an overlay."""
    data = np.frombuffer(made(detection, name).data, np.uint8)
    picture = cv2.imdecode(data, cv2.IMREAD_UNCHANGED)
    return picture[..., [2, 1, 0, *range(3, picture.shape[2])]]


@pytest.mark.parametrize("name", STAGES)
def test_a_stage_is_seen_where_it_has_values(name):
    detection = DETECTOR.detect(hills(1))
    layer = overlay(detection, name)
    assert layer.shape == (*detection.edges.shape, 4)
    if name in ("edges", "score", "bin", "score and strength"):
        np.testing.assert_array_equal(layer[..., 3] > 0, detection.edges)
    else:
        assert (layer[..., 3] == 255).all()
        assert len(np.unique(layer[..., :3].reshape(-1, 3), axis=0)) > 5


def test_a_stage_of_a_large_photo_is_reduced_without_losing_single_pixels(monkeypatch):
    monkeypatch.setattr(images, "EXACT", 100)
    monkeypatch.setattr(images, "VIEW", 35)
    detection = DETECTOR.detect(hills(1))
    layer = overlay(detection, "edges")
    assert layer.shape == (24, 35, 4)
    whole = cv2.resize(detection.edges.astype(np.uint8), (35, 24), interpolation=cv2.INTER_AREA)
    assert (layer[..., 3][whole > 0] > 0).all()


PHOTO = render("clear", 1, 180, 120).photo
METHODS = {"ours": sv.Detector(), "edges": EdgesOnly(), "gradient": GradientCost()}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("blank", [False, True])
def test_every_overlay_is_a_picture_of_the_photos_size(method, blank):
    found = METHODS[method].detect(np.full((120, 180, 3), 128, np.uint8) if blank else PHOTO)
    names = overlays(found)
    assert len(names) == len(set(names))
    for name in names:
        assert overlay(found, name).shape == (120, 180, 4)


def test_our_stages_and_terms_can_all_be_laid_over_the_photo():
    found = METHODS["ours"].detect(PHOTO)
    assert tuple(overlays(found)) == (*STAGES, "no edge", "clear sky")
    for name in STAGES:
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


@pytest.fixture
def reduced(monkeypatch):
    """Views of at most 60 pixels."""
    monkeypatch.setattr(images, "EXACT", 100)
    monkeypatch.setattr(images, "VIEW", 60)
    return METHODS["ours"].detect(PHOTO)


@pytest.mark.parametrize("method", METHODS)
def test_every_overlay_is_as_large_as_the_view(reduced, method):
    found = METHODS[method].detect(PHOTO)
    for name in overlays(found):
        assert overlay(found, name).shape[:2] == (40, 60)


@pytest.mark.parametrize("name", ["edges", "bin", "score"])
def test_where_any_edge_pixel_is_the_view_shows_one_of_them(reduced, name):
    seen = overlay(reduced, name)
    wanted = np.zeros((40, 60), np.bool_)
    wanted[reduced.edge_rows // 3, reduced.edge_columns // 3] = True
    np.testing.assert_array_equal(seen[..., 3] > 0, wanted)
    if name == "bin":
        legend = {colour for _, colour in reduced.stages["bin"].legend}
        assert {tuple(one) for one in seen[wanted][:, :3].tolist()} <= legend


@pytest.mark.parametrize("name", ["strength", "coherence", "orientation"])
def test_the_tensor_in_a_view_is_that_of_the_pixels_in_its_middle(reduced, monkeypatch, name):
    monkeypatch.setattr("annotate.work.overlays._QUALITY", 100)
    rows, columns = (one.ravel().astype(np.int32) for one in np.mgrid[1:120:3, 1:180:3])
    values = reduced.stages[name].at(rows, columns).reshape(40, 60)
    np.testing.assert_allclose(values, getattr(tensor_map(PHOTO), name)[1::3, 1::3], rtol=1e-4)
    shown = overlay(reduced, name).astype(int)
    quantity = reduced.stages[name].quantity
    low, high = quantity.low, quantity.high or np.percentile(values, 99.5)
    wanted = coloured(quantity.colour_map, (values - low) / (high - low)).astype(int)
    assert np.median(np.abs(shown - wanted)) <= 3  # a JPEG
