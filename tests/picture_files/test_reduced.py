"""JPEG files decoded at a fraction of their size."""

import io

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import ExifTags, Image

from skyline_viz.photo import read_photo
from skyline_viz.picture_files.reduced import reduced_jpeg
from testing.labelling import hills

PHOTO = hills(4, 400, 600)


def as_file(pixels, **how):
    data = io.BytesIO()
    Image.fromarray(pixels).save(data, "JPEG", quality=95, **how)
    return data.getvalue()


WHOLE = as_file(PHOTO)


@given(st.integers(1, 900), st.integers(1, 900))
def test_it_is_the_smallest_fraction_that_is_no_smaller_than_asked(height, width):
    found = reduced_jpeg(WHOLE, height, width).shape[:2]
    assert found in [(400 // by, 600 // by) for by in (1, 2, 4, 8)]
    assert found[0] >= min(height, 400)
    assert found[1] >= min(width, 600)
    fits = [by for by in (1, 2, 4, 8) if 400 // by >= height and 600 // by >= width]
    assert found == (400 // max(fits, default=1), 600 // max(fits, default=1))


@pytest.mark.parametrize("orientation", range(1, 9))
def test_it_is_upright(tmp_path, orientation):
    exif = Image.Exif()
    exif[ExifTags.Base.Orientation] = orientation
    data = as_file(PHOTO, exif=exif)
    (tmp_path / "one.jpg").write_bytes(data)
    whole = read_photo(tmp_path / "one.jpg")
    half = reduced_jpeg(data, whole.shape[0] // 2, whole.shape[1] // 2)
    averaged = cv2.resize(whole, half.shape[1::-1], interpolation=cv2.INTER_AREA)
    assert half.shape[0] == whole.shape[0] // 2
    assert np.abs(half.astype(int) - averaged).mean() < 3


def test_grey_becomes_rgb():
    found = reduced_jpeg(as_file(PHOTO[..., 0]), 10, 10)
    assert found.shape == (50, 75, 3)
    assert (found[..., 0] == found[..., 2]).all()


@pytest.mark.parametrize("data", [b"", b"no picture", WHOLE[:-900], WHOLE[:30]])
def test_what_is_not_whole_is_left_to_others(data):
    assert reduced_jpeg(data, 10, 10) is None


def test_other_formats_and_inks_are_left_to_others():
    data = io.BytesIO()
    Image.fromarray(PHOTO).save(data, "PNG")
    assert reduced_jpeg(data.getvalue(), 10, 10) is None
    data = io.BytesIO()
    Image.fromarray(PHOTO).convert("CMYK").save(data, "JPEG")
    assert reduced_jpeg(data.getvalue(), 10, 10) is None
