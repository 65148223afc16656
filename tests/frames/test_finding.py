"""Frames are found at any width, on any side; sky, snow and dark ground are none."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from skyline_viz.frames.finding import find_frame
from skyline_viz.frames.frame import SIDES, Frame
from skyline_viz.rendering import render
from testing.examples import examples
from testing.scenes import compressed, framed, noise, two_tones, written

STEADY = examples(60)
SIZES = st.integers(40, 90)
BARS = st.integers(1, 60)
COLOURS = st.tuples(*[st.integers(0, 255)] * 3)
SEEDS = st.integers(0, 2**16)


@pytest.fixture(scope="module")
def scenes():
    return [render(kind, 5, 320, 200).photo for kind in ("clear", "cloudy", "desert")]


def widths(frame):
    return [getattr(frame, side) for side in SIDES]


def assert_near(found, expected, pixels=3):
    assert np.abs(np.subtract(widths(found), widths(expected))).max() <= pixels, (found, expected)


# Bars


@STEADY
@given(SIZES, SIZES, COLOURS, BARS, BARS, SEEDS)
def test_pillarbox_bars_of_any_colour_and_width(height, width, colour, left, right, seed):
    photo = framed(noise(height, width, seed), colour, left=left, right=right)
    assert find_frame(photo) == Frame(left=left, right=right)


@STEADY
@given(SIZES, SIZES, COLOURS, BARS, st.floats(0.5, 2), SEEDS)
def test_letterbox_bars_of_any_colour_and_height(height, width, colour, top, ratio, seed):
    bottom = max(round(top * ratio), 1)
    photo = framed(noise(height, width, seed), colour, top=top, bottom=bottom)
    assert find_frame(photo) == Frame(top=top, bottom=bottom)


@STEADY
@given(SIZES, SIZES, COLOURS, BARS, BARS, BARS, SEEDS)
def test_frames_on_all_sides(height, width, colour, sides, top, bottom, seed):
    assume(max(top, bottom) <= 4 * sides)
    assume(sides <= 4 * min(top, bottom))
    frame = Frame(left=sides, right=sides, top=top, bottom=bottom)
    photo = framed(
        noise(height, width, seed), colour, left=sides, right=sides, top=top, bottom=bottom
    )
    assert find_frame(photo) == frame


@STEADY
@given(SIZES, SIZES, BARS, SEEDS)
def test_a_black_bar_at_the_top_alone(height, width, top, seed):
    assert find_frame(framed(noise(height, width, seed), top=top)) == Frame(top=top)


@STEADY
@given(SIZES, SIZES, COLOURS, st.integers(5, 60), SEEDS)
def test_a_bar_at_the_bottom_alone(height, width, colour, bottom, seed):
    photo = framed(noise(height, width, seed), colour, bottom=bottom)
    assert find_frame(photo) == Frame(bottom=bottom)


@STEADY
@given(SEEDS, st.integers(1, 40), st.integers(1, 40))
def test_borders_within_borders(seed, outer, inner):
    picture = framed(noise(90, 120, seed), (250, 250, 250), **dict.fromkeys(SIDES, inner))
    photo = framed(picture, (120, 20, 20), **dict.fromkeys(SIDES, outer))
    assert find_frame(photo) == Frame(*[outer + inner] * 4)


@pytest.mark.parametrize("quality", [95, 85, 70, 50])
@pytest.mark.parametrize("colour", [(0, 0, 0), (16, 16, 16), (255, 255, 255), (170, 20, 120)])
@pytest.mark.parametrize("frame", [Frame(30, 30), Frame(0, 0, 21, 21), Frame(25, 25, 17, 43)])
def test_bars_of_compressed_photos(scenes, quality, colour, frame):
    for scene in scenes:
        photo = framed(scene, colour, **dict(zip(SIDES, widths(frame), strict=True)))
        found = find_frame(compressed(photo, quality))
        if colour == (255, 255, 255):  # and of the white sky nobody can tell them
            found, expected = (one.widened("top", -one.top) for one in (found, frame))
            assert_near(found, expected, 8)
        else:
            assert_near(found, frame, 8)


@pytest.mark.parametrize("colour", [(0, 0, 0), (255, 255, 255)])
def test_bars_with_text_in_them(scenes, colour):
    ink = tuple(255 - value for value in colour)
    for scene in scenes:
        photo = framed(scene, colour, bottom=40)
        photo = written(photo, (8, 226), "SHOT ON A TELEPHONE  f/1.8", colour=ink)
        assert_near(find_frame(photo), Frame(bottom=40), 1)


def test_along_dark_ground_a_bar_is_as_wide_as_the_one_across():
    rows = np.round(55 + 5 * np.sin(np.arange(200) / 20))
    picture = two_tones(rows, 110, (150, 180, 220), (6, 6, 8))
    picture[61:, 130:] = noise(49, 70)
    photo = framed(picture, top=23, bottom=23)
    assert find_frame(photo) == Frame(top=23, bottom=23)


def test_around_a_soft_picture_too():
    picture = np.linspace(90, 160, 80)[:, None, None] * np.ones((1, 160, 3))
    photo = framed(picture.astype(np.uint8), top=20, bottom=20)
    assert find_frame(photo) == Frame(top=20, bottom=20)


# Thin borders


@pytest.mark.parametrize("width", [1, 2, 3])
@pytest.mark.parametrize("colour", [(0, 0, 0), (255, 255, 255)])
def test_thin_borders(scenes, width, colour):
    for scene in scenes:
        if colour[0] and scene[:4].mean() > 220:
            continue
        photo = framed(scene, colour, **dict.fromkeys(SIDES, width))
        assert_near(find_frame(photo), Frame(*[width] * 4), 1)
        assert_near(find_frame(compressed(photo, 85)), Frame(*[width] * 4), 2)


def test_a_border_may_hold_anything(scenes):
    for scene in scenes:
        photo = scene.copy()
        photo[0] //= 2
        assert find_frame(photo).top in (1, 2)
        assert find_frame(photo, thin=0).top == 0


# What is no frame


@STEADY
@given(
    row=st.integers(1, 118),
    tilt=st.floats(-40, 40),
    wave=st.floats(0, 20),
    sky=COLOURS,
    ground=COLOURS,
)
def test_the_only_edge_is_no_frame(row, tilt, wave, sky, ground):
    columns = np.arange(160)
    rows = np.round(row + tilt * (columns / 159 - 0.5) + wave * np.sin(columns / 25)).clip(1, 119)
    assert find_frame(two_tones(rows, 120, sky, ground)) == Frame()


@STEADY
@given(st.integers(5, 110), st.sampled_from([(255, 255, 255), (200, 220, 255)]), SEEDS)
def test_a_clear_sky_above_the_sea_is_no_bar(row, sky, seed):
    photo = noise(120, 160, seed)
    photo[:row] = sky
    assert find_frame(photo) == Frame()


@pytest.mark.parametrize("ground", [(0, 0, 0), (255, 255, 255), (9, 9, 14)])
def test_level_ground_below_a_soft_sky_is_no_bar(ground):
    shade = np.linspace(60, 190, 120)[:, None, None] * np.ones((1, 160, 3))
    photo = shade.astype(np.uint8)
    photo[90:] = ground
    assert find_frame(photo) == Frame()


def test_bands_of_flat_colours_are_no_bars():
    photo = np.full((120, 160, 3), 220, np.uint8)
    photo[20:60] = 60
    assert find_frame(photo) == Frame()
    assert find_frame(framed(photo, left=30, right=30)) == Frame(30, 30)
    photo[60:] = 20
    assert find_frame(photo) == Frame()


@pytest.mark.parametrize("kind", ["clear", "cloudy", "desert"])
@pytest.mark.parametrize("seed", range(4))
def test_rendered_scenes_have_no_frame(kind, seed):
    photo = render(kind, seed, 240, 160).photo
    assert find_frame(photo) == Frame()
    clipped = photo.copy()  # an overexposed sky
    clipped[clipped.min(axis=2) > 120] = 255
    assert find_frame(clipped) == Frame()


@STEADY
@given(st.integers(2, 30), st.integers(2, 30), SEEDS, st.floats(0, 1), st.integers(0, 10_000))
def test_some_picture_is_always_left(height, width, seed, contrast, thin):
    photo = (noise(height, width, seed) * contrast).astype(np.uint8)
    rows, columns = find_frame(photo, thin).inside(photo)
    assert photo[rows, columns].size


@STEADY
@given(COLOURS, COLOURS, st.integers(1, 59))
def test_of_two_halves_both_are_picture(left, right, column):
    photo = two_tones(np.full(40, column), 60, left, right).transpose(1, 0, 2)
    rows, columns = find_frame(photo).inside(photo)
    assert photo[rows, columns].shape[1] >= 5


@STEADY
@given(SIZES, SIZES, st.integers(0, 30), st.integers(0, 30), st.integers(0, 30), SEEDS)
def test_the_frame_is_mirrored_with_the_photo(height, width, left, right, top, seed):
    photo = framed(noise(height, width, seed), left=left, right=right, top=top)
    one, other = find_frame(photo), find_frame(photo[:, ::-1])
    assert (one.left, one.right, one.top) == (other.right, other.left, other.top)


def test_the_photo_is_left_alone(scenes):
    photo = framed(scenes[0], left=20, right=20)
    photo.setflags(write=False)
    assert find_frame(photo) == Frame(20, 20)
