"""What a report shows of a photo."""

import pickle

import numpy as np
import pytest

from skyline_viz.evaluation.metrics import a_err
from skyline_viz.reports import photo_report
from testing import detections


def test_a_lost_photo_has_its_lines_its_cause_and_the_remedy_that_helps_most(hazy):
    detection, truth = detections.hazy()
    assert hazy.a_err == pytest.approx(a_err(detection.skyline, truth))
    assert hazy.path and hazy.truth and hazy.mended
    assert hazy.segments[0] is hazy.diagnosed.diagnosis.main
    assert hazy.remedy.a_err == min(one.a_err for one in hazy.diagnosed.remedies)
    assert hazy.helping[0] is hazy.remedy
    assert all(one.change < 0 for one in hazy.helping)
    assert hazy.result.name == "hazy"


def test_a_photo_that_is_right_needs_no_remedy(flat):
    assert flat.a_err == 0
    assert (flat.remedy, flat.mended, flat.helping, flat.segments) == (None, "", [], ())


def test_a_photo_without_a_truth_has_its_path_alone(blind):
    assert blind.path
    assert (blind.a_err, blind.truth, blind.result, blind.diagnosed) == (None, "", None, None)


def test_a_truth_that_is_visible_nowhere_is_none():
    truth = detections.flat_truth([], 0, visible=np.zeros(300, bool))
    assert photo_report("a", detections.flat(), truth).a_err is None


def test_it_comes_back_from_another_process_as_it_was(hazy):
    again = pickle.loads(pickle.dumps(hazy))
    assert again.photo == hazy.photo
    assert again.plots == hazy.plots
    assert again.without_stages().stages == ()
