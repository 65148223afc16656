"""Which page of a TIFF is the photo."""

from pathlib import Path

import numpy as np

from skyline_viz.photo import photo_size, read_photo
from testing import photo_files

PHOTO, ROWS = photo_files.scene()


def test_a_page_is_turned_as_the_first_page_says(tmp_path):
    import tifffile  # noqa: PLC0415

    path = Path(tmp_path / "a.tif")
    turned = np.ascontiguousarray(np.rot90(PHOTO))
    with tifffile.TiffWriter(path) as tiff:
        tags = [(274, 3, 1, 6, True)]
        small = np.ascontiguousarray(turned[::4, ::4])
        tiff.write(small, photometric="rgb", subfiletype=1, subifds=1, extratags=tags)
        tiff.write(turned, photometric="rgb", subfiletype=0)
    assert np.array_equal(read_photo(path), PHOTO)
    assert photo_size(path) == PHOTO.shape[:2]
