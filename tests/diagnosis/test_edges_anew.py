"""Edges found anew around path and truth: where, which, and what comes back with them."""

from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.edges_anew import FACTORS, _band, _edges, cost_anew
from skyline_viz.edges import find_edges
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.skyline import Skyline
from testing.detections import WITHOUT_SKY


@pytest.fixture(scope="module")
def faint():
    """A far ridge of 8 grey levels over a near one: the detector's edges have the near one only."""
    photo = np.full((200, 300, 3), 200, np.uint8)
    photo[80:] = 192
    photo[140:] = 60
    detection = WITHOUT_SKY.detect(photo)
    assert (detection.skyline.rows == 140).all()
    truth = Skyline(rows=np.full(300, 80))
    return Case(detection, truth, 4.0)


def test_the_band_lies_around_both_lines(faint):
    band = _band(faint, 50, 99)
    rows, columns = np.nonzero(band)
    assert (columns.min(), columns.max()) == (50, 99)
    assert rows.min() < 80 < 140 < rows.max() < 160
    assert band[80:141, 50:100].all()


@pytest.mark.parametrize("factor", FACTORS)
def test_edges_in_the_band_are_those_of_canny_and_all_others_stay(faint, factor):
    band = _band(faint, 50, 249)
    edges = _edges(faint.detection, band, factor)
    before = faint.detection.edges
    assert (edges == before)[~band].all()
    low, high = (factor * one for one in faint.detection.thresholds)
    canny = find_edges(faint.detection.photo, "colour", low, high)
    expected = before & canny if factor > 1 else before | canny
    assert (edges == expected)[band].all()


def test_costs_are_those_of_a_detection_with_such_edges(faint):
    low, high = (0.25 * one for one in faint.detection.thresholds)
    config = faint.detection.config.with_settings(
        {"low_threshold": low, "high_threshold": high, "fit_thresholds": False}
    )
    whole = faint.detection.again(config)
    assert whole.edges[80].all()
    np.testing.assert_allclose(cost_anew(faint, 0, 299, 0.25), whole.cost, rtol=1e-5, atol=1e-5)


def test_where_no_edge_changes_nothing_is_searched(faint):
    right = Case(faint.detection, faint.detection.skyline, 4.0)
    assert cost_anew(right, 0, 299, 0.5) is None


def test_a_photo_without_an_edge_gets_its_first_ones():
    photo = np.full((120, 200, 3), 200, np.uint8)
    photo[80:] = 180
    config = WITHOUT_SKY.config.with_settings({"fit_thresholds": False})
    detection = replace(WITHOUT_SKY, config=config).detect(photo)
    assert not detection.edges.any()
    truth = Skyline(rows=np.full(200, 80))
    (segment,) = diagnose(detection, truth).segments
    anew = {one.thresholds: one.repaired for one in segment.trials if one.thresholds != 1}
    assert anew == {0.25: 1.0}  # with half of them there is still none


def test_methods_without_thresholds_are_not_asked(faint):
    found = GradientCost().detect(faint.detection.photo)
    assert cost_anew(Case(found, faint.truth, 4.0), 0, 299, 0.5) is None
    for segment in diagnose(found, faint.truth).segments:
        assert "Canny" not in segment.evidence


def test_what_comes_back_is_a_trial_that_speaks_against_no_cause(hazy):
    (segment,) = diagnose(*hazy).segments
    anew = {trial.thresholds: trial for trial in segment.trials if trial.thresholds != 1}
    assert anew[0.25].repaired >= REPAIRED
    assert anew[0.25].changes == ()
    assert "a quarter of the Canny thresholds" in segment.evidence
    assert segment.margin > 0
