"""The path search against brute force: optimum, ties, tables, margins and constraints."""

from fractions import Fraction
from itertools import product
from math import floor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.constraints import Anchor, Constraints, PathError, StraightSpan
from skyline_viz.path import forward_costs, margins, path_tables, shortest_path
from testing.examples import examples

STEADY = examples(150)
INF = np.inf


def every_path(cost, delta, link_weight, constraints=None):
    """All paths ``(n, W)`` that are allowed, and what each of them costs."""
    constraints = constraints or Constraints()
    height, width = cost.shape
    free = np.isfinite(cost)
    if constraints.forbidden is not None:
        free &= ~constraints.forbidden
    fixed = [(anchor.column, anchor.row) for anchor in constraints.anchors]
    unlimited = np.zeros(width - 1, bool)
    for span in constraints.straight:
        unlimited[span.start.column : span.end.column] = True
        fixed += straight_line(span)
    for column, row in fixed:
        others = np.arange(height) != row
        free[others, column] = False
    paths = np.array(list(product(range(height), repeat=width)))
    changes = np.abs(np.diff(paths, axis=1))
    allowed = free[paths, np.arange(width)].all(axis=1)
    allowed &= ((changes <= delta) | unlimited).all(axis=1)
    paths, changes = paths[allowed], changes[allowed]
    totals = cost.astype(float)[paths, np.arange(width)].sum(axis=1)
    return paths, totals + link_weight * changes.sum(axis=1)


def straight_line(span):
    """Column and row of each pixel of a span; halves are rounded down the image."""
    start, end = span.start, span.end
    slope = Fraction(end.row - start.row, end.column - start.column)
    return [
        (column, floor(start.row + slope * (column - start.column) + Fraction(1, 2)))
        for column in range(start.column, end.column + 1)
    ]


def check_against(cost, delta, link_weight, constraints=None):
    """The path and the tables are those that brute force finds, or both find none."""
    paths, totals = every_path(cost, delta, link_weight, constraints)
    if len(paths) == 0:
        with pytest.raises(PathError):
            shortest_path(cost, delta, link_weight, constraints)
        with pytest.raises(PathError):
            path_tables(cost, delta, link_weight, constraints)
        return
    path = shortest_path(cost, delta, link_weight, constraints)
    assert path.rows.dtype == np.int32
    assert path.cost == totals.min()
    same = (paths == path.rows).all(axis=1)
    assert totals[same].tolist() == [path.cost]
    tables = path_tables(cost, delta, link_weight, constraints)
    height, width = cost.shape
    through = np.full(cost.shape, INF)
    for column, row in product(range(width), range(height)):
        through[row, column] = min(totals[paths[:, column] == row], default=INF)
    assert np.array_equal(tables.min_marginals, through)
    assert tables.forward[:, -1].min() == path.cost
    assert tables.backward[:, 0].min() == path.cost
    assert np.array_equal(tables.forward[:, -1], through[:, -1])
    if constraints is None:
        assert np.array_equal(forward_costs(cost, delta, link_weight), tables.forward)
    assert np.array_equal(tables.backward[:, 0], through[:, 0])


@st.composite
def costs(draw, infinite=True, shape=None):
    """Small whole costs: sums are exact, and ties are frequent."""
    height, width = shape or (draw(st.integers(1, 4)), draw(st.integers(1, 5)))
    values = st.sampled_from([0, 1, 2, 3, 5, 9, INF]) if infinite else st.integers(0, 9)
    cells = draw(st.lists(values, min_size=height * width, max_size=height * width))
    return np.array(cells, np.float32).reshape(height, width)


deltas = st.integers(0, 3)
link_weights = st.sampled_from([0, 0.25, 1, 2.5])


# The optimum


@STEADY
@given(costs(), deltas, link_weights)
def test_brute_force_finds_nothing_cheaper(cost, delta, link_weight):
    check_against(cost, delta, link_weight)


@STEADY
@given(costs(infinite=False, shape=(5, 4)), deltas, link_weights)
def test_brute_force_on_higher_grids(cost, delta, link_weight):
    check_against(cost, delta, link_weight)


@pytest.mark.parametrize("seed", range(5))
def test_fractional_costs(seed):
    cost = np.random.default_rng(seed).normal(size=(4, 5))
    paths, totals = every_path(cost, 2, 0.3)
    path = shortest_path(cost, 2, 0.3)
    assert path.cost == pytest.approx(totals.min(), abs=1e-12)
    assert np.array_equal(path.rows, paths[totals.argmin()])


