"""What counts as a photo, arrays that refuse writes, and runs of a mask."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.arrays import check_photo, read_only, runs


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


@given(st.lists(st.booleans(), max_size=60), st.integers(0, 6))
def test_runs_hold_every_true_and_lie_apart(mask, gap):
    found = runs(np.array(mask, bool), gap)
    true = {place for place, one in enumerate(mask) if one}
    held = {place for first, last in found for place in range(first, last + 1)}
    assert true <= held
    for first, last in found:
        assert {first, last} <= true
        inside = [one for one in sorted(true) if first <= one <= last]
        assert all(b - a <= gap + 1 for a, b in pairwise(inside))
    for (_, last), (first, _) in pairwise(found):
        assert first - last > gap + 1
