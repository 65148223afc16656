"""Anchors, straight spans and forbidden pixels: what they do, and what is refused by name."""

from fractions import Fraction
from itertools import pairwise
from math import floor

import numpy as np
import pytest

from skyline_viz.constraints import (
    Anchor,
    Constraints,
    PathError,
    StraightSpan,
    apply_constraints,
    find_conflict,
)
from skyline_viz.path import path_tables, shortest_path


def test_constraints_become_costs_and_reach():
    columns = np.arange(15, dtype=np.float32).reshape(5, 3)
    reach = np.ones(4, np.int32)
    forbidden = np.zeros((3, 5), bool)
    forbidden[2, 4] = True
    asked = Constraints((Anchor(3, 1),), (StraightSpan(Anchor(0, 0), Anchor(1, 2)),), forbidden)
    found, reached = apply_constraints(columns, reach, asked)
    inf = np.inf
    assert found.tolist() == [
        [0, inf, inf],
        [inf, inf, 5],
        [6, 7, 8],
        [inf, 10, inf],
        [12, 13, inf],
    ]
    assert reached.tolist() == [2, 1, 1, 1]
    assert np.array_equal(columns.ravel(), np.arange(15))
    assert reach.tolist() == [1] * 4


def test_no_constraint_changes_nothing():
    columns, reach = np.ones((5, 3), np.float32), np.ones(4, np.int32)
    found, reached = apply_constraints(columns, reach, Constraints())
    assert np.array_equal(found, columns)
    assert np.array_equal(reached, reach)


@pytest.mark.parametrize(
    ("dead", "told"),
    [
        (0, "from the left edge to the anchor at column 2, row 1 "),
        (3, "from the anchor at column 2, row 1 to the anchor at column 5, row 0 "),
        (5, "from the anchor at column 2, row 1 to the anchor at column 5, row 0 "),
        (6, "from the anchor at column 5, row 0 to the anchor at column 9, row 3 "),
        (11, "from the anchor at column 9, row 3 to the right edge "),
    ],
)
def test_a_conflict_names_the_nearest_anchors(dead, told):
    spans = (StraightSpan(Anchor(5, 0), Anchor(9, 3)),)
    assert told in find_conflict(dead, Constraints((Anchor(2, 1),), spans))


@pytest.mark.parametrize("start", range(0, 40, 3))
@pytest.mark.parametrize("columns", [1, 2, 3, 7, 12])
def test_straight_lines_stay_within_half_a_pixel(start, columns):
    span = StraightSpan(Anchor(4, start), Anchor(4 + columns, 20))
    slope = (20 - start) / columns
    exact = start + slope * np.arange(columns + 1)
    rows = span.rows()
    assert (rows[0], rows[-1]) == (start, 20)
    assert np.abs(rows - exact).max() <= 0.5 + 1e-9


def straight_line(span):
    """Column and row of each pixel of a span; halves are rounded down the image."""
    start, end = span.start, span.end
    slope = Fraction(end.row - start.row, end.column - start.column)
    return [
        (column, floor(start.row + slope * (column - start.column) + Fraction(1, 2)))
        for column in range(start.column, end.column + 1)
    ]


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


@pytest.mark.parametrize("last", [4, 5, 7, 8])
@pytest.mark.parametrize("steepness", [-7, -1, 0, 1, 3])
def test_rows_of_a_straight_span(steepness, last):
    span = StraightSpan(Anchor(3, 40), Anchor(last, 40 + steepness))
    found = zip(range(3, last + 1), span.rows().tolist(), strict=True)
    assert list(found) == straight_line(span)


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
    with pytest.raises(PathError, match=r"column 2, row 1 asks for a forbidden pixel"):
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
    with pytest.raises(PathError, match=r"forbidden is a bool array \(4, 5\).* not bool \(5, 4\)"):
        shortest_path(np.ones((4, 5)), 1, 0, asked)


def test_forbidden_pixels_that_are_numbers_are_refused():
    asked = Constraints(forbidden=np.zeros((4, 5), np.uint8))
    with pytest.raises(PathError, match=r"forbidden is a bool array .* not uint8"):
        shortest_path(np.ones((4, 5)), 1, 0, asked)


@pytest.mark.parametrize("anchor", [Anchor(1.5, 1), Anchor(1, 0.5), Anchor(np.nan, 1)])
def test_anchors_lie_on_whole_pixels(anchor):
    with pytest.raises(PathError, match="does not lie on a whole row and column"):
        shortest_path(np.ones((4, 5)), 1, 0, Constraints(anchors=(anchor,)))


def test_whole_number_costs_take_constraints():
    path = shortest_path(np.ones((4, 5), np.int32), 1, 0, Constraints(anchors=(Anchor(2.0, 3.0),)))
    assert path.rows[2] == 3
    assert path.cost == 5


def test_anchors_are_sorted_by_column():
    points = [Anchor(4, 0), Anchor(1, 9), Anchor(1, 2)]
    assert sorted(points) == [Anchor(1, 2), Anchor(1, 9), Anchor(4, 0)]
    assert all(one < other for one, other in pairwise(sorted(points)))