@STEADY
@given(costs(), deltas, link_weights)
def test_a_flipped_photo_costs_the_same(cost, delta, link_weight):
    try:
        expected = shortest_path(cost, delta, link_weight)
    except PathError:
        with pytest.raises(PathError):
            shortest_path(cost[:, ::-1], delta, link_weight)
        return
    assert shortest_path(cost[:, ::-1], delta, link_weight).cost == expected.cost
    here = path_tables(cost, delta, link_weight).min_marginals
    there = path_tables(cost[:, ::-1], delta, link_weight).min_marginals
    assert np.array_equal(there[:, ::-1], here)


def test_long_paths():
    height, width = 60, 300
    rng = np.random.default_rng(0)
    walk = np.clip(np.cumsum(rng.integers(-3, 4, width)) + 30, 0, height - 1)
    cost = rng.uniform(1.5, 3, (height, width)).astype(np.float32)
    cost[walk, np.arange(width)] = 0
    steepest = int(np.abs(np.diff(walk)).max())
    assert np.array_equal(shortest_path(cost, steepest, 0.1).rows, walk)
    limited = shortest_path(cost, steepest - 1, 0.1)
    assert np.abs(np.diff(limited.rows)).max() == steepest - 1
    assert limited.cost > shortest_path(cost, steepest, 0.1).cost


def test_delta_larger_than_the_height():
    cost = np.array([[0, 9, 9], [9, 9, 9], [9, 9, 9], [9, 0, 0]], np.float32)
    assert shortest_path(cost, 100, 0).rows.tolist() == [0, 3, 3]
    assert shortest_path(cost, 100, 1).cost == 3
    check_against(cost, 100, 0.25)


def test_one_column():
    path = shortest_path(np.array([[4], [2], [3]], np.float32), 1, 0.5)
    assert path.rows.tolist() == [1]
    assert path.cost == 2
    check_against(np.array([[4], [2], [INF]], np.float32), 1, 0.5)


def test_one_row():
    path = shortest_path(np.array([[4, 2, 3]], np.float32), 5, 0.5)
    assert path.rows.tolist() == [0, 0, 0]
    assert path.cost == 9


def test_one_pixel():
    assert shortest_path(np.array([[7.0]]), 0, 0).cost == 7


@pytest.mark.parametrize("make", [np.asfortranarray, np.ascontiguousarray, np.float64])
def test_the_memory_layout_does_not_matter(make):
    cost = np.random.default_rng(1).integers(0, 9, (12, 15)).astype(np.float32)
    before = cost.copy()
    expected = shortest_path(cost, 2, 0.5)
    found = shortest_path(make(cost), 2, 0.5)
    assert np.array_equal(found.rows, expected.rows)
    assert found.cost == expected.cost
    assert np.array_equal(cost, before)


def test_read_only_costs():
    cost = np.random.default_rng(1).integers(0, 9, (6, 7)).astype(np.float32).T
    cost.setflags(write=False)
    fixed = Constraints(anchors=(Anchor(3, 3),))
    assert shortest_path(cost, 1, 0).cost == path_tables(cost, 1, 0).min_marginals.min()
    assert shortest_path(cost, 1, 0, fixed).rows[3] == 3


# Ties


@pytest.mark.parametrize("delta", [0, 1, 4])
@pytest.mark.parametrize(("height", "middle"), [(1, 0), (2, 1), (5, 2), (6, 3), (41, 20)])
def test_without_any_difference_the_path_is_level_in_the_middle(height, middle, delta):
    path = shortest_path(np.full((height, 7), 2, np.float32), delta, 0)
    assert path.rows.tolist() == [middle] * 7


@pytest.mark.parametrize(("last", "end"), [([9, 0, 9, 9, 0], 1), ([0, 9, 9, 0, 9], 3)])
def test_the_end_nearest_the_middle_row_wins(last, end):
    cost = np.zeros((5, 3), np.float32)
    cost[:, -1] = last
    assert shortest_path(cost, 4, 0).rows.tolist() == [end] * 3


def test_the_smallest_change_of_row_wins():
    cost = np.array([[0, 0], [9, 9], [0, 9], [9, 9], [9, 0]], np.float32)
    cost[0, 1] = 9
    assert shortest_path(cost, 4, 0).rows.tolist() == [2, 4]


# Margins


