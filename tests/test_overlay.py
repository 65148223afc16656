"""Overlays and contact sheets, looked at pixel by pixel."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.overlay import (
    GREY,
    HALO,
    PATH,
    TILE_HEIGHT,
    TILE_WIDTH,
    TRUTH,
    Tile,
    contact_sheet,
    draw_overlay,
    line_width,
    make_tile,
    shrunk,
)
from skyline_viz.skyline import Skyline, SkylineError

HEIGHT, WIDTH = 60, 80
PHOTO = np.full((HEIGHT, WIDTH, 3), (150, 150, 150), np.uint8)


def level(row, width=WIDTH, visible=None):
    return Skyline(np.full(width, row), visible)


def test_colours_are_those_of_the_whole_project():
    assert bytes(PATH).hex() == "ff2d95"
    assert bytes(TRUTH).hex() == "00d1b2"


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


def test_small_photos_are_not_enlarged():
    photo, lines = shrunk(PHOTO, level(30), None, width=100, height=100)
    assert photo is PHOTO
    assert lines == [level(30), None]


@given(st.integers(2, 200), st.integers(2, 200), st.integers(2, 90), st.integers(2, 90))
def test_shrinking_fits_and_takes_lines_along(height, width, most_width, most_height):
    photo = np.zeros((height, width, 3), np.uint8)
    visible = np.arange(width) >= width // 2
    line = Skyline(np.full(width, height / 2), visible)
    small, (moved,) = shrunk(photo, line, width=most_width, height=most_height)
    assert small.shape[1] <= most_width
    assert small.shape[0] <= most_height
    assert moved.width == small.shape[1]
    np.testing.assert_allclose(moved.rows, small.shape[0] / 2, rtol=1e-5)
    assert abs(moved.visible.mean() - visible.mean()) <= 1 / min(moved.width, width)


def test_an_edge_stays_under_its_line_when_shrunk():
    photo = np.full((200, 200, 3), 200, np.uint8)
    rows = np.linspace(60, 140, 200).round()
    photo[~Skyline(rows).to_mask(200)] = 0
    small, (line,) = shrunk(photo, Skyline(rows), width=50)
    cut = np.argmax(small[:, :, 0] < 100, axis=0)
    assert np.abs(cut - line.rows).max() <= 1


def test_tiles_are_small_and_lines_on_them_legible():
    photo = np.full((3000, 4000, 3), 150, np.uint8)
    tile = make_tile("a", photo, level(1500, 4000))
    assert tile.picture.shape == (TILE_HEIGHT, TILE_WIDTH, 3)
    assert tuple(tile.picture[TILE_HEIGHT // 2, 100]) == PATH


def test_a_contact_sheet_holds_every_tile():
    tones = (10, 90, 170, 250, 30)
    tiles = [
        Tile(f"photo {tone}", np.full((40 + tone // 10, 100, 3), tone, np.uint8)) for tone in tones
    ]
    sheet = contact_sheet(tiles, columns=2)
    assert sheet.dtype == np.uint8
    assert tuple(sheet[0, 0]) == GREY
    for tile in tiles:
        tone = tile.picture[0, 0]
        assert (sheet == tone).all(axis=2).sum() >= tile.picture[..., 0].size
    assert 2 * 100 < sheet.shape[1] < 3 * 100


def test_labels_are_written_and_cut():
    picture = np.zeros((20, 100, 3), np.uint8)
    sheets = [contact_sheet([Tile(label, picture)]) for label in ("", "Zugspitze", "M" * 500)]
    assert (sheets[0] != sheets[1]).any()
    assert sheets[0].shape == sheets[1].shape == sheets[2].shape
    assert (sheets[2][:, -8:] == GREY).all()


@pytest.mark.parametrize(("tiles", "columns"), [([], 2), ([Tile("a", PHOTO)], 0)])
def test_an_empty_sheet_is_refused(tiles, columns):
    with pytest.raises(ValueError, match="at least one tile and one column"):
        contact_sheet(tiles, columns)
