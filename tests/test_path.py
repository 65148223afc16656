"""The path search against brute force: optimum, ties, tables, margins and constraints."""

from fractions import Fraction
from itertools import pairwise, product
from math import floor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skyline_viz.constraints import Anchor, Constraints, PathError, StraightSpan
from skyline_viz.path import margins, path_tables, shortest_path

STEADY = settings(deadline=None, derandomize=True, max_examples=150)
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


def test_a_path_passes_through_its_anchors():
    cost = np.ones((30, 40), np.float32)
    anchors = (Anchor(0, 3), Anchor(20, 25), Anchor(39, 12))
    path = shortest_path(cost, 2, 0.1, Constraints(anchors=anchors))
    assert [path.rows[anchor.column] for anchor in anchors] == [3, 25, 12]
    assert np.abs(np.diff(path.rows)).max() == 2


def test_anchors_in_any_order_and_twice():
    cost = np.ones((8, 8), np.float32)
    one = Constraints(anchors=(Anchor(6, 2), Anchor(1, 5), Anchor(6, 2)))
    other = Constraints(anchors=(Anchor(1, 5), Anchor(6, 2)))
    assert np.array_equal(
        shortest_path(cost, 1, 0.5, one).rows, shortest_path(cost, 1, 0.5, other).rows
    )


def test_a_path_leaves_forbidden_pixels_alone():
    cost = np.ones((20, 30), np.float32)
    cost[10] = 0
    forbidden = np.zeros(cost.shape, bool)
    forbidden[8:, 12:18] = True
    path = shortest_path(cost, 3, 0, Constraints(forbidden=forbidden))
    assert not forbidden[path.rows, np.arange(30)].any()
    assert path.rows[[0, 29]].tolist() == [10, 10]


def test_a_straight_span_is_steeper_than_delta_only_where_it_is():
    cost = np.ones((60, 30), np.float32)
    span = StraightSpan(Anchor(10, 5), Anchor(14, 45))
    path = shortest_path(cost, 1, 0, Constraints(straight=(span,)))
    assert path.rows[10:15].tolist() == [5, 15, 25, 35, 45]
    outside = np.abs(np.diff(path.rows))
    outside[10:14] = 0
    assert outside.max() <= 1
    assert path.cost == 30


@pytest.mark.parametrize("steepness", [-7, -1, 0, 1, 3])
def test_rows_of_a_straight_span(steepness):
    span = StraightSpan(Anchor(3, 40), Anchor(8, 40 + steepness))
    assert list(zip(range(3, 9), span.rows().tolist(), strict=True)) == straight_line(span)


def test_spans_that_share_an_end():
    middle = Anchor(4, 9)
    spans = (StraightSpan(Anchor(0, 1), middle), StraightSpan(middle, Anchor(8, 5)))
    path = shortest_path(np.ones((12, 9)), 0, 0, Constraints(straight=spans))
    assert path.rows.tolist() == [1, 3, 5, 7, 9, 8, 7, 6, 5]


def test_link_costs_inside_a_straight_span():
    span = StraightSpan(Anchor(0, 0), Anchor(2, 8))
    path = shortest_path(np.ones((9, 3)), 1, 0.5, Constraints(straight=(span,)))
    assert path.cost == 3 + 8 * 0.5


def test_constraints_leave_their_inputs_alone():
    cost = np.ascontiguousarray(np.ones((9, 7), np.float32).T).T
    forbidden = np.zeros(cost.shape, bool)
    forbidden[4] = True
    asked = Constraints((Anchor(3, 2),), (StraightSpan(Anchor(4, 3), Anchor(6, 1)),), forbidden)
    shortest_path(cost, 1, 0, asked)
    path_tables(cost, 1, 0, asked)
    assert (cost == 1).all()
    assert forbidden.sum() == 7


# What is refused


@pytest.mark.parametrize("bad", [np.nan, -INF])
@pytest.mark.parametrize("find", [shortest_path, path_tables])
def test_nan_and_minus_infinity_are_refused(find, bad):
    cost = np.ones((4, 5), np.float32)
    cost[2, 3] = bad
    with pytest.raises(PathError, match="NaN or minus infinity"):
        find(cost, 1, 0)


@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (5,), (2, 3, 4)])
def test_costs_of_another_shape_are_refused(shape):
    with pytest.raises(PathError, match=r"shape \(H, W\)"):
        shortest_path(np.ones(shape), 1, 0)


@pytest.mark.parametrize(("delta", "link_weight"), [(-1, 0), (1, -0.1), (1, np.nan), (1, INF)])
def test_bad_parameters_are_refused(delta, link_weight):
    with pytest.raises(PathError, match="delta and link_weight"):
        shortest_path(np.ones((3, 3)), delta, link_weight)


