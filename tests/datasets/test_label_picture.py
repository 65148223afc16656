"""Reading a picture that is a label: its pages, its depth, the way it is turned."""

import numpy as np
import pytest
import tifffile
from PIL import Image

from skyline_viz.datasets.truths import read_truth, truth_with_notes
from skyline_viz.photo import read_photo
from skyline_viz.skyline import SkylineError
from testing import label_files as made
from testing.label_files import said_about


def test_an_image_that_is_turned_is_read_upright(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6
    turned = np.rot90(made.MASK)
    path = made.picture(tmp_path / "m.png", turned, exif=exif)
    assert read_truth(path) == made.SKYLINE


TURNS = {
    2: lambda a: a[:, ::-1],
    3: lambda a: a[::-1, ::-1],
    4: lambda a: a[::-1],
    5: lambda a: a.swapaxes(0, 1),
    6: np.rot90,
    7: lambda a: np.rot90(a, -1)[::-1],
    8: lambda a: np.rot90(a, -1),
}
"""How pixels are stored that come upright by an orientation."""


@pytest.mark.parametrize("orientation", TURNS)
@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.float32, "palette", "colours"])
def test_a_turned_tiff_is_read_as_photos_are(tmp_path, orientation, kind):
    turned = np.ascontiguousarray(TURNS[orientation](made.MASK))
    path = tmp_path / "m.tif"
    if kind == "palette":
        image = Image.fromarray(turned).convert("P")
        image.save(path, tiffinfo={274: orientation})
    else:
        values = turned if kind == "colours" else (turned // 255).astype(kind)
        values = np.repeat(values[:, :, None], 3, axis=2) if kind == "colours" else values
        tag = (274, "H", 1, orientation, True)
        tifffile.imwrite(path, values, extratags=[tag], metadata=None)
    assert read_truth(path) == made.SKYLINE
    if kind == "colours":
        np.testing.assert_array_equal(read_photo(path)[:, :, 0], made.MASK)


def test_turned_tiff_colours_of_16_bits_are_refused(tmp_path):
    pixels = np.repeat(made.MASK[::-1, :, None].astype(np.uint16) * 257, 3, axis=2)
    tag = (274, "H", 1, 4, True)
    tifffile.imwrite(tmp_path / "m.tif", pixels, photometric="rgb", extratags=[tag])
    with pytest.raises(SkylineError, match="stored turned"):
        read_truth(tmp_path / "m.tif")


@pytest.mark.parametrize("kind", [np.uint8, np.float32])
def test_the_full_page_of_a_tiff_is_its_mask(tmp_path, kind):
    mask = (made.MASK // 255).astype(kind)
    small = np.ascontiguousarray(mask[::-4, ::4])
    for name, mark, notes in (
        ("marked.tif", 1, ()),
        ("plain.tif", 0, ("of its 2 pages the largest was read",)),
    ):
        with tifffile.TiffWriter(tmp_path / name) as file:
            file.write(small, subfiletype=mark, metadata=None)
            file.write(mask, metadata=None)
        found = truth_with_notes(tmp_path / name)
        assert (found.skyline, found.notes) == (made.SKYLINE, notes)


def test_of_two_masks_in_a_tiff_none_is_guessed(tmp_path):
    with tifffile.TiffWriter(tmp_path / "m.tif") as file:
        for mask in (made.MASK[::-1], made.MASK):
            file.write(np.ascontiguousarray(mask), metadata=None)
    said = said_about(tmp_path / "m.tif")
    assert "2 pages of the same size" in said
    assert "which of them is the mask" in said
