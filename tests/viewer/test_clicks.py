"""What was clicked, and what is said of it."""

import io
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import skyline_viz as sv
from skyline_viz.viewer.clicks import answer, clicked_pixel
from testing.recordings import scene


def item(path, position=None):
    return SimpleNamespace(entity_path=path, position=position)


@pytest.mark.parametrize(
    ("items", "pixel"),
    [
        ([item("/photo", [12.9, 3.2, None])], (3, 12)),
        ([item("/photo"), item("/skyline/strip", [0.0, 0.0, None])], (0, 0)),
        ([item("/pixel/path/patch", [3.0, 3.0, None])], None),
        ([item("/bank/filters/cells", [3.0, 3.0, None])], None),
        ([item("/photo", [80.0, 3.0, None])], None),
        ([item("/photo", [8.0, -0.1, None])], None),
        ([SimpleNamespace(view_id="a view")], None),
        ([], None),
    ],
)
def test_a_pixel_is_one_of_the_photo(items, pixel):
    assert clicked_pixel(items, (60, 80)) == pixel


def test_a_pixel_is_told_beside_that_of_the_path():
    found = sv.Detector().detect(scene()[0])
    told = answer(found, 80, 5)
    assert "| | path | clicked | clicked less path |" in told.text
    assert f"| row | {found.skyline.rows[5]:.0f} | 80 |" in told.text
    assert "worst" not in told.text
    picture = np.asarray(Image.open(io.BytesIO(told.picture)))
    assert picture.shape[1] / picture.shape[0] == 1.5  # three squares for each of two pixels


def test_a_method_without_filters_has_words_alone():
    found = sv.find_method("gradient").detect(scene()[0])
    told = answer(found, 10, 5)
    assert told.picture is None
    assert "| row |" in told.text
