"""What the search knew of each pixel."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz.certainty.search_tables as module
from skyline_viz.certainty.search_tables import search_tables
from skyline_viz.path import forward_costs, shortest_path


@given(st.integers(0, 3), st.sampled_from([0.0, 0.1, 0.7]), st.integers(0, 1000))
def test_back_pointers_lead_along_the_cheapest_way_to_every_pixel(delta, weight, seed):
    cost = np.random.default_rng(seed).integers(0, 4, (6, 5)).astype(np.float32)
    forward = forward_costs(cost, delta, weight)
    back = search_tables(cost, delta, weight).back
    rows = np.arange(6)
    assert not back[:, 0].any()
    assert np.abs(back).max() <= delta
    for column in range(1, 5):
        came = forward[rows + back[:, column], column - 1] + weight * np.abs(back[:, column])
        np.testing.assert_allclose(forward[:, column], came + cost[:, column])


@given(st.integers(1, 9), st.integers(0, 1000))
def test_blocks_of_columns_change_nothing(block, seed):
    cost = np.random.default_rng(seed).random((5, 11), np.float32)
    whole = search_tables(cost, 2, 0.1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_BLOCK", 5 * block)
        parts = search_tables(cost, 2, 0.1)
    np.testing.assert_array_equal(parts.above, whole.above)
    np.testing.assert_array_equal(parts.back, whole.back)


def test_they_are_those_of_the_search():
    cost = np.random.default_rng(3).random((30, 40), np.float32)
    tables, path = search_tables(cost, 3, 0.2), shortest_path(cost, 3, 0.2)
    forward = forward_costs(cost, 3, 0.2)
    np.testing.assert_allclose(tables.above, forward - forward.min(axis=0), atol=1e-5)
    steps = path.rows[:-1] - path.rows[1:]
    np.testing.assert_array_equal(tables.back[path.rows[1:], np.arange(1, 40)], steps)
