"""From samples of any depth to eight bits."""

import cv2
import numpy as np
import pytest
from PIL import Image

from skyline_viz.photo import (
    read_photo,
)
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
