"""EXIF orientation: photos and masks are turned upright as they were stored."""

import numpy as np
import pytest
from PIL import Image

from skyline_viz.photo import photo_size, read_photo
from skyline_viz.picture_files.orientation import upright, upright_image
from testing.pictures import NOISE, PHOTO, STORED, close, save


@pytest.mark.parametrize("kind", ["jpg", "png", "tif", "webp"])
@pytest.mark.parametrize("orientation", STORED)
def test_exif_orientation_is_applied(tmp_path, orientation, kind):
    exif = Image.Exif()
    exif[0x0112] = orientation
    path = save(tmp_path / f"a.{kind}", STORED[orientation](PHOTO), exif=exif)
    assert close(read_photo(path), PHOTO)
    assert photo_size(path) == PHOTO.shape[:2]


@pytest.mark.parametrize("orientation", [0, 9, 65535])
def test_an_unknown_orientation_is_upright(tmp_path, orientation):
    exif = Image.Exif()
    exif[0x0112] = orientation
    path = save(tmp_path / "a.png", NOISE, exif=exif)
    assert np.array_equal(read_photo(path), NOISE)
    assert photo_size(path) == NOISE.shape[:2]


def test_orientation_in_16_bit_grey(tmp_path):
    grey = (NOISE[:, :, 0].astype(np.uint16) << 8) | 0x7F
    exif = Image.Exif()
    exif[0x0112] = 6
    Image.fromarray(np.ascontiguousarray(np.rot90(grey))).save(tmp_path / "a.png", exif=exif)
    assert np.array_equal(read_photo(tmp_path / "a.png"), NOISE[:, :, :1].repeat(3, axis=2))


@pytest.mark.parametrize("kind", ["jpg", "png", "webp"])
@pytest.mark.parametrize("exif", [b"Exif\0\0garbage", b"Exif\0\0II*\0\xff\xff\xff\xff", b"\0"])
def test_a_damaged_exif_block_does_not_cost_the_photo(tmp_path, kind, exif):
    path = save(tmp_path / f"a.{kind}", PHOTO, exif=exif)
    assert close(read_photo(path), PHOTO)
    assert photo_size(path) == PHOTO.shape[:2]


@pytest.mark.parametrize("orientation", range(1, 9))
def test_pixels_are_turned_as_pictures_are(orientation):
    pixels = np.arange(12, dtype=np.uint8).reshape(3, 4)
    wanted = np.asarray(upright_image(Image.fromarray(pixels), orientation))
    np.testing.assert_array_equal(upright(pixels, orientation), wanted)
