"""Edges: what colour sees and grey does not, where a sharp skyline lies, fitted thresholds."""

from dataclasses import replace

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from skyline_viz.config import DetectorConfig
from skyline_viz.edges import (
    candidate_edges,
    edge_pixels,
    fitted_thresholds,
    frame_of,
    to_grey,
)
from skyline_viz.frames.frame import Frame
from testing.examples import examples
from testing.scenes import framed, noise

STEADY = examples(60)
SOURCES = pytest.mark.parametrize("source", ["grey", "colour"])


def edges_of(photo, source="colour", **chosen):
    """Edge map with fixed thresholds and without a frame, unless chosen otherwise."""
    config = {"edge_source": source, "fit_thresholds": False, "frame": 0} | chosen
    return candidate_edges(photo, DetectorConfig(**config))[0]


def thresholds_of(photo, source="colour", **chosen):
    config = DetectorConfig(edge_source=source, fit_thresholds=True, **chosen)
    return candidate_edges(photo, config)[1]


def step(row=25, sky=(200, 210, 230), terrain=(60, 70, 50)):
    photo = np.empty((40, 60, 3), np.uint8)
    photo[:row] = sky
    photo[row:] = terrain
    return photo


def texture(seed=0):
    """Blocks of random colours under a plain sky: crisp, and full of strong edges."""
    blocks = np.random.default_rng(seed).integers(0, 256, (20, 30, 3), dtype=np.uint8)
    blocks[:8] = (150, 180, 230)
    return cv2.resize(blocks, (240, 160), interpolation=cv2.INTER_NEAREST)


def grainy(photo, deviation, seed=0):
    noise = np.random.default_rng(seed).normal(0, deviation, photo.shape)
    return np.clip(photo + noise, 0, 255).astype(np.uint8)


# Where edges are


@SOURCES
@pytest.mark.parametrize("row", [4, 20, 25, 35])
def test_a_sharp_skyline_lies_on_the_first_row_of_terrain(source, row):
    edges = edges_of(step(row), source)
    assert edges.shape == (40, 60)
    assert edges.dtype == np.bool_
    assert np.array_equal(np.flatnonzero(edges.any(axis=1)), [row])
    assert edges[row].all()


@SOURCES
def test_bright_terrain_under_a_dark_sky_too(source):
    edges = edges_of(step(18, (20, 30, 60), (240, 240, 250)), source)
    assert np.flatnonzero(edges.any(axis=1)).tolist() == [18]


def test_colour_finds_what_grey_misses():
    photo = step(20, (40, 110, 230), (150, 100, 18))
    grey = to_grey(photo)
    assert abs(int(grey[0, 0]) - int(grey[-1, 0])) < 5
    assert not edges_of(photo, "grey").any()
    assert edges_of(photo, "colour")[20].all()


@pytest.mark.parametrize("channel", [0, 1, 2])
def test_every_channel_counts(channel):
    photo = np.full((40, 60, 3), 100, np.uint8)
    photo[15:, :, channel] = 180
    assert edges_of(photo)[15].all()


@pytest.mark.parametrize(("low", "high"), [(50, 220), (20, 80)])
@pytest.mark.parametrize("seed", range(3))
def test_edges_are_those_of_canny_upside_down(seed, low, high):
    photo = cv2.GaussianBlur(noise(40, 60, seed), (0, 0), 0.8)
    chosen = {"low_threshold": low, "high_threshold": high}
    for source, seen in (("grey", to_grey(photo)), ("colour", photo)):
        expected = cv2.Canny(np.ascontiguousarray(seen[::-1]), low, high)[::-1] > 0
        assert expected.any()
        assert np.array_equal(edges_of(photo, source, **chosen), expected)


@SOURCES
def test_weak_edges_need_strong_neighbours(source):
    photo = step(25, (120, 120, 120), (100, 100, 100))  # a Sobel gradient of 80
    assert not edges_of(photo, source).any()
    assert edges_of(photo, source, high_threshold=79)[25].all()
    assert not edges_of(photo, source, low_threshold=81, high_threshold=81).any()
    photo[25:, :20] = 20  # 400 here: a start from which the weak edge is followed
    assert edges_of(photo, source)[25].all()


def test_fitted_edges_are_those_of_the_fitted_thresholds():
    photo = cv2.GaussianBlur(texture(), (0, 0), 6)
    low, high = thresholds_of(photo)
    fitted = edges_of(photo, fit_thresholds=True)
    assert np.array_equal(fitted, edges_of(photo, low_threshold=low, high_threshold=high))
    assert fitted.sum() > edges_of(photo).sum()


FRAMES = [{"top": 12, "bottom": 12}, {"left": 30, "right": 7}, {"left": 2, "right": 2, "top": 2}]


@SOURCES
@pytest.mark.parametrize("frame", FRAMES, ids=str)
def test_edges_are_those_of_the_picture_in_its_frame(source, frame):
    picture = noise(40, 60, seed=2)
    photo = framed(picture, **frame)
    inside = Frame(**frame).inside(photo)
    for chosen in ({}, {"fit_thresholds": True}):
        edges = edges_of(photo, source, frame=4, **chosen)
        assert np.array_equal(edges[inside], edges_of(picture, source, **chosen))
        assert edges.sum() == edges[inside].sum() > 0


