"""Maps of values: what hovering tells is the value, to within half a step."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import skyline_viz as sv
from skyline_viz.viewer.maps.value_maps import COARSE, FINE, Quantity, dense_map, sparse_map
from testing.recordings import Read

PLAIN = Quantity("value")
VALUES = arrays(
    np.float64,
    (5, 7),
    elements=st.floats(-1e4, 1e4).map(lambda one: round(one, 6)) | st.just(np.nan),
)


@pytest.mark.parametrize("levels", [COARSE, FINE])
@given(values=VALUES)
def test_values_come_back_to_within_half_a_step(levels, values):
    made = dense_map(PLAIN, values, levels)
    np.testing.assert_array_equal(made.classes == 0, np.isnan(values))
    step = (made.high - made.low) / (levels - 1)
    known = ~np.isnan(values)
    assert (np.abs(made.values() - values)[known] <= 0.5 * step * (1 + 1e-6)).all()
    assert made.classes.max() <= levels
    assert made.classes.dtype == (np.uint8 if levels == COARSE else np.uint16)


def test_what_is_infinite_is_the_end_of_the_range():
    made = dense_map(PLAIN, np.array([[0.0, 3.0, np.inf, -np.inf]]), COARSE)
    assert made.classes.tolist()[0][2] == COARSE
    assert made.classes.tolist()[0][3] == 1
    assert made.high == 3


def test_a_sparse_map_has_values_at_its_pixels_alone():
    rows, columns = np.array([0, 2], np.int32), np.array([1, 3], np.int32)
    made = sparse_map(PLAIN, (3, 4), rows, columns, np.array([0.25, 1.0]), FINE)
    assert np.argwhere(made.classes).tolist() == [[0, 1], [2, 3]]
    np.testing.assert_allclose(made.values()[rows, columns], [0.25, 1.0], atol=1e-3)


@pytest.mark.parametrize(
    ("values", "given", "low", "high"),
    [
        ([0.3, 7.2], {}, 0, 7.5),
        ([-0.3, 0.9], {}, -0.5, 1.0),
        ([120, 480], {}, 0, 500),
        ([0.3, 7.2], {"low": 0.1, "high": 9.9}, 0.1, 9.9),
        ([0, 0], {}, 0, 1),
    ],
)
def test_ranges_are_round_so_that_photos_share_legends(values, given, low, high):
    made = dense_map(Quantity("x", **given), np.array([values], float), COARSE)
    assert (made.low, made.high) == (pytest.approx(low), pytest.approx(high))


def test_words_have_as_many_digits_as_a_step_tells_apart():
    quantity = Quantity("strength", unit=" px")
    assert quantity.label(41.26, 0.1) == "strength 41.3 px"
    assert quantity.label(41.26, 1) == "strength 41 px"
    assert quantity.label(0.12345, 0.002) == "strength 0.123 px"


def test_what_is_logged_is_the_map_with_its_words(tmp_path):
    values = np.array([[0.0, 50.0, 100.0, np.nan]])
    made = dense_map(Quantity("score", "magma", " %"), values, COARSE)
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        made.log(recording, "map")
    read = Read(tmp_path / "a.rrd")
    np.testing.assert_allclose(read.map("map")[0, :3], [0, 50, 100], atol=0.5)
    assert np.isnan(read.map("map")[0, 3])
    assert read.labels("map")[1] == "score 0.0 %"
