"""Metrics: hand-counted values, and what must hold for every pair of skylines."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.evaluation.metrics import (
    GROSS_MISS_SHARE,
    a_err,
    called_invisible,
    column_errors,
    is_gross_miss,
    segmentation_accuracy,
    wrong_segments,
)
from skyline_viz.skyline import Skyline, SkylineError

HEIGHT = 30


@st.composite
def pairs(draw):
    """Two skylines of one width, inside an image `HEIGHT` high."""
    width = draw(st.integers(1, 12))
    rows = st.lists(st.integers(0, HEIGHT), min_size=width, max_size=width)
    visible = st.lists(st.booleans(), min_size=width, max_size=width)
    return tuple(Skyline(draw(rows), np.array(draw(visible))) for _ in range(2))


def test_column_errors_count_columns_in_which_the_truth_is_visible():
    skyline = Skyline([1, 2, 3, 4.5], np.array([True, False, True, True]))
    truth = Skyline([3, 2, 3, 4], np.array([True, True, False, True]))
    np.testing.assert_array_equal(column_errors(skyline, truth), [2, 0, np.nan, 0.5])


def test_column_errors_have_the_precision_of_rows():
    errors = column_errors(Skyline([16_777_215]), Skyline([0.5]))
    assert errors.dtype == np.float64
    assert errors[0] == 16_777_214.5


def test_a_err_by_hand():
    truth = Skyline([10, 10, 10, 10], np.array([True, True, True, False]))
    assert a_err(Skyline([10, 12, 7, 99]), truth) == pytest.approx(5 / 3)


@given(pairs())
def test_a_err_is_zero_only_on_itself(pair):
    skyline, truth = pair
    if not truth.visible.any():
        for metric in (a_err, called_invisible):
            with pytest.raises(SkylineError, match="visible in no column"):
                metric(skyline, truth)
        return
    rows = truth.rows[truth.visible]
    assert (a_err(skyline, truth) == 0) == np.array_equal(skyline.rows[truth.visible], rows)


@given(pairs(), st.floats(0, HEIGHT, width=16))
def test_columns_without_a_visible_truth_never_count(pair, elsewhere):
    skyline, truth = pair
    moved = Skyline(np.where(truth.visible, skyline.rows, elsewhere), skyline.visible)
    np.testing.assert_array_equal(column_errors(moved, truth), column_errors(skyline, truth))
    if truth.visible.any():
        share = segmentation_accuracy(skyline, truth, HEIGHT)
        assert segmentation_accuracy(moved, truth, HEIGHT) == share
        assert called_invisible(moved, truth) == called_invisible(skyline, truth)


@given(pairs())
def test_nothing_gets_better_by_looking_away(pair):
    skyline, truth = pair
    if not truth.visible.any():
        return
    open_eyed = Skyline(skyline.rows)
    np.testing.assert_array_equal(column_errors(skyline, truth), column_errors(open_eyed, truth))
    for metric in (a_err, lambda one, other: segmentation_accuracy(one, other, HEIGHT)):
        assert metric(skyline, truth) == metric(open_eyed, truth)
    assert called_invisible(open_eyed, truth) == 0
    looked_away = truth.visible & ~skyline.visible
    assert called_invisible(skyline, truth) == pytest.approx(
        looked_away.sum() / truth.visible.sum()
    )


@given(pairs())
def test_segmentation_accuracy_counts_pixels(pair):
    skyline, truth = pair
    if truth.visible.any():
        agree = skyline.to_mask(HEIGHT) == truth.to_mask(HEIGHT)
        expected = agree[:, truth.visible].mean()
        assert segmentation_accuracy(skyline, truth, HEIGHT) == pytest.approx(expected)


def test_segmentation_accuracy_rounds_rows_to_pixels():
    assert segmentation_accuracy(Skyline([4.4]), Skyline([3.6]), 10) == 1
    assert segmentation_accuracy(Skyline([4.5]), Skyline([4.4]), 10) == pytest.approx(0.9)


def test_segmentation_accuracy_refuses_rows_outside():
    with pytest.raises(SkylineError, match="outside a height of 10"):
        segmentation_accuracy(Skyline([11]), Skyline([3]), 10)


@pytest.mark.parametrize(
    "metric",
    [column_errors, a_err, called_invisible, lambda a, b: segmentation_accuracy(a, b, HEIGHT)],
)
def test_widths_must_match(metric):
    with pytest.raises(SkylineError, match="2 columns, the truth 3"):
        metric(Skyline([1, 2]), Skyline([1, 2, 3]))


def test_gross_miss_is_over_5_percent_of_the_height():
    assert GROSS_MISS_SHARE == 0.05
    assert not is_gross_miss(10.0, 200)
    assert is_gross_miss(math.nextafter(10.0, 11), 200)


def test_five_right_columns_do_not_end_a_segment_and_six_do():
    errors = np.zeros(30)
    errors[[3, 9, 16]] = 9
    assert wrong_segments(errors, height=100) == ((3, 9), (16, 16))
