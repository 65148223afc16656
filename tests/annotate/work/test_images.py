"""Pictures for the page: views, thumbnails, tiles and strips."""

import cv2
import numpy as np
import pytest

from annotate.work import images
from annotate.work.images import (
    BAND,
    TILE,
    has_tile,
    overview,
    strip,
    thumbnail,
    thumbnail_of_file,
    tile,
    view,
    view_size,
)
from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline
from testing.labelling import hills


def opened(picture):
    picture = cv2.imdecode(np.frombuffer(picture.data, np.uint8), cv2.IMREAD_UNCHANGED)
    return picture[..., [2, 1, 0, *range(3, picture.shape[2])]]


def test_a_small_photo_is_seen_exactly_and_a_large_one_reduced(monkeypatch):
    photo = hills(1)
    shown = view(photo)
    assert shown.kind == "image/png"
    np.testing.assert_array_equal(opened(shown), photo)
    monkeypatch.setattr(images, "EXACT", 100)
    monkeypatch.setattr(images, "VIEW", 35)
    shown = view(photo)
    assert shown.kind == "image/jpeg"
    assert opened(shown).shape == (24, 35, 3)


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
    assert has_tile(photo, 2, 1)
    assert not has_tile(photo, 3, 0)
    assert not has_tile(photo, 0, 2)
    assert TILE == 512


def test_in_a_strip_the_line_is_level():
    rows = 20 + 10 * np.sin(np.arange(70) / 9)
    line = Skyline(rows)
    photo = np.where(line.to_mask(48)[..., None], np.uint8(220), np.uint8(30)).repeat(3, axis=2)
    picture = opened(strip(photo, line, 70))
    assert picture.shape == (2 * BAND + 1, 70, 4)  # transparent beside the photo
    assert (picture[BAND - 5 : BAND, :, :3] == 220).all()
    assert (picture[BAND : BAND + 5, :, :3] == 30).all()
    assert (picture[0, :, 3] == 0).all()
    assert opened(strip(photo, line, 35)).shape[1] == 35


def test_an_overview_shows_a_small_photo_with_its_line():
    photo = np.full((600, 900, 3), 200, np.uint8)
    rows = np.full(900, 300)
    picture = opened(overview(photo, Skyline(rows)))
    assert picture.shape == (160, 240, 3)
    drawn = np.abs(picture.astype(int) - 200).max(axis=2) > 40
    assert drawn[78:83].any(axis=0).all()
    assert not drawn[:70].any()
    half = opened(overview(photo, Skyline(rows=rows, visible=np.arange(900) < 450)))
    assert not (np.abs(half[:, 135:].astype(int) - 200) > 40).any()


def test_a_jpeg_is_decoded_small_and_its_thumbnail_shows_the_same(tmp_path):
    photo = hills(3, 900, 1300)
    write_photo(tmp_path / "large.jpg", photo)
    data = (tmp_path / "large.jpg").read_bytes()
    quick, slow = opened(thumbnail_of_file(data, 900, 1300)), opened(thumbnail(photo))
    assert quick.shape == slow.shape
    assert np.abs(quick.astype(int) - slow).mean() < 3
    assert thumbnail_of_file(data[:-500], 900, 1300) is None  # how much is there, others find out
