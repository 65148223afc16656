"""Remedies: what counts as repaired and as broken, and which one is best."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.remedies import LARGER, Remedy, best, most_helpful, try_remedies
from skyline_viz.diagnosis.remedies import _broken as broken
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.skyline import Skyline
from testing.detections import WITHOUT_SKY, lines_in_the_sky


@pytest.fixture(scope="module")
def photo():
    photo = np.full((120, 300, 3), 200, np.uint8)
    photo[60:] = 60
    return photo


def test_other_methods_have_no_remedies(photo):
    found = GradientCost().detect(photo)
    truth = Skyline(rows=np.full(300, 20))
    assert try_remedies(found, truth, diagnose(found, truth)) == ()
    with pytest.raises(ValueError, match="gradient has other settings"):
        found.again(sv.DetectorConfig())
    assert most_helpful(found, truth, diagnose(found, truth)) is None


def test_nothing_is_repaired_or_broken_in_hidden_columns(photo):
    visible = np.ones(300, bool)
    visible[110:190] = False
    rows = np.full(300, 60)
    rows[100:200] -= 30
    truth = Skyline(rows=rows, visible=visible)
    found = sv.Detector().detect(photo)
    assert all(one.repaired == 0 for one in try_remedies(found, truth, diagnose(found, truth)))


def test_a_segment_that_grows_by_more_than_half_is_broken():
    assert not broken((10, 24), [(10, 19), (40, 49)])
    assert broken((10, 25), [(10, 19), (40, 49)])
    assert broken((25, 30), [(10, 19), (40, 49)])
    assert not broken((10, 39), [(10, 19), (30, 39)])


def test_the_best_remedy_comes_with_its_line_and_its_flags():
    photo, truth = lines_in_the_sky(1)
    found = WITHOUT_SKY.detect(photo)
    diagnosis = diagnose(found, truth)
    remedy, line = most_helpful(found, truth, diagnosis)
    assert remedy.change < 0
    assert remedy.a_err == pytest.approx(sv.a_err(line, truth))
    assert remedy == min(try_remedies(found, truth, diagnosis), key=lambda one: one.a_err)
    assert remedy.flags.startswith("--")


def test_pairs_and_the_larger_sky_model_are_tried_as_well():
    photo, truth = lines_in_the_sky(1)
    found = WITHOUT_SKY.detect(photo)
    tried = try_remedies(found, truth, diagnose(found, truth))
    pairs = [one.name for one in tried if one.pair]
    assert pairs
    assert all(" and " in name for name in pairs)
    assert not any(one.flags == LARGER for one in tried)  # no sky model runs
    ours = sv.Detector().detect(photo)
    tried = try_remedies(ours, truth, diagnose(ours, truth))
    (large,) = (one for one in tried if one.flags == LARGER)
    line = sv.Detector(sky=sv.SkyModel.large()).detect(photo).skyline
    assert large.a_err == pytest.approx(sv.a_err(line, truth))


def test_what_makes_it_worse_is_no_remedy():
    worse = Remedy("v 1", "--config.v 1", 0, 1, 9.0, 2.0, gross_miss=False)
    assert best([worse]) is None
    assert best([]) is None