def brute_margins(through, apart):
    found = []
    for column in through.T:
        best = int(np.argmin(column))
        others = [value for row, value in enumerate(column) if abs(row - best) > apart]
        found.append(max(min(others, default=INF) - column[best], 0))
    return found


@STEADY
@given(costs(infinite=False), deltas, link_weights, st.integers(0, 3))
def test_margins_are_the_gap_to_the_best_distinct_alternative(cost, delta, link_weight, apart):
    through = path_tables(cost, delta, link_weight).min_marginals
    found = margins(through, apart)
    assert found.shape == (cost.shape[1],)
    assert found.tolist() == brute_margins(through, apart)


def test_margins_look_more_than_five_rows_away():
    through = np.full((13, 2), 9.0)
    through[4, 0], through[9, 0], through[10, 0] = 1, 2, 4
    through[4, 1], through[0, 1] = 1, 2
    assert margins(through).tolist() == [3, 8]


def test_margins_are_infinite_where_nothing_else_is_possible():
    cost = np.ones((20, 5), np.float32)
    through = path_tables(cost, 1, 0, Constraints(anchors=(Anchor(2, 10),))).min_marginals
    assert np.isinf(margins(through)).tolist() == [True] * 5
    assert margins(through, apart=2).tolist() == [0, INF, INF, INF, 0]


def test_margins_are_zero_without_any_difference():
    through = path_tables(np.full((20, 6), 2, np.float32), 2, 0).min_marginals
    assert margins(through).tolist() == [0] * 6


# Constraints


@STEADY
@given(costs(), deltas, link_weights, st.data())
def test_anchors_and_forbidden_pixels_against_brute_force(cost, delta, link_weight, data):
    height, width = cost.shape
    columns = data.draw(st.lists(st.integers(0, width - 1), max_size=3, unique=True))
    anchors = tuple(Anchor(column, data.draw(st.integers(0, height - 1))) for column in columns)
    bits = data.draw(
        st.lists(st.sampled_from([False, False, True]), min_size=cost.size, max_size=cost.size)
    )
    forbidden = data.draw(st.sampled_from([None, np.array(bits).reshape(cost.shape)]))
    check_against(cost, delta, link_weight, Constraints(anchors=anchors, forbidden=forbidden))


@STEADY
@given(costs(), deltas, link_weights, st.data())
def test_straight_spans_against_brute_force(cost, delta, link_weight, data):
    height, width = cost.shape
    ends = data.draw(st.lists(st.integers(0, width - 1), max_size=4, unique=True))
    ends = sorted(ends)[: len(ends) // 2 * 2]
    rows = [data.draw(st.integers(0, height - 1)) for _ in ends]
    points = [Anchor(column, row) for column, row in zip(ends, rows, strict=True)]
    spans = tuple(StraightSpan(*pair) for pair in zip(points[::2], points[1::2], strict=True))
    check_against(cost, delta, link_weight, Constraints(straight=spans))


# What is refused


@pytest.mark.parametrize("bad", [np.nan, -INF])
@pytest.mark.parametrize("find", [shortest_path, path_tables, forward_costs])
def test_nan_and_minus_infinity_are_refused(find, bad):
    cost = np.ones((4, 5), np.float32)
    cost[2, 3] = bad
    with pytest.raises(PathError, match="NaN or minus infinity"):
        find(cost, 1, 0)


@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (5,), (2, 3, 4)])
def test_costs_of_another_shape_are_refused(shape):
    with pytest.raises(PathError, match=r"shape \(H, W\)"):
        shortest_path(np.ones(shape), 1, 0)


@pytest.mark.parametrize("delta", [-1, 1.5, np.nan, INF])
def test_a_bad_delta_is_refused(delta):
    with pytest.raises(PathError, match=f"delta is a whole number.* not {delta}"):
        shortest_path(np.ones((3, 3)), delta, 0)


@pytest.mark.parametrize("link_weight", [-0.1, np.nan, INF])
def test_a_bad_link_weight_is_refused(link_weight):
    with pytest.raises(PathError, match=f"link_weight is finite.* not {link_weight}"):
        shortest_path(np.ones((3, 3)), 1, link_weight)


@pytest.mark.parametrize("column", [0, 2, 4])
@pytest.mark.parametrize("find", [shortest_path, path_tables, forward_costs])
def test_a_column_of_infinite_costs_admits_no_path(find, column):
    cost = np.ones((4, 5), np.float32)
    cost[:, column] = INF
    with pytest.raises(PathError, match="from the left edge to the right edge"):
        find(cost, 1, 0)
