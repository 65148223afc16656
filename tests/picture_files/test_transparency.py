"""What lies under transparent pixels."""

import numpy as np
import pytest
from PIL import Image

from skyline_viz.photo import (
    read_photo,
)
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
