"""Pictures for the page: views, tiles, strips and stages."""

import cv2
import numpy as np
import pytest

import skyline_viz as sv
from annotate.work import images
from annotate.work.images import BAND, TILE, stage, strip, thumbnail, tile, view, view_size
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline
from skyline_viz.stage import OURS
from testing.labelling import DETECTOR, hills

STAGES = tuple(one.name for one in OURS)


def opened(data):
    picture = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    return picture[..., [2, 1, 0, *range(3, picture.shape[2])]]


def test_a_small_photo_is_seen_exactly_and_a_large_one_reduced(monkeypatch):
    photo = hills(1)
    data, kind = view(photo)
    assert kind == "image/png"
    np.testing.assert_array_equal(opened(data), photo)
    monkeypatch.setattr(images, "EXACT", 100)
    monkeypatch.setattr(images, "VIEW", 35)
    data, kind = view(photo)
    assert kind == "image/jpeg"
    assert opened(data).shape == (24, 35, 3)


def test_a_view_keeps_its_shape_and_a_pixel():
    assert view_size(1, 10**7) == (1, 2048)
    assert view_size(900, 2200) == (900, 2200)  # few pixels, although it is wide
    height, width = view_size(3000, 9000)
    assert (height, width) == (683, 2048)


@pytest.mark.parametrize(("height", "width"), [(480, 640), (1000, 200), (3, 5)])
def test_thumbnails_fit(height, width):
    picture = opened(thumbnail(np.zeros((height, width, 3), np.uint8)))
    assert picture.shape[0] <= 160
    assert picture.shape[1] <= 240
    assert picture.shape[0] <= height


def test_tiles_are_the_photo(monkeypatch):
    monkeypatch.setattr(images, "TILE", 32)
    photo = hills(1)
    rows = [np.hstack([opened(tile(photo, x, y)) for x in range(3)]) for y in range(2)]
    np.testing.assert_array_equal(np.vstack(rows), photo)
    assert tile(photo, 3, 0) is None
    assert tile(photo, 0, 2) is None
    assert TILE == 512


def test_in_a_strip_the_line_is_level():
    rows = 20 + 10 * np.sin(np.arange(70) / 9)
    line = Skyline(rows)
    photo = np.where(line.to_mask(48)[..., None], np.uint8(220), np.uint8(30)).repeat(3, axis=2)
    picture = opened(strip(photo, line, 70))
    assert picture.shape == (2 * BAND + 1, 70, 3)
    assert (picture[BAND - 5 : BAND] == 220).all()
    assert (picture[BAND : BAND + 5] == 30).all()
    assert (picture[0] == 0).all()  # beyond the photo
    assert opened(strip(photo, line, 35)).shape[1] == 35


@pytest.mark.parametrize("name", STAGES)
def test_a_stage_is_seen_where_it_has_values(name):
    detection = DETECTOR.detect(hills(1))
    layer = opened(stage(detection, name))
    assert layer.shape == (*detection.edges.shape, 4)
    if name in ("edges", "score", "bin"):
        np.testing.assert_array_equal(layer[..., 3] > 0, detection.edges)
    else:
        assert (layer[..., 3] == 255).all()
        assert len(np.unique(layer[..., :3].reshape(-1, 3), axis=0)) > 5


def test_a_stage_of_a_large_photo_is_reduced_without_losing_single_pixels(monkeypatch):
    monkeypatch.setattr(images, "EXACT", 100)
    monkeypatch.setattr(images, "VIEW", 35)
    detection = DETECTOR.detect(hills(1))
    layer = opened(stage(detection, "edges"))
    assert layer.shape == (24, 35, 4)
    whole = cv2.resize(detection.edges.astype(np.uint8), (35, 24), interpolation=cv2.INTER_AREA)
    assert (layer[..., 3][whole > 0] > 0).all()


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
    assert images.overlays(found) == (*STAGES, "no edge", "clear sky")
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
