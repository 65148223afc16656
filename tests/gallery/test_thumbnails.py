"""Small pictures of photos with their lines."""

import numpy as np
import pytest
from PIL import Image

import skyline_viz as sv
from skyline_viz.gallery.thumbnails import thumbnail, write_thumbnail
from skyline_viz.overlay import PATH, TRUTH


def near(picture, colour):
    return (np.abs(picture.astype(int) - colour) < 30).all(axis=2)


@pytest.mark.parametrize(
    ("shape", "size"),
    [
        ((519, 1388), (239, 640)),
        ((2000, 1000), (360, 180)),
        ((90, 120), (90, 120)),
        ((5, 3000), (2, 640)),
        ((3000, 5), (360, 2)),
    ],
)
def test_it_fits_and_keeps_the_shape(shape, size):
    line = sv.Skyline(np.full(shape[1], shape[0] / 2))
    assert thumbnail(np.zeros((*shape, 3), np.uint8), line, None).shape == (*size, 3)


@pytest.mark.parametrize("height", [400, 3000])
def test_lines_are_where_they_are_on_the_photo(height):
    width = height * 3 // 2
    rows = np.linspace(height * 0.2, height * 0.4, width)
    visible = np.arange(width) < width // 2
    photo = np.full((height, width, 3), 128, np.uint8)
    picture = thumbnail(photo, sv.Skyline(rows), sv.Skyline(rows + height * 0.3, visible))
    scale = len(picture) / height
    for column in (50, 400):
        there = near(picture, PATH)[:, column].nonzero()[0]
        row = rows[int(column / scale)] * scale
        assert abs(there.mean() - row) < 2
    assert near(picture, TRUTH)[:, 50].any()
    assert not near(picture, TRUTH)[:, 400].any()


def test_the_file_keeps_the_colours(tmp_path):
    photo = np.full((300, 400, 3), 128, np.uint8)
    write_thumbnail(tmp_path / "new" / "a.jpg", photo, sv.Skyline(np.full(400, 150.0)), None)
    with Image.open(tmp_path / "new" / "a.jpg") as picture:
        assert near(np.asarray(picture), PATH).sum() > 300