@pytest.mark.parametrize("column", [0, 2, 4])
@pytest.mark.parametrize("find", [shortest_path, path_tables])
def test_a_column_of_infinite_costs_admits_no_path(find, column):
    cost = np.ones((4, 5), np.float32)
    cost[:, column] = INF
    with pytest.raises(PathError, match="from the left edge to the right edge"):
        find(cost, 1, 0)


def test_a_wall_between_anchors_is_told_with_both():
    forbidden = np.zeros((9, 20), bool)
    forbidden[:, 10] = True
    anchors = (Anchor(15, 4), Anchor(2, 4), Anchor(18, 4), Anchor(6, 5))
    with pytest.raises(PathError) as caught:
        shortest_path(np.ones((9, 20)), 3, 0, Constraints(anchors=anchors, forbidden=forbidden))
    told = str(caught.value)
    assert "from the anchor at column 6, row 5 to the anchor at column 15, row 4" in told


def test_anchors_too_steep_for_delta_are_both_named():
    anchors = tuple(Anchor(column, row) for column, row in [(0, 5), (3, 5), (6, 14), (9, 14)])
    with pytest.raises(PathError) as caught:
        shortest_path(np.ones((20, 10)), 2, 0, Constraints(anchors=anchors))
    assert "from the anchor at column 3, row 5 to the anchor at column 6, row 14" in str(
        caught.value
    )
    assert shortest_path(np.ones((20, 10)), 3, 0, Constraints(anchors=anchors)).cost == 10


@pytest.mark.parametrize(("column", "row"), [(-1, 2), (5, 2), (2, -1), (2, 4)])
def test_an_anchor_outside_is_refused(column, row):
    told = f"the anchor at column {column}, row {row} lies outside the photo of 5x4 pixels"
    with pytest.raises(PathError, match=told):
        shortest_path(np.ones((4, 5)), 1, 0, Constraints(anchors=(Anchor(column, row),)))


def test_two_anchors_in_one_column_are_both_named():
    anchors = (Anchor(2, 1), Anchor(2, 3))
    with pytest.raises(PathError) as caught:
        shortest_path(np.ones((4, 5)), 4, 0, Constraints(anchors=anchors))
    for anchor in anchors:
        assert str(anchor) in str(caught.value)


def test_an_anchor_beside_a_straight_span_is_refused_and_both_are_named():
    asked = Constraints((Anchor(3, 5),), (StraightSpan(Anchor(0, 0), Anchor(8, 8)),))
    with pytest.raises(PathError, match="column 3, row 5 and the anchor at column 0, row 0"):
        shortest_path(np.ones((9, 9)), 1, 0, asked)


def test_an_anchor_on_a_forbidden_pixel_is_refused():
    forbidden = np.zeros((4, 5), bool)
    forbidden[1, 2] = True
    asked = Constraints(anchors=(Anchor(2, 1),), forbidden=forbidden)
    with pytest.raises(PathError, match=r"column 2, row 1 lies on a forbidden pixel"):
        shortest_path(np.ones((4, 5)), 1, 0, asked)


def test_a_straight_span_over_a_forbidden_pixel_says_where():
    forbidden = np.zeros((9, 9), bool)
    forbidden[3, 3] = True
    spans = (StraightSpan(Anchor(0, 0), Anchor(8, 8)),)
    asked = Constraints(straight=spans, forbidden=forbidden)
    with pytest.raises(PathError, match="forbidden pixel, row 3 of column 3"):
        shortest_path(np.ones((9, 9)), 1, 0, asked)


@pytest.mark.parametrize("end", [3, 2])
def test_a_straight_span_ends_right_of_its_start(end):
    asked = Constraints(straight=(StraightSpan(Anchor(3, 1), Anchor(end, 1)),))
    with pytest.raises(PathError, match="right of its start, the anchor at column 3, row 1"):
        shortest_path(np.ones((4, 5)), 1, 0, asked)


def test_forbidden_pixels_of_another_photo_are_refused():
    asked = Constraints(forbidden=np.zeros((5, 4), bool))
    with pytest.raises(PathError, match=r"forbidden has the shape \(5, 4\).*\(4, 5\)"):
        shortest_path(np.ones((4, 5)), 1, 0, asked)


def test_anchors_are_sorted_by_column():
    points = [Anchor(4, 0), Anchor(1, 9), Anchor(1, 2)]
    assert sorted(points) == [Anchor(1, 2), Anchor(1, 9), Anchor(4, 0)]
    assert all(one < other for one, other in pairwise(sorted(points)))
