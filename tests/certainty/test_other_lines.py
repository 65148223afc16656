"""Lines along other ridges."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.certainty.other_lines import OtherLine, beside, other_lines, unlike
from skyline_viz.constraints import Anchor, Constraints
from skyline_viz.detector import Detector
from skyline_viz.path import shortest_path
from testing.examples import examples
from testing.labelling import hills

DELTA, LINK = 3, 0.1


def apart(one, other, height):
    return (np.abs(one - other) > max(5, height // 50)).mean()


@examples(40)
@given(st.integers(0, 40), st.integers(0, 2))
def test_lines_lie_apart_are_valid_and_cost_what_they_say(seed, anchors):
    chance = np.random.default_rng(seed)
    cost = chance.random((60, 50)).astype(np.float32)
    fixed = Constraints(tuple(Anchor(20 * at, int(chance.integers(60))) for at in range(anchors)))
    first = shortest_path(cost, DELTA, LINK, fixed)
    found = other_lines(cost, DELTA, LINK, first.rows, fixed)
    assert len(found) <= 4
    detours = [one.detour for one in found]
    assert detours == sorted(detours)
    for one in found:
        assert (np.abs(np.diff(one.rows)) <= DELTA).all()
        assert all(one.rows[anchor.column] == anchor.row for anchor in fixed.anchors)
        paid = cost[one.rows, np.arange(50)].sum() + LINK * np.abs(np.diff(one.rows)).sum()
        assert one.detour == pytest.approx(paid - first.cost, abs=1e-3)
        assert one.apart == apart(one.rows, first.rows, 60)
    for one, other in combinations([first.rows, *(one.rows for one in found)], 2):
        assert apart(one, other, 60) >= 0.2


def test_the_other_ridge_is_found_and_says_what_it_pays():
    photo = hills(3, 120, 160)
    detection = Detector().detect(photo)
    rows = detection.skyline.rows.astype(np.int32)
    found = other_lines(detection.cost, detection.delta, detection.link_weight, rows)
    lower = 120 * 0.62
    assert any(np.abs(one.rows - lower).mean() < 120 / 8 for one in found)
    for one in found:
        paid = one.paid(detection.cost_model)
        assert sum(paid.values()) == pytest.approx(detection.path_cost + one.detour, rel=1e-4)


def test_where_all_is_fixed_there_is_no_other_line():
    cost = np.ones((9, 4), np.float32)
    fixed = Constraints(tuple(Anchor(column, 3) for column in range(4)))
    assert other_lines(cost, 1, 0.1, np.full(4, 3), fixed) == []


def test_lines_from_elsewhere_pay_the_costs_of_the_first_and_keep_to_what_is_allowed():
    cost = np.ones((90, 40), np.float32)
    cost[20], cost[70, 5] = 0.5, np.inf
    first, higher, forbidden = (np.full(40, row, np.int32) for row in (20, 10, 70))
    (told,) = beside(cost, 0.1, first, [higher, forbidden])
    assert (told.detour, told.apart) == (20, 1)
    assert beside(cost, 0.1, higher, [first])[0].detour == 0  # cheaper, and not less than nothing


def test_of_lines_along_one_ridge_the_first_is_taken():
    lines = [OtherLine(np.full(40, row, np.int32), 1.0, 1.0) for row in (20, 21, 60, 80, 40)]
    near = OtherLine(np.full(40, 3, np.int32), 1.0, 0.1)
    taken = unlike([near, *lines], 90, 3)
    assert [int(one.rows[0]) for one in taken] == [20, 60, 80]
