"""Labels of files with the same content: one photo, one label."""

import shutil

import numpy as np
import pytest

from skyline_viz.photo import write_photo
from skyline_viz.skyline import Skyline
from testing import label_files as made
from testing.imports import imported, is_right, level
from testing.label_files import HEIGHT, NAME, SKYLINE, WIDTH, labelme, shape


@pytest.mark.parametrize("kind", ["mask", "labelme"])
@pytest.mark.parametrize("apart", [0, 1, 20])
def test_labels_of_copies_are_one_and_the_others_are_named(tmp_path, photos, kind, apart):
    shutil.copy(photos / NAME, photos / "z.png")
    shutil.copy(photos / NAME, photos / "y.png")
    for name, row in ((NAME, 30), ("y.png", 30), ("z.png", 30 + apart)):
        stem = name.removesuffix(".png")
        if kind == "mask":
            sky = Skyline(np.full(WIDTH, row)).to_mask(HEIGHT)
            write_photo(tmp_path / "in" / name, np.where(sky, 0, 255).astype(np.uint8))
        else:
            document = labelme(shape(level(row)), name=name)
            made.written(tmp_path / "in" / f"{stem}.json", document)
    found = imported(tmp_path / "in", photos)
    assert [one.name for one in found] == [NAME]
    np.testing.assert_array_equal(found[0].skyline.rows, 30)
    told = f"y.png, z.png are the same photo as {NAME}, and one label of it is kept."
    assert found.notes == (told,)
    wrong = (
        f"z.png is the same photo as {NAME}, and their labels differ by up to {apart} px in "
        f"columns 0 to {WIDTH - 1}; that of {NAME} is kept."
    )
    assert found.problems == ((wrong,) if apart else ())


def test_a_label_that_only_a_copy_has_is_that_of_the_photo(tmp_path, photos):
    (photos / "day").mkdir()
    shutil.copy(photos / NAME, photos / "z.png")
    shutil.copy(photos / NAME, photos / "day" / NAME)
    SKYLINE.write_csv(tmp_path / "in" / "z.csv")
    is_right(imported(tmp_path / "in", photos))
    document = labelme(shape(level(30)), name=f"elsewhere/{NAME}")
    found = imported(made.written(tmp_path / "a.json", document), photos)
    assert [one.name for one in found] == [NAME]
