"""A single unmistakable edge is the skyline, whatever its colours: nothing outbids it."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from skyline_viz import Detector, a_err
from skyline_viz.skyline import Skyline
from testing.examples import examples
from testing.scenes import compressed, framed, two_tones, written

HEIGHT, WIDTH = 160, 240
STEADY = examples(60)
COLOURS = st.tuples(*[st.integers(0, 255)] * 3)
TONES = {
    "bright sky": ((200, 220, 250), (60, 58, 50)),
    "snow under a blue sky": ((38, 80, 160), (250, 250, 252)),
    "sunset": ((200, 70, 30), (30, 15, 10)),
    "black ground": ((90, 110, 150), (0, 0, 0)),
    "white sky": ((255, 255, 255), (120, 130, 110)),
    "night": ((25, 30, 60), (110, 110, 120)),
    "one bit": ((255, 255, 255), (0, 0, 0)),
    "one bit, inverted": ((0, 0, 0), (255, 255, 255)),
}
OTHER_EDGES = ("bright sky", "sunset", "black ground", "white sky", "one bit")
"""Tones of which it is plain, where there are other edges too, which one is sky."""

EVERY_TONE = pytest.mark.parametrize(("sky", "ground"), TONES.values(), ids=TONES)
BRIGHT_SKY = pytest.mark.parametrize(
    ("sky", "ground"), [TONES[name] for name in OTHER_EDGES], ids=OTHER_EDGES
)


def curve(middle=80.0, tilt=0.0, wave=20.0, period=25.0, width=WIDTH):
    """Rows ``(W,)`` of a tilted sine; `tilt` is its rise from the first column to the last."""
    columns = np.arange(width)
    line = middle + tilt * (columns / (width - 1) - 0.5) + wave * np.sin(columns / period)
    return np.round(line).clip(8, HEIGHT - 8)


def error(photo, rows, **frame):
    """Mean distance of the detected line from the true one, where a line is visible."""
    found = Detector().detect(photo).skyline
    shown = np.zeros(len(found.rows), bool)
    shown[frame.get("left", 0) : len(shown) - frame.get("right", 0)] = True
    assert np.array_equal(found.visible, shown)
    whole = np.pad(rows, (frame.get("left", 0), frame.get("right", 0)), mode="edge")
    return a_err(found, Skyline(whole + frame.get("top", 0), shown))


@STEADY
@given(
    sky=COLOURS,
    ground=COLOURS,
    middle=st.floats(30, 130),
    tilt=st.floats(-100, 100),
    wave=st.floats(0, 25),
    period=st.floats(20, 80),
)
def test_two_tones_of_any_colours(sky, ground, middle, tilt, wave, period):
    assume(np.abs(np.subtract(sky, ground)).max() >= 50)
    rows = curve(middle, tilt, wave, period)
    assert error(two_tones(rows, HEIGHT, sky, ground), rows) < 1


@EVERY_TONE
@pytest.mark.parametrize("middle", [20, 50, 80, 110, 140])
@pytest.mark.parametrize("tilt", [-60, 0, 60])
def test_the_line_is_anywhere(sky, ground, middle, tilt):
    rows = curve(middle, tilt, 8)
    assert error(two_tones(rows, HEIGHT, sky, ground), rows) < 1


@EVERY_TONE
@pytest.mark.parametrize("row", [10, 40, 80, 120, 150])
def test_the_line_is_straight_and_level(sky, ground, row):
    rows = np.full(WIDTH, row)
    assert error(two_tones(rows, HEIGHT, sky, ground), rows) < 1


@EVERY_TONE
@pytest.mark.parametrize(
    "frame",
    [
        {"top": 12, "bottom": 12},
        {"top": 70, "bottom": 70},
        {"left": 8, "right": 8},
        {"left": 90, "right": 150},
        {"left": 20, "right": 20, "top": 20, "bottom": 20},
    ],
    ids=str,
)
def test_with_bars(sky, ground, frame):
    rows = curve()
    seen = 0
    for colour in ((0, 0, 0), (255, 255, 255), (128, 128, 128)):
        if all(np.abs(np.subtract(colour, tone)).max() >= 50 for tone in (sky, ground)):
            photo = framed(two_tones(rows, HEIGHT, sky, ground), colour, **frame)
            assert error(photo, rows, **frame) < 1, colour
            seen += 1
    assert seen  # bars of the colour of the sky or the ground have no end


@BRIGHT_SKY
def test_with_a_date_stamp(sky, ground):
    rows = curve()
    photo = written(two_tones(rows, HEIGHT, sky, ground), (130, 150))
    assert error(photo, rows) < 1
    photo[136:154, 4:70] = 255
    photo[140:150, 8:66] = 0
    assert error(photo, rows) < 1


@BRIGHT_SKY
def test_with_leaves_that_hang_from_above(sky, ground):
    rows = curve()
    photo = two_tones(rows, HEIGHT, sky, ground)
    leaves = np.random.default_rng(4).random((22, 80)) < 0.5
    photo[:22, -80:][leaves] = (20, 40, 15)
    assert error(photo, rows) < 1


@EVERY_TONE
def test_compressed(sky, ground):
    rows = curve()
    assert error(compressed(two_tones(rows, HEIGHT, sky, ground), 90), rows) < 1
