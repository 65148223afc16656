"""What lies under transparent pixels."""

import numpy as np
import pytest
from PIL import Image

from skyline_viz.photo import read_photo
from skyline_viz.picture_files.transparency import without_transparency
from testing.pictures import NOISE, save


@pytest.mark.parametrize("kind", ["png", "tif", "webp"])
def test_alpha_is_dropped(tmp_path, kind):
    alpha = np.full((*NOISE.shape[:2], 1), 128, np.uint8)
    path = save(tmp_path / f"a.{kind}", np.concatenate([NOISE, alpha], axis=2), exact=True)
    assert np.array_equal(read_photo(path), NOISE)


def test_grey_with_alpha(tmp_path):
    path = save(
        tmp_path / "a.png", np.ascontiguousarray(NOISE[:, :, :2] | [[[0, 64]]]).astype("u1")
    )
    assert np.array_equal(read_photo(path), NOISE[:, :, :1].repeat(3, axis=2))


@pytest.mark.parametrize("transparency", [None, bytes(range(100, 116))])
def test_palette_becomes_rgb(tmp_path, transparency):
    image = Image.fromarray(NOISE).quantize(16)
    options = {} if transparency is None else {"transparency": transparency}
    image.save(tmp_path / "a.png", **options)
    expected = np.array(Image.fromarray(NOISE).quantize(16).convert("RGB"))
    assert np.array_equal(read_photo(tmp_path / "a.png"), expected)


def test_a_hole_takes_the_colours_around_it():
    photo = np.full((20, 30, 3), 90, np.uint8)
    alpha = np.full((20, 30), 255, np.uint8)
    alpha[8:12, 10:20] = 0
    photo[8:12, 10:20] = 3
    filled, note = without_transparency(photo, alpha)
    assert (filled == 90).all()
    assert note


def test_what_is_cut_off_becomes_white_and_half_transparent_pixels_stay():
    photo = np.full((20, 30, 3), 90, np.uint8)
    alpha = np.full((20, 30), 120, np.uint8)
    alpha[:5] = 0
    filled, _ = without_transparency(photo, alpha)
    assert (filled[:5] == 255).all()
    assert (filled[5:] == 90).all()
    everything, note = without_transparency(photo.copy(), np.zeros((20, 30), np.uint8))
    assert np.array_equal(everything, photo)
    assert "all over" in note