def test_without_frames_their_edges_stay():
    photo = framed(noise(40, 60, seed=2), top=12, bottom=12)
    assert edges_of(photo)[12].mean() > 0.5
    assert frame_of(photo, DetectorConfig()) == Frame(top=12, bottom=12)
    assert frame_of(photo, DetectorConfig.paper()) == Frame()


def test_a_frame_that_is_known_is_not_looked_for():
    photo = noise(40, 60, seed=2)
    edges, _ = candidate_edges(photo, DetectorConfig(), Frame(left=9))
    assert not edges[:, :9].any()
    assert edges[:, 9:].any()


def test_a_skyline_that_touches_the_rim_is_kept():
    photo = np.full((60, 80, 3), 220, np.uint8)
    photo[np.arange(60)[:, None] >= np.abs(np.arange(80) - 40)[None, :] * 0.5 + 1] = 60
    assert edges_of(photo, frame=4)[:4].any()


@SOURCES
@pytest.mark.parametrize("value", [0, 128, 255])
def test_flat_photos_have_no_edge(source, value):
    photo = np.full((20, 30, 3), value, np.uint8)
    assert not edges_of(photo, source).any()
    assert not edges_of(photo, source, fit_thresholds=True).any()


@SOURCES
def test_the_photo_is_left_alone(source):
    photo = texture()
    before = photo.copy()
    photo.setflags(write=False)
    edges_of(photo, source, fit_thresholds=True)
    assert np.array_equal(photo, before)


# Fitted thresholds


def test_a_crisp_photo_keeps_its_thresholds():
    assert thresholds_of(texture()) == (50, 220)


def test_a_blurred_photo_gets_lower_ones():
    found = [thresholds_of(cv2.GaussianBlur(texture(), (0, 0), blur))[1] for blur in (2, 3, 4)]
    assert 220 >= found[0] > found[1] > found[2] > 0.3 * 220


def test_thresholds_go_down_to_three_tenths_at_most():
    assert thresholds_of(np.full((20, 30, 3), 90, np.uint8)) == pytest.approx((15, 66))
    assert thresholds_of(step()) == pytest.approx((15, 66))


def test_grain_holds_the_thresholds_up():
    soft = cv2.GaussianBlur(texture(), (0, 0), 8)
    found = [thresholds_of(grainy(soft, grain))[1] for grain in (0, 3, 6, 20)]
    assert found[0] < found[1] < found[2] < found[3] == 220


@SOURCES
@STEADY
@given(
    height=st.integers(3, 40),
    width=st.integers(3, 40),
    seed=st.integers(0, 2**32 - 1),
    contrast=st.floats(0, 1),
    low=st.floats(1, 200),
    ratio=st.floats(1, 8),
)
def test_thresholds_keep_their_ratio_and_are_never_raised(
    source, height, width, seed, contrast, low, ratio
):
    photo = (noise(height, width, seed) * contrast).astype(np.uint8)
    high = low * ratio
    found_low, found_high = thresholds_of(photo, source, low_threshold=low, high_threshold=high)
    assert 0.3 * high * (1 - 1e-9) <= found_high <= high
    assert found_low * high == pytest.approx(found_high * low)


def test_grey_and_colour_are_fitted_to_what_they_see():
    photo = cv2.GaussianBlur(step(20, (40, 110, 230), (150, 100, 18)), (0, 0), 4)
    photo = np.tile(photo, (4, 1, 1))
    assert thresholds_of(photo, "grey")[1] < thresholds_of(photo, "colour")[1]


@pytest.mark.parametrize(("share", "factor"), [(0.08, 0.5), (0.03, 0.3)])
def test_strong_gradients_are_those_of_a_twentieth_of_the_photo(share, factor):
    strengths = np.full(10_000, 5, np.int16)
    strengths[: round(10_000 * share)] = 400
    low, high = fitted_thresholds(strengths, 100.0, 480.0)
    assert (low, high) == (pytest.approx(100 * factor), pytest.approx(480 * factor))


def test_thresholds_are_plain_numbers():
    assert [type(value) for value in thresholds_of(texture())] == [float, float]
    fixed = candidate_edges(texture(), DetectorConfig(fit_thresholds=False))[1]
    assert fixed == (50, 220)


@pytest.mark.parametrize("shape", [(2, 2), (2, 50), (50, 2), (3, 3), (1000, 2)])
def test_narrow_photos(shape):
    photo = noise(*shape, seed=1)
    low, high = thresholds_of(photo)
    assert 15 <= low <= 50
    assert 66 <= high <= 220
    assert edges_of(photo, fit_thresholds=True).shape == shape


@pytest.mark.parametrize("fit", [False, True])
def test_thresholds_of_zero(fit):
    edges = edges_of(texture(), low_threshold=0, high_threshold=0, fit_thresholds=fit)
    assert edges.any()


# Edge pixels


