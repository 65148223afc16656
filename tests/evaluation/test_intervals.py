"""How sure figures are."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.evaluation.intervals import means_resampled, resampled, wilson

numbers = st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=8)


@given(st.integers(1, 500), st.data())
def test_the_interval_of_a_share_holds_it(total, data):
    hits = data.draw(st.integers(0, total))
    low, high = wilson(hits, total)
    assert 0 <= low <= hits / total <= high <= 1
    mirrored = wilson(total - hits, total)
    assert np.allclose(mirrored, (1 - high, 1 - low))


def test_more_photos_say_more():
    few, many = wilson(9, 10), wilson(900, 1000)
    assert few.low < many.low < many.high < few.high


def test_a_share_of_which_tables_tell():
    assert np.round(wilson(81, 263), 3).tolist() == [0.255, 0.366]  # Newcombe 1998, Table I


@pytest.mark.parametrize(("hits", "total"), [(0, 0), (3, 2), (-1, 2)])
def test_what_is_no_share_is_refused(hits, total):
    with pytest.raises(ValueError, match="is no share"):
        wilson(hits, total)


@given(numbers)
def test_the_interval_of_a_mean_lies_between_the_values(values):
    low, high = resampled(values)
    assert min(values) - 1e-6 <= low <= high <= max(values) + 1e-6


@given(numbers, st.floats(-10, 10))
def test_the_interval_moves_with_the_values(values, by):
    moved = resampled(np.array(values) + by)
    assert np.allclose(moved, np.array(resampled(values)) + by, atol=1e-6)


def test_many_photos_of_one_kind_agree_with_the_standard_error():
    values = np.random.default_rng(0).normal(5, 2, 400)
    low, high = resampled(values)
    assert np.isclose(high - low, 2 * 1.96 * values.std() / 20, rtol=0.05)


def test_groups_are_drawn_as_a_whole():
    means = means_resampled([0, 0, 0, 8], ["a", "a", "a", "b"])
    assert set(np.unique(means)) == {0.0, 2.0, 8.0}


def test_the_names_and_the_order_of_groups_do_not_matter():
    values = [1.0, 5.0, 2.0]
    assert resampled(values, ["x", "y", "x"]) == resampled(values, [7, 3, 7])


@pytest.mark.parametrize(("values", "groups"), [([], None), ([1.0], ["a", "b"]), ([[1.0]], None)])
def test_what_does_not_fit_is_refused(values, groups):
    with pytest.raises(ValueError, match="do not fit"):
        resampled(values, groups)
