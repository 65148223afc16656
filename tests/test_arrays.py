"""What counts as a photo, arrays that refuse writes, and runs of a mask."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from skyline_viz.arrays import (
    check_photo,
    column_counts,
    column_ends,
    in_colour,
    in_numbers,
    read_only,
    runs,
)

LOW = st.integers(0, 2)


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


LEVELS = arrays(np.uint8, st.tuples(st.integers(1, 6), st.integers(1, 6), st.just(3)), elements=LOW)


@given(LEVELS, st.tuples(LOW, LOW, LOW))
def test_pixels_of_a_colour_are_those_whose_channels_all_are(photo, colour):
    assert np.array_equal(in_colour(photo, colour), (photo == np.array(colour)).all(axis=2))
    turned = photo[::-1, ::-1].swapaxes(0, 1)
    assert np.array_equal(in_colour(turned, colour), (turned == np.array(colour)).all(axis=2))


def test_no_byte_has_a_level_of_16_bits():
    assert not in_colour(np.full((2, 2, 3), 255, np.uint8), (255, 256, 255)).any()


@given(arrays(np.bool_, st.tuples(st.integers(1, 9), st.integers(1, 9))))
def test_columns_are_counted(mask):
    assert np.array_equal(column_counts(mask), mask.sum(axis=0))
    assert np.array_equal(column_counts(mask.T[::-1]), mask.T.sum(axis=0))


@given(arrays(np.bool_, st.tuples(st.integers(1, 9), st.integers(1, 9))))
def test_columns_end_where_their_first_and_last_pixels_are(mask):
    first, last = column_ends(mask)
    seen = mask.any(axis=0)
    assert np.array_equal(first, mask.argmax(axis=0))
    assert np.array_equal(last, np.where(seen, len(mask) - 1 - mask[::-1].argmax(axis=0), 0))


def test_pixels_of_one_colour_have_one_number():
    photo = np.array([[[1, 2, 3], [3, 2, 1], [1, 2, 3]]], np.uint8)
    one, other, same = in_numbers(photo[:, ::-1])[0].tolist()
    assert one == same != other
