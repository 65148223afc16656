"""Two methods on the same photos: which is better, and how surely."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.evaluation.paired import ALIKE, all_paired, paired
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.skyline import Skyline
from testing.examples import examples

ERRORS = st.lists(st.floats(0, 90), min_size=1, max_size=12)


def results(errors, first="p"):
    truth = Skyline([0.0])
    return [
        PhotoResult.of(f"{first}{place:02}", Skyline([error]), truth, 100)
        for place, error in enumerate(errors)
    ]


@examples(30)
@given(ERRORS, st.data())
def test_the_other_way_round_all_is_the_other_way_round(errors, data):
    size = len(errors)
    others = data.draw(st.lists(st.floats(0, 90), min_size=size, max_size=size))
    there = paired("a", results(errors), "b", results(others))
    back = paired("b", results(others), "a", results(errors))
    assert there.difference == pytest.approx(-back.difference)
    assert (there.won, there.lost) == (back.lost, back.won)
    assert there.interval == pytest.approx((-back.interval.high, -back.interval.low), abs=1e-6)
    assert there.sure == back.sure


@examples(30)
@given(ERRORS)
def test_a_method_is_as_good_as_itself(errors):
    found = paired("a", results(errors), "a", results(errors))
    assert (found.difference, found.won, found.lost, found.sure) == (0, (), (), False)


def test_only_photos_of_both_count_and_small_differences_are_none():
    ours, theirs = results([1, 2, 9]), results([1 + ALIKE, 8, 3, 50])
    found = paired("ours", ours, "theirs", theirs)
    assert (found.photos, found.won, found.lost) == (3, ("p01",), ("p02",))
    assert "better on 1 of 3 photos, worse on 1, alike within 0.5 px on 1." in found.said
    nothing = paired("ours", ours, "theirs", results([1], first="other"))
    assert (nothing.photos, nothing.sure) == (0, False)
    assert nothing.said == "ours and theirs have no photo in common."


def test_groups_are_drawn_as_a_whole():
    ours, theirs = results([0] * 20), results([0] * 10 + [4] * 10)
    alone = paired("a", ours, "b", theirs)
    groups = {one.name: f"{place // 10}" for place, one in enumerate(ours)}
    together = paired("a", ours, "b", theirs, groups)
    assert np.ptp(together.interval) > np.ptp(alone.interval)
    assert (alone.sure, together.sure) == (True, False)


def test_the_first_is_compared_with_each_other():
    found = all_paired({"a": results([1]), "b": results([2]), "c": results([3])})
    assert [(one.method, one.other) for one in found] == [("a", "b"), ("a", "c")]
    assert all_paired({"a": results([1])}) == []