@STEADY
@given(st.integers(1, 9), st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_edge_pixels_run_row_by_row(height, width, seed):
    edges = np.random.default_rng(seed).random((height, width)) < 0.4
    rows, columns = edge_pixels(edges)
    assert rows.dtype == columns.dtype == np.int32
    expected = [(r, c) for r in range(height) for c in range(width) if edges[r, c]]
    assert list(zip(rows.tolist(), columns.tolist(), strict=True)) == expected


def test_edge_pixels_of_a_view():
    edges = np.zeros((5, 6), bool)
    edges[[1, 3], [4, 0]] = True
    rows, columns = edge_pixels(edges[::-1, ::-1])
    assert (rows.tolist(), columns.tolist()) == ([1, 3], [5, 1])


def test_grey_has_the_usual_weights():
    photo = np.zeros((1, 4, 3), np.uint8)
    photo[0, :3] = np.eye(3) * 255
    photo[0, 3] = 255
    assert to_grey(photo).tolist() == [[76, 150, 29, 255]]


# Where the sky model has a sure boundary

FAINT = {"sky": (150, 155, 160), "terrain": (144, 149, 154)}


def sky_above(row, height=40, columns=6, sure=1.0):
    """A map that has its boundary at a row."""
    above = np.arange(height)[:, None] < row
    return np.where(above, sure, 1 - sure).astype(np.float32).repeat(columns, axis=1)


def test_a_faint_ridge_has_edges_where_the_sky_model_sees_it():
    photo, config = step(25, **FAINT), DetectorConfig(fit_thresholds=False)
    assert not candidate_edges(photo, config)[0].any()
    found, thresholds = candidate_edges(photo, replace(config, sky_edges=0.1), sky=sky_above(25))
    assert found[25].all()
    assert thresholds == (50, 220)


@pytest.mark.parametrize(
    "sky",
    [sky_above(10), sky_above(25, sure=0.9), sky_above(0), sky_above(40)],
    ids=["elsewhere", "unsure", "no sky", "no terrain"],
)
def test_and_none_without_a_sure_boundary_there(sky):
    config = DetectorConfig(fit_thresholds=False, sky_edges=0.1)
    assert not candidate_edges(step(25, **FAINT), config, sky=sky)[0].any()


def test_edges_that_are_there_are_enough():
    photo, sky = grainy(step(25), 2), sky_above(25)
    sharp, lower = (candidate_edges(photo, DetectorConfig(sky_edges=share))[0] for share in (1, 0))
    assert sharp[24:27].any(axis=0).all()
    assert np.array_equal(candidate_edges(photo, DetectorConfig(sky_edges=0), sky=sky)[0], sharp)
    assert np.array_equal(lower, sharp)  # without a map the setting means nothing


def test_a_gap_of_a_few_columns_is_no_reason_to_seek():
    photo = step(25).repeat(5, axis=1)
    photo[:, 100:104] = photo[0, 0]  # the terrain is missing, but for a trace
    photo[25:, 100:104] -= 6
    config = DetectorConfig(fit_thresholds=False, sky_edges=0.1)
    plain = candidate_edges(photo, config)[0]
    assert np.array_equal(candidate_edges(photo, config, sky=sky_above(25))[0], plain)


@given(hnp.arrays(np.uint8, (30, 64, 3)), st.integers(0, 30), st.integers(0, 3), st.integers(0, 3))
@STEADY
def test_sought_edges_are_only_added_near_the_boundary(photo, row, top, left):
    config, sky = DetectorConfig(sky_edges=0.1), sky_above(row, 30)
    frame = Frame(top=top, left=left)
    plain, thresholds = candidate_edges(photo, config, frame)
    sought, same = candidate_edges(photo, config, frame, sky)
    assert same == thresholds
    assert (sought | ~plain).all()
    added = np.flatnonzero((sought & ~plain).any(axis=1))
    assert (np.abs(added - row) <= 1).all()
    assert not sought[:top].any()
    assert not sought[:, :left].any()


def test_sought_edges_are_those_of_lower_thresholds_in_the_whole_photo():
    photo = grainy(step(25, **FAINT).repeat(2, axis=1), 2)
    lower = DetectorConfig(fit_thresholds=False, low_threshold=0.0, high_threshold=0.0)
    seeking = replace(DetectorConfig(fit_thresholds=False), sky_edges=0.0)
    every = candidate_edges(photo, lower)[0]
    sought = candidate_edges(photo, seeking, sky=sky_above(25))[0]
    assert sought.any()
    assert np.array_equal(sought[24:27], every[24:27])


@pytest.mark.parametrize(("rows", "sought"), [(40, False), (100, True), (400, True)])
def test_near_is_the_height_of_a_region_of_the_map(rows, sought):
    photo = np.full((200, 60, 3), 150, np.uint8)
    photo[100:] -= 8  # the faint ridge, and a stronger edge 4 rows below it
    photo[104:] = 20
    config = DetectorConfig(fit_thresholds=False, sky_edges=0.1)
    edges = candidate_edges(photo, config, sky=sky_above(rows // 2, rows))[0]
    assert edges[104].all()
    assert edges[100].all() == sought
