"""The frame of a photo: what is inside, where a line can be seen, and the photo without it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.detector import Detector
from skyline_viz.frames.frame import ACROSS, SIDES, Frame, around_frame, without_frame
from skyline_viz.rendering import render
from skyline_viz.sky_model import SkyModel
from testing.examples import examples
from testing.scenes import framed, noise

WIDTHS = st.integers(0, 9)


@examples(60)
@given(WIDTHS, WIDTHS, WIDTHS, WIDTHS, st.integers(1, 20), st.integers(1, 20))
def test_inside_is_the_picture(left, right, top, bottom, height, width):
    picture = noise(height, width)
    photo = framed(picture, left=left, right=right, top=top, bottom=bottom)
    frame = Frame(left=left, right=right, top=top, bottom=bottom)
    assert np.array_equal(photo[frame.inside(photo)], picture)
    shows = frame.shows(photo.shape[1])
    assert shows.sum() == width
    assert np.array_equal(np.flatnonzero(shows), np.arange(left, left + width))


@examples(60)
@given(WIDTHS, WIDTHS, WIDTHS, WIDTHS)
def test_the_rim_of_the_picture_is_painted_over_the_frame(left, right, top, bottom):
    picture = noise(12, 15)
    photo = framed(picture, left=left, right=right, top=top, bottom=bottom)
    before = photo.copy()
    painted = without_frame(photo, Frame(left=left, right=right, top=top, bottom=bottom))
    expected = np.pad(picture, ((top, bottom), (left, right), (0, 0)), mode="edge")
    assert np.array_equal(painted, expected)
    assert painted.dtype == np.uint8
    assert np.array_equal(photo, before)


def test_a_photo_without_a_frame_is_itself():
    photo = noise(9, 9)
    assert without_frame(photo, Frame()) is photo
    assert Frame().inside(photo) == (slice(0, 9), slice(0, 9))
    assert Frame().shows(9).all()


@pytest.mark.parametrize("side", SIDES)
def test_one_side_is_widened(side):
    frame = Frame(left=1, right=2, top=3, bottom=4)
    wider = frame.widened(side, 10)
    assert {name: getattr(wider, name) - getattr(frame, name) for name in SIDES} == {
        name: 10 * (name == side) for name in SIDES
    }
    assert ACROSS[ACROSS[side]] == side != ACROSS[side]


@examples(60)
@given(WIDTHS, WIDTHS, WIDTHS, WIDTHS)
def test_a_map_of_the_picture_goes_on_around_it(left, right, top, bottom):
    inside = noise(12, 15)[..., 0].astype(np.float32)  # a region is a pixel
    frame = Frame(left=left, right=right, top=top, bottom=bottom)
    found = around_frame(inside, frame, 12 + top + bottom, 15 + left + right)
    expected = np.pad(inside, ((top, bottom), (left, right)), mode="edge")
    np.testing.assert_allclose(found, expected, atol=1e-2)


def test_a_map_in_a_huge_frame_stays_small():
    found = around_frame(np.ones((8, 6), np.float32), Frame(top=900, left=700), 940, 730)
    assert found.shape == (32, 24)
    assert (found == 1).all()


@pytest.mark.parametrize("bars", [{"top": 40, "bottom": 31}, {"left": 30, "right": 30}])
def test_a_sky_model_sees_the_picture_alone(monkeypatch, bars):
    seen = []

    def sky(_, photo):
        seen.append(photo)
        return np.linspace([1.0], [0.0], 12).repeat(15, axis=1).astype(np.float32)

    monkeypatch.setattr(SkyModel, "sky", sky)
    picture = render("clear", 3, 240, 160).photo
    found = Detector().detect(framed(picture, **bars))
    assert np.array_equal(seen[0], picture)
    assert found.frame == Frame(**bars)
    assert found.sky[0].min() == 1
    assert found.sky[-1].max() == 0
