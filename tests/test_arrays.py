"""What counts as a photo, and arrays that refuse writes."""

import numpy as np
import pytest

from skyline_viz.arrays import check_photo, read_only


@pytest.mark.parametrize("shape", [(2, 2, 3), (2, 500, 3), (500, 2, 3), (40, 60, 3)])
def test_photos_are_accepted(shape):
    photo = np.zeros(shape, np.uint8)
    check_photo(photo)
    check_photo(photo[::-1, ::-1])
    photo.setflags(write=False)
    check_photo(photo)


@pytest.mark.parametrize(
    ("photo", "found"),
    [
        (np.zeros((9, 9, 3)), "float64"),
        (np.zeros((9, 9, 3), np.int8), "int8"),
        (np.zeros((9, 9, 3), np.uint16), "uint16"),
        (np.zeros((9, 9, 3), bool), "bool"),
        ([[[1, 2, 3]]], "list"),
        ("photo.jpg", "str"),
        (None, "NoneType"),
    ],
)
def test_other_types_are_refused(photo, found):
    with pytest.raises(TypeError, match=rf"uint8 array \(H, W, 3\) in RGB, not {found}$"):
        check_photo(photo)


@pytest.mark.parametrize("shape", [(), (9,), (9, 9), (9, 9, 1), (9, 9, 4), (3, 9, 9), (1, 9, 9, 3)])
def test_other_shapes_are_refused(shape):
    with pytest.raises(ValueError, match=r"has the shape \(H, W, 3\), not \("):
        check_photo(np.zeros(shape, np.uint8))


@pytest.mark.parametrize(("shape", "told"), [((1, 9), "9x1"), ((9, 1), "1x9"), ((0, 5), "5x0")])
def test_too_small_photos_are_refused(shape, told):
    with pytest.raises(ValueError, match=f"at least 2 by 2 pixels, not {told}$"):
        check_photo(np.zeros((*shape, 3), np.uint8))


def test_read_only_arrays():
    array = np.zeros(3)
    read_only(array)
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 1
