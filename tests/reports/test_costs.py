"""Plots along the columns: what both lines pay, and where they are off."""

import numpy as np
import pytest

from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.reports.costs import averaged, cost_plots
from testing import detections


def test_the_plots_say_what_the_diagnosis_sums_up():
    detection, truth = detections.hazy()
    plots = {one.name: one for one in cost_plots(detection, truth, 4.0)}
    case = Case(detection, truth, 4.0)
    error = float(np.nanmean(case.errors))
    assert plots["error"].said.startswith(f"{error:.1f} px in the mean")
    assert truth.visible.all()
    for name, costs in case.due.terms.items():
        if name in plots:
            path = case.paid(case.path_rows).terms[name].sum()
            assert plots[name].said == f"path {path:.1f}, truth {costs.sum():.1f}"


def test_what_nobody_pays_for_is_not_drawn_and_without_a_truth_there_is_one_line():
    detection = detections.flat()
    plots = cost_plots(detection, None, 4.0)
    assert plots
    assert all(one.path and not one.truth for one in plots)
    names = {one.name for one in plots}
    assert "no edge" not in names  # the line runs on an edge everywhere
    assert "error" not in names


def test_a_truth_leaves_a_gap_where_it_is_not_visible():
    detection = detections.flat()
    visible = np.ones(300, bool)
    visible[100:200] = False
    plots = cost_plots(detection, detections.flat_truth([], 0, visible), 4.0)
    drawn = [one for one in plots if one.name != "error"]
    assert drawn
    assert all(one.truth.count("M") == 2 and one.path.count("M") == 1 for one in drawn)


@pytest.mark.parametrize("width", [5, 320, 321, 4032])
def test_means_keep_the_mean(width):
    values = np.random.default_rng(width).uniform(0, 9, width)
    means = averaged(values)
    assert len(means) <= 320
    assert values.min() <= means.min()
    assert means.max() <= values.max()
    assert means.mean() == pytest.approx(values.mean(), rel=0.05)
    assert np.isnan(averaged(np.full(width, np.nan))).all()
