"""Overlays, looked at pixel by pixel."""

import numpy as np
import pytest

from skyline_viz.colours import ALTERNATIVE, HALO, PATH, TRUTH
from skyline_viz.overlay import draw_lines, draw_overlay, line_width
from skyline_viz.skyline import Skyline, SkylineError

HEIGHT, WIDTH = 60, 80
PHOTO = np.full((HEIGHT, WIDTH, 3), (150, 150, 150), np.uint8)


def level(row, width=WIDTH, visible=None):
    return Skyline(np.full(width, row), visible)


def test_colours_are_those_of_the_whole_project():
    assert bytes(PATH).hex() == "ff2d95"
    assert bytes(TRUTH).hex() == "00d1b2"
    assert bytes(ALTERNATIVE).hex() == "ffd400"


def test_the_line_runs_between_the_last_sky_pixel_and_the_first_terrain_pixel():
    picture = draw_overlay(PHOTO, level(30))
    column = picture[:, 40].astype(int)
    assert tuple(column[29]) == tuple(column[30]) == PATH
    np.testing.assert_allclose(column[20:30], column[30:40][::-1], atol=12)


def test_lines_have_a_dark_halo():
    column = draw_overlay(PHOTO, level(30))[:, 40]
    assert np.abs(column[24:29].astype(int) - HALO).sum(axis=1).min() < 60


def test_the_photo_itself_is_left_alone():
    before = PHOTO.copy()
    draw_overlay(PHOTO, level(30), level(20))
    np.testing.assert_array_equal(PHOTO, before)


def test_invisible_columns_are_not_drawn():
    visible = np.ones(WIDTH, bool)
    visible[30:60] = False
    picture = draw_overlay(PHOTO, level(30, visible=visible))
    assert (picture[:, 36:54] == PHOTO[:, 36:54]).all()
    assert tuple(picture[30, 20]) == tuple(picture[30, 70]) == PATH


def test_a_single_visible_column_is_drawn():
    picture = draw_overlay(PHOTO, level(30, visible=np.arange(WIDTH) == 40))
    assert np.abs(picture[30, 40].astype(int) - PATH).max() < 60
    assert (picture[:, 50:] == 150).all()


def test_nothing_visible_is_nothing_drawn():
    nothing = level(30, visible=np.zeros(WIDTH, bool))
    np.testing.assert_array_equal(draw_overlay(PHOTO, nothing), PHOTO)
    np.testing.assert_array_equal(draw_overlay(PHOTO), PHOTO)


def test_truth_is_seen_where_it_differs_and_beside_the_path_where_it_agrees():
    apart = draw_overlay(PHOTO, level(40), level(20))
    assert (tuple(apart[20, 40]), tuple(apart[40, 40])) == (TRUTH, PATH)
    column = draw_overlay(PHOTO, level(30), level(30))[:, 40].astype(int)
    assert tuple(column[30]) == PATH
    greener = column[:, 1] > column[:, 0] + 40
    assert greener[25:29].any()
    assert greener[31:35].any()


def test_lines_may_leave_the_photo():
    rows = np.linspace(-20, HEIGHT + 20, WIDTH)
    picture = draw_overlay(PHOTO, Skyline(rows))
    assert picture.shape == PHOTO.shape


def test_another_width_is_refused():
    with pytest.raises(SkylineError, match="80 columns wide, the skyline 79"):
        draw_overlay(PHOTO, level(30, width=79))


def test_lines_grow_with_the_photo():
    widths = [line_width(*size) for size in ((60, 80), (519, 1388), (3024, 4032), (4284, 5712))]
    assert widths == sorted(widths)
    assert widths[0] == 2
    assert widths[-1] >= 2 * widths[1]


def test_a_line_of_one_pixel_hides_nothing_else():
    changed = (draw_overlay(PHOTO, level(30), thick=1) != PHOTO).any(axis=2)
    assert changed[:, 40].sum() <= 2  # it lies between two rows
    wide = (draw_overlay(PHOTO, level(30), thick=9) != PHOTO).any(axis=2)
    assert wide[:, 40].sum() > (draw_overlay(PHOTO, level(30)) != PHOTO).any(axis=2)[:, 40].sum()


def test_lines_that_agree_all_show_the_first_on_top():
    picture = PHOTO.copy()
    colours = (PATH, TRUTH, ALTERNATIVE)
    draw_lines(picture, [(level(30), one) for one in colours], 2)
    column = picture[:, 40].astype(int)
    rows = [np.flatnonzero(np.abs(column - one).sum(axis=1) < 12) for one in colours]
    assert {29, 30} <= set(rows[0].tolist())
    assert all(len(one) for one in rows)
    assert rows[2].max() > rows[1].max() > rows[0].max()


def test_a_part_of_a_photo_is_drawn_as_large_as_it_is_wanted():
    picture = np.full((80, 160, 3), 150, np.uint8)
    draw_lines(picture, [(level(30), PATH)], 2, scale=4.0, corner=(20, 20))
    column = picture[:, 80]
    assert tuple(column[39]) == tuple(column[40]) == PATH  # 10 rows below the corner
