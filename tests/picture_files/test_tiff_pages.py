"""Which page of a TIFF is the photo."""

from pathlib import Path

import numpy as np
import tifffile
from PIL import Image

from skyline_viz.photo import photo_size, read_photo
from skyline_viz.picture_files.tiff_pages import put_first, tiff_page
from testing import photo_files

PHOTO, ROWS = photo_files.scene()


def test_a_page_is_turned_as_the_first_page_says(tmp_path):
    path = Path(tmp_path / "a.tif")
    turned = np.ascontiguousarray(np.rot90(PHOTO))
    with tifffile.TiffWriter(path) as tiff:
        tags = [(274, 3, 1, 6, True)]
        small = np.ascontiguousarray(turned[::4, ::4])
        tiff.write(small, photometric="rgb", subfiletype=1, subifds=1, extratags=tags)
        tiff.write(turned, photometric="rgb", subfiletype=0)
    assert np.array_equal(read_photo(path), PHOTO)
    assert photo_size(path) == PHOTO.shape[:2]


def test_the_photo_is_the_page_with_the_most_pixels(tmp_path):
    wide, tall = np.zeros((10, 90, 3), np.uint8), np.full((60, 40, 3), 200, np.uint8)
    with tifffile.TiffWriter(tmp_path / "a.tif") as file:
        for page in (wide, tall):
            file.write(page, photometric="rgb", metadata=None)
    with (tmp_path / "a.tif").open("rb") as file:
        page = tiff_page(file)
        assert (page.size, page.first, page.pages, page.alike) == ((40, 60), False, 2, 1)
        assert page.notes == ("has 2 pages, of which the largest is read",)
        first = Image.open(put_first(file, page))
        np.testing.assert_array_equal(np.asarray(first), tall)


def test_a_page_that_says_it_is_reduced_is_none(tmp_path):
    large, photo = np.zeros((60, 90, 3), np.uint8), np.full((20, 30, 3), 200, np.uint8)
    with tifffile.TiffWriter(tmp_path / "a.tif", bigtiff=True) as file:
        file.write(large, photometric="rgb", subfiletype=1, metadata=None)
        file.write(photo, photometric="rgb", metadata=None)
    with (tmp_path / "a.tif").open("rb") as file:
        page = tiff_page(file)
        assert (page.size, page.big, page.pages, page.notes) == ((30, 20), True, 1, ())
        np.testing.assert_array_equal(np.asarray(Image.open(put_first(file, page))), photo)
