from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.evaluation.metrics import SEGMENT_GAP, wrong_segments
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.skyline import Skyline, SkylineError


def test_a_detection_with_a_truth():
    truth = Skyline(np.full(200, 50.0))
    rows = np.full(200, 50.0)
    rows[20:30] = 70
    rows[120] = 90
    margins = np.linspace(1, 3, 200)
    verdict = Verdict.of(Skyline(rows), margins, 100, truth)
    assert verdict.a_err == pytest.approx((10 * 20 + 40) / 200)
    assert (verdict.worst_column, verdict.worst_error) == (120, 40)
    assert verdict.segments == ((20, 29), (120, 120))
    assert verdict.gross_miss is False
    assert verdict.unsure_column == 0
    assert 1 <= verdict.margin < 1.2


@pytest.mark.parametrize("truth", [None, Skyline(np.zeros(4), np.zeros(4, bool))])
def test_without_a_visible_truth_there_are_no_errors(truth):
    verdict = Verdict.of(Skyline(np.zeros(4)), np.array([3.0, 1, np.inf, 2]), 10, truth)
    assert (verdict.a_err, verdict.worst_error, verdict.segments) == (None, None, None)
    assert (verdict.margin, verdict.unsure_column) == (1, 1)


def test_a_gross_miss():
    verdict = Verdict.of(Skyline(np.zeros(4)), np.ones(4), 10, Skyline(np.ones(4)))
    assert verdict.gross_miss is True


def test_a_truth_of_another_width_is_refused():
    with pytest.raises(SkylineError, match="columns"):
        Verdict.of(Skyline(np.zeros(4)), np.ones(4), 10, Skyline(np.zeros(5)))


@given(st.lists(st.sampled_from([0.0, 9.0, np.nan]), min_size=1, max_size=60))
def test_segments_hold_every_wrong_column_and_lie_apart(errors):
    segments = wrong_segments(np.array(errors), height=100)
    wrong = {column for column, error in enumerate(errors) if error > 4}
    held = {column for first, last in segments for column in range(first, last + 1)}
    assert wrong <= held
    for first, last in segments:
        assert {first, last} <= wrong
    for (_, last), (first, _) in pairwise(segments):
        assert first - last > SEGMENT_GAP + 1
