"""From samples of any depth to eight bits."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from skyline_viz.photo import read_photo, read_photo_with_notes
from skyline_viz.picture_files.pixel_depth import white_of
from testing import photo_files
from testing.pictures import NOISE, close, refusal


@pytest.mark.parametrize("kind", ["png", "tif", "pgm"])
def test_16_bit_grey_keeps_the_high_byte(tmp_path, kind):
    low = np.random.default_rng(1).integers(0, 256, NOISE.shape[:2], dtype=np.uint16)
    deep = (NOISE[:, :, 0].astype(np.uint16) << 8) | low
    assert cv2.imwrite(str(tmp_path / f"a.{kind}"), deep)
    assert np.array_equal(read_photo(tmp_path / f"a.{kind}"), NOISE[:, :, :1].repeat(3, axis=2))


@pytest.mark.parametrize("kind", ["png", "tif", "ppm"])
def test_16_bit_colour_keeps_the_high_byte(tmp_path, kind):
    deep = (NOISE.astype(np.uint16) << 8) | 0x5A
    options = [cv2.IMWRITE_TIFF_COMPRESSION, 1] if kind == "tif" else []
    assert cv2.imwrite(str(tmp_path / f"a.{kind}"), deep[:, :, ::-1], options)
    assert close(read_photo(tmp_path / f"a.{kind}"), NOISE, tolerance=1)


def test_a_pgm_of_10_bits_fills_the_range(tmp_path):
    ten = np.linspace(0, 1023, 8 * 16).round().astype(">u2").reshape(8, 16)
    (tmp_path / "a.pgm").write_bytes(b"P5 16 8 1023\n" + ten.tobytes())
    photo = read_photo(tmp_path / "a.pgm")
    assert photo.min() == 0
    assert photo.max() == 255
    assert close(photo[:, :, 0], ten.astype(float) * 255 / 1023, tolerance=1)


def test_floating_point_pixels_are_refused(tmp_path):
    Image.fromarray(np.zeros((16, 16), np.float32)).save(tmp_path / "a.tif")
    assert "floating-point" in refusal(tmp_path / "a.tif")


PHOTO, ROWS = photo_files.scene()


@pytest.mark.parametrize("name", ["16.png", "12.png", "10.tif", "12_deflate.tif", "linear.png"])
def test_depths_come_back_as_they_were(tmp_path, name):
    photo_files.READ[name](tmp_path / name, PHOTO)
    assert np.abs(read_photo(tmp_path / name).astype(int) - PHOTO).max() <= 2


@given(st.integers(0, 65535), st.sampled_from([None, 1023, 4095, 65535]))
def test_white_holds_every_sample_and_a_guess_is_noted(brightest, said):
    white, note = white_of(np.array([0, brightest], np.uint16), said)
    assert white >= brightest
    assert white in (255, 1023, 4095, 16383, 65535)
    assert (note is None) == (white in (said, 65535))


def test_the_brightest_sample_may_be_the_white_that_the_file_names():
    samples = np.array([0, 1000], np.uint16)
    assert white_of(samples, said=1000) == (1000, None)
    assert white_of(samples, said=999)[0] == 1023  # which cannot be


def test_a_dark_photo_of_16_bits_that_says_so_stays_dark(tmp_path):
    path = tmp_path / "a.png"
    bits = photo_files.chunk(b"sBIT", bytes([16]))
    photo_files.deep(12, "png", colour=False)(path, PHOTO)
    data = path.read_bytes()
    path.write_bytes(data[:33] + bits + data[33:])
    photo, notes = read_photo_with_notes(path)
    assert photo.max() < 16
    assert notes == ()
