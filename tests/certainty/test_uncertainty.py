import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import skyline_viz.certainty.uncertainty as module
from skyline_viz.certainty.uncertainty import uncertainty
from skyline_viz.constraints import PathError
from skyline_viz.path import margins, path_tables, shortest_path

COSTS = hnp.arrays(
    np.float64,
    hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=12),
    elements=st.floats(-2, 5, width=16) | st.sampled_from([0.0, 1.0, np.inf]),
)


@given(cost=COSTS, delta=st.integers(0, 3), link=st.sampled_from([0.0, 0.1, 1.0]))
def test_agrees_with_the_tables_of_the_path(cost, delta, link):
    try:
        tables = path_tables(cost, delta, link)
    except PathError:
        return
    through = tables.min_marginals
    for apart in (0, 1, 5):
        found = uncertainty(cost, delta, link, apart)
        one_best = (through <= through.min(axis=0) + 1e-6).sum(axis=0) == 1  # else rounding chooses
        expected = margins(through, apart)
        np.testing.assert_allclose(found.margins[one_best], expected[one_best], atol=1e-9)
        np.testing.assert_allclose(found.detour, through - through.min(), atol=1e-5)


@given(cost=COSTS.filter(lambda cost: np.isfinite(cost).all()), delta=st.integers(0, 3))
def test_the_best_path_is_no_detour_and_everything_else_is_no_gain(cost, delta):
    rows = shortest_path(cost, delta, 0.1).rows
    detour = uncertainty(cost, delta, 0.1).detour
    assert detour[rows, np.arange(len(rows))] == pytest.approx(0, abs=1e-5)
    assert (detour >= 0).all()


def test_nothing_else_to_choose_is_infinitely_sure():
    assert np.isinf(uncertainty(np.zeros((4, 3)), 1, 0.1).margins).all()


def test_two_equal_valleys_are_not_sure_at_all():
    cost = np.ones((20, 7), np.float32)
    cost[[2, 15]] = 0
    assert uncertainty(cost, 2, 0.1).margins == pytest.approx(0)


def test_the_arrays_are_frozen():
    found = uncertainty(np.zeros((3, 3)), 1, 0.0)
    with pytest.raises(ValueError, match="read-only"):
        found.margins[0] = 1


@given(cost=COSTS, delta=st.integers(0, 3), kept=st.integers(1, 60))
def test_forward_costs_that_are_kept_in_part_give_the_same(cost, delta, kept):
    if not np.isfinite(cost.min(axis=0)).all():
        return  # there is no path
    whole = uncertainty(cost, delta, 0.1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "KEPT", kept)
        parts = uncertainty(cost, delta, 0.1)
    np.testing.assert_array_equal(parts.margins, whole.margins)
    np.testing.assert_array_equal(parts.detour, whole.detour)
