"""The line of a neighbour: carried over where photos overlap, and nowhere else."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.engine.carried import carried_over, motion_between
from annotate.engine.live_wire import LiveWire
from skyline_viz import Skyline, a_err, render
from skyline_viz.detector import Detector
from testing.examples import examples

HEIGHT, WIDTH = 240, 400


@pytest.fixture(scope="module")
def wide():
    """A scene that is wider and higher than what is cut out of it."""
    scene = render("clear", 3, 640, 480)
    return scene.photo, scene.truth


def cut(wide, column, row):
    """A photo of a part of a scene, and its line."""
    photo, truth = wide
    part = photo[row : row + HEIGHT, column : column + WIDTH].copy()
    rows = truth.rows[column : column + WIDTH] - row
    return part, Skyline(rows=rows)


def line_of(stroke):
    """Columns and rows of a stroke."""
    columns, rows = np.array(stroke.points).T
    at = np.arange(columns[0], columns[-1] + 1)
    return at, np.interp(at, columns, rows)


@examples(12)
@given(st.integers(-110, 110), st.integers(-28, 28))
def test_a_shifted_photo_carries_the_shifted_line(wide, across, down):
    before, line = cut(wide, 120, 30)
    photo, truth = cut(wide, 120 + across, 30 + down)
    stroke = carried_over(before, line, photo)
    assert stroke is not None
    columns, rows = line_of(stroke)
    assert len(columns) >= WIDTH - abs(across) - 8
    assert np.abs(rows - truth.rows[columns]).max() <= 4


@examples(8)
@given(st.floats(-12, 12))
def test_a_turned_camera_carries_the_turned_line(wide, angle):
    before, line = cut(wide, 120, 30)
    turn = cv2.getRotationMatrix2D((WIDTH / 2, HEIGHT / 2), angle, 1)
    photo = cv2.warpAffine(before, turn, (WIDTH, HEIGHT), borderMode=cv2.BORDER_REPLICATE)
    stroke = carried_over(before, line, photo)
    assert stroke is not None
    points = np.column_stack([np.arange(WIDTH), line.rows, np.ones(WIDTH)]) @ turn.T
    for column, row in stroke.points:
        away = np.hypot(*(points - (column, row)).T)
        assert away.min() <= 4


def test_the_line_snaps_in_the_new_photo(wide):
    before, line = cut(wide, 120, 30)
    photo, truth = cut(wide, 150, 20)
    stroke = carried_over(before, line, photo)
    wire = LiveWire(photo, Detector())
    wire.guide(stroke.points, stroke.radius)
    assert a_err(wire.skyline, truth) < 2


@pytest.mark.parametrize("other", ["clear", "snow", "hazy"])
def test_another_place_carries_nothing(wide, other):
    before, line = cut(wide, 120, 30)
    photo = render(other, 77, WIDTH, HEIGHT).photo
    assert carried_over(before, line, photo) is None


def test_what_has_no_detail_or_another_size_carries_nothing(wide):
    before, line = cut(wide, 120, 30)
    flat = np.full_like(before, 128)
    assert carried_over(flat, line, flat) is None
    assert motion_between(before, line, flat) == (None, 0)
    assert carried_over(before, line, before[:-1]) is None


def test_what_is_hidden_is_not_carried(wide):
    before, line = cut(wide, 120, 30)
    seen = np.arange(WIDTH) >= 150
    line = Skyline(rows=line.rows, visible=seen)
    stroke = carried_over(before, line, before)
    columns, _ = line_of(stroke)
    assert 148 <= columns[0] <= 152
    assert columns[-1] == WIDTH - 1
    hidden = Skyline(rows=line.rows, visible=np.zeros(WIDTH, np.bool_))
    assert carried_over(before, hidden, before) is None


def test_a_photo_turned_upside_down_carries_nothing(wide):
    before, line = cut(wide, 120, 30)
    assert carried_over(before, line, np.ascontiguousarray(before[::-1, ::-1])) is None
