"""Diagnoses: of failures whose cause is known, and what they are made of."""

import csv
import json
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz import entities
from skyline_viz.causes import CAUSES
from skyline_viz.cli import main
from skyline_viz.cost_split import split_cost
from skyline_viz.counterfactual import Case
from skyline_viz.diagnosis import REPAIRED, diagnose, failing_runs
from skyline_viz.diagnosis_recording import log_diagnosis
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline, SkylineError
from tests.injected import MAKERS, cases, main_cause
from tests.recordings import Read, verify

EACH = 6
SAMPLES = str(Path(__file__).resolve().parents[1] / "sample_data")


@pytest.fixture(scope="module")
def hazy():
    scene = render("hazy", 1)
    return sv.Detector().detect(scene.photo), scene.truth


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
    near = np.abs(rows[first - start : last + 1 - start] - one.truth.rows[first : last + 1])
    assert (near <= 4).mean() == pytest.approx(trial.repaired)
    assert trial.columns > 0
    assert segment.evidence.endswith(".")


def test_a_right_detection_is_said_to_be_right():
    scene = render("clear", 2)
    detection = sv.Detector().detect(scene.photo)
    diagnosis = diagnose(detection, detection.skyline)
    assert diagnosis.right
    assert diagnosis.main is None
    assert "Right: no column is off by more than" in diagnosis.markdown("clear-2")


def test_the_parts_of_a_cost_add_up_to_the_whole(hazy):
    detection, truth = hazy
    split = split_cost(detection, detection.skyline.rows.astype(np.int32))
    whole = sum(split.totals(0, truth.width - 1).values())
    assert whole == pytest.approx(detection.path_cost, rel=1e-5)
    other = split_cost(detection, truth.rows.astype(np.int32))
    assert sum(other.totals(0, truth.width - 1).values()) > whole
    assert (np.abs(split.stages["score"]) <= 1).all()


def test_without_any_change_the_search_gives_the_path_back(hazy):
    detection, truth = hazy
    start, rows = Case(detection, truth, 4.0).search((), 100, 300)
    assert start == 0
    np.testing.assert_array_equal(rows, detection.skyline.rows)


def test_columns_that_are_not_visible_are_not_diagnosed(hazy):
    detection, truth = hazy
    hidden = Skyline(rows=truth.rows, visible=np.arange(truth.width) < 100)
    (segment,) = diagnose(detection, hidden).segments
    assert segment.columns[1] < 100


def test_a_few_right_columns_do_not_end_a_segment():
    wrong = np.zeros(30, bool)
    wrong[[3, 4, 9, 20]] = True
    assert failing_runs(wrong) == [(3, 9), (20, 20)]
    assert failing_runs(wrong & False) == []


def test_a_truth_of_another_width_is_refused(hazy):
    detection, truth = hazy
    with pytest.raises(SkylineError, match="960 columns wide, the truth 959"):
        diagnose(detection, Skyline(rows=truth.rows[:-1]))


def test_tolerances_grow_with_the_photo(hazy):
    detection, truth = hazy
    assert diagnose(detection, truth).tolerance == pytest.approx(4 * 540 / 519)
    assert diagnose(detection, truth, 200).right


def test_the_command_tells_causes_and_remedies(tmp_path, capsys):
    words = ["diagnose", SAMPLES, "--out", str(tmp_path), "--workers", "2"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert "sample_data: 12 photos" in out
    assert "share of their error" in out
    assert "What would help, tried on all photos" in out
    assert "half the Canny thresholds" in out
    with (tmp_path / "segments.csv").open() as file:
        segments = list(csv.DictReader(file))
    assert {one["cause"] for one in segments} <= set(CAUSES)
    document = json.loads((tmp_path / "diagnosis.json").read_text())
    told = {photo["name"]: photo for photo in document["photos"]}
    assert len(told) == 12
    assert sum(len(photo["segments"]) for photo in told.values()) == len(segments)
    assert told["hazy-1"]["segments"][0]["columns"] == [0, 959]
    assert len(told["hazy-1"]["remedies"]) == 7


def test_the_command_tells_one_photo_in_full(capsys):
    assert main(["diagnose", SAMPLES, "--photo", "hazy-1"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("hazy-1  A_err 132.88 px")
    assert "the truth costs more than the path by: score" in out
    assert main(["diagnose", SAMPLES, "--photo", "nobody"]) == 2
    assert "has no photo nobody" in capsys.readouterr().err
    assert main(["diagnose", SAMPLES, "--tolerance", "-1"]) == 2
    assert main(["diagnose", SAMPLES, "--folds", "2", "--bank", "x.npz"]) == 2


def test_the_viewer_gets_frames_lines_and_reasons(tmp_path):
    (one,) = cases("too steep", 1)
    diagnosis = diagnose(one.detection, one.truth)
    with sv.new_recording(tmp_path / "d.rrd", "d") as recording:
        log_diagnosis(recording, diagnosis, one.detection, one.truth, "tower")
    verify(tmp_path / "d.rrd")
    read = Read(tmp_path / "d.rrd")
    words = read.last(entities.DIAGNOSIS, "TextDocument:text").as_py()[0]
    assert words.startswith("**tower**")
    assert "too steep" in words
    strips = read.last(entities.COUNTERFACTUAL, "LineStrips2D:strips").as_py()
    repaired = [one for one in diagnosis.segments if one.cause != "truth doubtful"]
    assert len(strips) == len(repaired)
    labels = read.last(f"{entities.SEGMENTS}/largest", "Boxes2D:labels").as_py()
    assert diagnosis.main.cause in labels
    assert diagnosis.causes[0] == diagnosis.main.cause
    assert sorted(diagnosis.causes) == sorted({one.cause for one in diagnosis.segments})
    assert read.array(entities.STACKED_COSTS, "Image:buffer").size > 10_000
