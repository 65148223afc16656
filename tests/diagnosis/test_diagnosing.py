"""Diagnoses: of failures whose cause is known, and what they are made of."""

import json
from collections import Counter

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.diagnosis.counterfactual import REPAIRED
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline, SkylineError
from testing import SAMPLES
from testing.detections import WITHOUT_SKY, flat_truth, lines_in_the_sky, write_dataset
from testing.injected import MAKERS, cases, main_cause

EACH = 6


@pytest.mark.parametrize("cause", MAKERS)
def test_a_failure_that_was_made_on_purpose_is_told_from_others(cause):
    said = Counter(main_cause(one).cause for one in cases(cause, EACH))
    assert said[cause] >= EACH - 1, said


@pytest.mark.parametrize("cause", sorted(set(MAKERS) - {"truth doubtful", "cheaper path"}))
def test_a_cause_stands_on_a_counterfactual(cause):
    (one,) = cases(cause, 1)
    segment = main_cause(one)
    chosen = {segment.cause, *segment.contributing}
    trial = next(trial for trial in segment.trials if set(trial.changes) == chosen)
    assert trial.repaired >= REPAIRED
    start, rows = segment.line
    first, last = segment.columns
    part = slice(first, last + 1)
    near = np.abs(rows[first - start : last + 1 - start] - one.truth.rows[part]) <= 4
    wrong = np.abs(one.detection.skyline.rows[part] - one.truth.rows[part]) > 4
    assert near[wrong].mean() == pytest.approx(trial.repaired)
    assert trial == segment.proof
    assert trial.columns > 0
    assert segment.evidence.endswith(".")


def test_a_cheaper_path_names_the_terms_that_prefer_it():
    photo, truth = lines_in_the_sky(3)
    (segment,) = diagnose(WITHOUT_SKY.detect(photo), truth).segments
    assert (segment.cause, segment.terms) == ("cheaper path", ("strength", "clear sky"))
    assert segment.title == "cheaper path by strength, cloud above"
    assert "no more for strength and clear sky than the path, 100% of" in segment.evidence
    proof = segment.proof
    assert (proof.changes, proof.terms) == (("cheaper path",), segment.terms)
    alone = [one for one in segment.trials if len(one.terms) == 1]
    assert all(one.repaired < REPAIRED for one in alone)  # it takes both
    against = [one.repaired for one in segment.trials if "cheaper path" not in one.changes]
    assert segment.margin == pytest.approx(proof.repaired - max(against, default=0))


def test_a_whole_photo_lost_in_haze_is_lost_for_want_of_edges(hazy):
    detection, truth = hazy
    (segment,) = diagnose(detection, truth).segments
    assert segment.title == "cheaper path by no edge, haze"
    assert segment.contributing == ()
    document = diagnose(detection, truth).document()
    (last,) = (one for one in document["segments"][0]["trials"] if one["terms"])
    assert (last["terms"], last["lines"]) == (("no edge",), 1)


def test_what_nothing_brings_back_is_said_to_be_unproved(hazy, monkeypatch):
    detection, truth = hazy
    monkeypatch.setattr("skyline_viz.diagnosis.trials.REPAIRED", 2)
    (segment,) = diagnose(detection, truth).segments
    assert segment.cause == "cheaper path"
    assert segment.proof is None
    assert (segment.contributing, segment.terms, segment.margin) == ((), (), 0)
    assert "Nothing that was tried brings it back" in segment.evidence
    start, rows = segment.line
    np.testing.assert_array_equal(rows, detection.skyline.rows[start : start + len(rows)])


def test_hidden_columns_do_not_count_in_the_error(flat):
    visible = np.ones(300, bool)
    visible[102:108] = False
    visible[104] = True
    (segment,) = diagnose(flat, flat_truth(slice(100, 110), 20, visible)).segments
    assert segment.columns == (100, 109)
    assert segment.total_error == pytest.approx(5 * segment.mean_error)


def test_a_margin_is_what_the_best_other_trial_leaves():
    for cause in MAKERS:
        one = next(cases(cause, EACH))
        segment = main_cause(one)
        others = (trial for trial in segment.trials if trial.thresholds == 1)
        against = [trial.repaired for trial in others if segment.cause not in trial.changes]
        left = segment.proof.repaired - max(against, default=0)
        assert segment.margin == pytest.approx(max(left, 0))


def test_a_truth_that_is_visible_nowhere_is_refused(flat, tmp_path, capsys):
    nowhere = np.zeros(300, bool)
    with pytest.raises(SkylineError, match="the truth is visible nowhere"):
        diagnose(flat, flat_truth([], 0, nowhere))
    write_dataset(tmp_path / "d", flat, flat_truth([], 0, nowhere))
    assert main(["diagnose", str(tmp_path / "d"), "--out", str(tmp_path / "o")]) == 1
    assert "a: the truth is visible nowhere." in capsys.readouterr().err
    document = json.loads((tmp_path / "o" / "diagnosis.json").read_text())
    assert document["photos"] == []


@pytest.mark.parametrize("tolerance", ["nan", "inf", "-1"])
def test_a_tolerance_that_is_none_is_refused(tolerance, flat, capsys):
    with pytest.raises(ValueError, match="a tolerance is a number of pixels, 0 or more, not"):
        diagnose(flat, flat_truth([], 0), float(tolerance))
    assert main(["diagnose", str(SAMPLES), "--tolerance", tolerance]) == 2
    assert f"0 or more, not {tolerance}." in capsys.readouterr().err


def test_a_right_detection_is_said_to_be_right():
    scene = render("clear", 2)
    detection = sv.Detector().detect(scene.photo)
    diagnosis = diagnose(detection, detection.skyline)
    assert diagnosis.right
    assert diagnosis.main is None
    assert "Right: no column is off by more than" in diagnosis.markdown("clear-2")


def test_columns_that_are_not_visible_are_not_diagnosed(hazy):
    detection, truth = hazy
    hidden = Skyline(rows=truth.rows, visible=np.arange(truth.width) < 100)
    (segment,) = diagnose(detection, hidden).segments
    assert segment.columns[1] < 100


def test_a_truth_of_another_width_is_refused(hazy):
    detection, truth = hazy
    with pytest.raises(SkylineError, match="960 columns wide, the truth 959"):
        diagnose(detection, Skyline(rows=truth.rows[:-1]))


def test_tolerances_grow_with_the_photo(hazy):
    detection, truth = hazy
    assert diagnose(detection, truth).tolerance == pytest.approx(4 * 540 / 519)
    assert diagnose(detection, truth, 540).right  # no line is farther off than the photo is high


def test_the_report_begins_with_the_largest_total_error(flat):
    truth = flat_truth([*range(20, 24), *range(100, 160)], 30)
    diagnosis = diagnose(flat, truth)
    assert [one.columns for one in diagnosis.segments] == [(20, 23), (100, 159)]
    words = diagnosis.markdown()
    assert words.index("columns 100 to 159") < words.index("columns 20 to 23")


def test_a_truth_that_climbs_wildly_gets_fewer_tries(flat):
    rows = np.random.default_rng(0).integers(0, 120, 300)
    (segment, *_) = diagnose(flat, Skyline(rows=rows)).by_error
    steep = [one for one in segment.trials if {"cheaper path", "too steep"} <= set(one.changes)]
    assert steep
    assert max(one.lines for one in steep) < 8
