"""Diagnoses: of failures whose cause is known, and what they are made of."""

import csv
import json
import re
from collections import Counter
from dataclasses import replace

import cv2
import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.diagnosis.causes import CAUSES
from skyline_viz.diagnosis.counterfactual import REPAIRED, Case
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.report import Diagnosed, write_csv
from skyline_viz.rendering import render
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.viewer import entities
from skyline_viz.viewer.diagnosis_recording import log_diagnosis
from testing import SAMPLES
from testing.injected import MAKERS, cases, main_cause
from testing.recordings import Read, verify

EACH = 6


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
    part = slice(first, last + 1)
    near = np.abs(rows[first - start : last + 1 - start] - one.truth.rows[part]) <= 4
    wrong = np.abs(one.detection.skyline.rows[part] - one.truth.rows[part]) > 4
    assert near[wrong].mean() == pytest.approx(trial.repaired)
    assert trial == segment.proof
    assert trial.columns > 0
    assert segment.evidence.endswith(".")


@pytest.fixture(scope="module")
def flat():
    """A photo with a level ridge in row 60, and its detection, which is right."""
    photo = np.full((120, 300, 3), 200, np.uint8)
    photo[60:] = 60
    return sv.Detector().detect(photo)


def flat_truth(wrong, by, visible=None):
    """The ridge, off in some columns."""
    rows = np.full(300, 60.0)
    rows[wrong] -= by
    return Skyline(rows=rows, visible=np.ones(300, bool) if visible is None else visible)


def lines_in_the_sky(count):
    """A ridge that fades, and lines above it, the strongest one uppermost."""
    photo = np.full((160, 300, 3), 215, np.uint8)
    photo[120:] = 60
    photo[120:, 80:220] = 165
    for number in range(count):
        row = 30 + 22 * number
        photo[row : row + 8, 60:240] = 20 + 8 * number
        for side in (range(40, 60), range(240, 260)):  # the way there, in steps of a few rows
            for at, column in enumerate(side):
                way = (20 - at if column < 150 else at + 1) / 20
                top = int(row + (110 - row) * way)
                photo[top : top + 8, column] = 20 + 8 * number
    return photo, Skyline(rows=np.full(300, 120.0))


def test_as_many_lines_are_taken_away_as_are_cheaper():
    photo, truth = lines_in_the_sky(3)
    (segment,) = diagnose(sv.Detector().detect(photo), truth).segments
    assert segment.cause == "cheaper path"
    last = segment.trials[-1]
    assert last.changes == ("cheaper path", *segment.contributing)
    assert last == segment.proof
    assert 2 <= last.lines <= 8
    assert f"Without the {last.lines} lines that are cheaper" in segment.evidence
    assert segment.margin == pytest.approx(
        last.repaired
        - max(one.repaired for one in segment.trials if "cheaper path" not in one.changes)
    )


def test_a_whole_photo_lost_to_other_lines_is_proved_with_the_truth_made_right(hazy):
    detection, truth = hazy
    (segment,) = diagnose(detection, truth).segments
    assert (segment.cause, segment.contributing) == ("cheaper path", ("missed edge", "too steep"))
    assert segment.proof is not None
    assert segment.proof.lines > 1
    document = diagnose(detection, truth).document()
    assert document["segments"][0]["trials"][-1]["lines"] == segment.proof.lines


def test_what_nothing_brings_back_is_said_to_be_unproved(hazy, monkeypatch):
    detection, truth = hazy
    monkeypatch.setattr("skyline_viz.diagnosis.diagnosing._MOST_LINES", 1)
    (segment,) = diagnose(detection, truth).segments
    assert segment.cause == "cheaper path"
    assert segment.proof is None
    assert (segment.contributing, segment.margin) == ((), 0)
    assert "Nothing that was tried brings it back" in segment.evidence
    start, rows = segment.line
    np.testing.assert_array_equal(rows, detection.skyline.rows[start : start + len(rows)])


def test_columns_that_were_never_wrong_are_not_repaired(flat):
    truth = flat_truth(slice(100, 200, 6), 8)
    case = Case(flat, truth, 4.0)
    assert case.repaired(0, flat.skyline.rows.astype(int), 100, 196) == 0
    assert case.repaired(0, truth.rows.astype(int), 100, 196) == 1


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
        against = [trial.repaired for trial in segment.trials if segment.cause not in trial.changes]
        left = segment.proof.repaired - max(against, default=0)
        assert segment.margin == pytest.approx(max(left, 0))


def test_without_delta_a_step_of_one_row_is_too_steep():
    photo = np.full((120, 300, 3), 200, np.uint8)
    rows = 60 + np.arange(300) // 12
    for column, row in enumerate(rows):
        photo[row:, column] = 60
    detector = sv.Detector(config=replace(sv.DetectorConfig(), delta=0))
    truth = Skyline(rows=rows)
    detection = detector.detect(photo)
    assert Case(detection, truth, 4.0).columns_of("too steep", 0, 299).any()
    said = {one.cause for one in diagnose(detection, truth).segments}
    assert "too steep" in said
    default = Case(sv.Detector().detect(photo), truth, 4.0)
    assert not default.columns_of("too steep", 0, 299).any()


def test_evidence_says_which_columns_it_counts(flat):
    (one,) = cases("missed edge", 1)
    segment = main_cause(one)
    case = Case(one.detection, one.truth, 4.0)
    reach = case.excursion(*segment.columns)
    assert reach != segment.columns
    assert segment.evidence.startswith(
        f"Between columns {reach[0]} and {reach[1]}, where the path leaves the truth, the truth "
    )


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


def write_dataset(folder, detection, truth):
    """A plain data set of one photo, a."""
    for name in ("images", "masks"):
        (folder / name).mkdir(parents=True)
    cv2.imwrite(str(folder / "images" / "a.png"), detection.photo[..., ::-1])
    truth.write_csv(folder / "masks" / "a.csv")


def test_where_all_is_right_nothing_has_to_help(flat, tmp_path, capsys):
    write_dataset(tmp_path, flat, flat_truth([], 0))
    assert main(["diagnose", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert out.endswith("All are right: no column is off by more than the tolerance.\n")


def test_where_nothing_helps_it_is_said(flat, tmp_path, capsys):
    write_dataset(tmp_path, flat, flat_truth(slice(100, 200), 30))
    assert main(["diagnose", str(tmp_path)]) == 0
    assert "None of these helps" in capsys.readouterr().out


def test_contributing_causes_are_kept_apart(hazy, tmp_path):
    detection, truth = hazy
    one = Diagnosed("hazy-1", 1.0, diagnose(detection, truth), ())
    write_csv(tmp_path / "s.csv", [one])
    with (tmp_path / "s.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert row["contributing"] == "missed edge; too steep"
    assert float(row["total_error"]) == pytest.approx(one.diagnosis.main.total_error, abs=1e-3)


def test_a_right_detection_is_said_to_be_right():
    scene = render("clear", 2)
    detection = sv.Detector().detect(scene.photo)
    diagnosis = diagnose(detection, detection.skyline)
    assert diagnosis.right
    assert diagnosis.main is None
    assert "Right: no column is off by more than" in diagnosis.markdown("clear-2")


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


def test_a_truth_of_another_width_is_refused(hazy):
    detection, truth = hazy
    with pytest.raises(SkylineError, match="960 columns wide, the truth 959"):
        diagnose(detection, Skyline(rows=truth.rows[:-1]))


def test_tolerances_grow_with_the_photo(hazy):
    detection, truth = hazy
    assert diagnose(detection, truth).tolerance == pytest.approx(4 * 540 / 519)
    assert diagnose(detection, truth, 200).right


def test_the_command_tells_causes_and_remedies(tmp_path, capsys):
    words = ["diagnose", str(SAMPLES), "--out", str(tmp_path), "--workers", "2"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert "sample_data: 12 photos" in out
    assert "share of their error" in out
    assert "What would help, tried on all photos" in out
    assert "half the Canny thresholds" in out
    assert re.search(
        r"edges of the grey photo \(--config.edge-source grey\) .* [+-]\d+\.\d\d px", out
    )
    with (tmp_path / "segments.csv").open() as file:
        segments = list(csv.DictReader(file))
    assert {one["cause"] for one in segments} <= set(CAUSES)
    document = json.loads((tmp_path / "diagnosis.json").read_text())
    told = {photo["name"]: photo for photo in document["photos"]}
    assert len(told) == 12
    assert sum(len(photo["segments"]) for photo in told.values()) == len(segments)
    assert told["hazy-1"]["segments"][0]["columns"] == [0, 959]
    assert len(told["hazy-1"]["remedies"]) == 13


def test_one_photo_leaves_the_report_of_the_data_set(tmp_path, capsys):
    (tmp_path / "diagnosis.json").write_text("all")
    assert main(["diagnose", str(SAMPLES), "--photo", "hazy-1", "--out", str(tmp_path)]) == 0
    assert f"hazy-1.json and hazy-1.md in {tmp_path}" in capsys.readouterr().out
    assert (tmp_path / "diagnosis.json").read_text() == "all"
    assert not (tmp_path / "segments.csv").exists()
    document = json.loads((tmp_path / "hazy-1.json").read_text())
    assert [photo["name"] for photo in document["photos"]] == ["hazy-1"]
    assert (tmp_path / "hazy-1.md").read_text().startswith("**hazy-1**")


def test_the_command_tells_one_photo_in_full(capsys):
    assert main(["diagnose", str(SAMPLES), "--photo", "hazy-1"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("hazy-1  A_err 132.88 px")
    assert "the truth costs more than the path by: score" in out
    assert main(["diagnose", str(SAMPLES), "--photo", "nobody"]) == 2
    assert "has no photo nobody" in capsys.readouterr().err
    assert main(["diagnose", str(SAMPLES), "--tolerance", "-1"]) == 2
    assert main(["diagnose", str(SAMPLES), "--folds", "2", "--bank", "x.npz"]) == 2


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
    repaired = [one for one in diagnosis.segments if one.cause != "truth doubtful" and one.proof]
    assert len(strips) == len(repaired)
    labels = read.last(f"{entities.SEGMENTS}/largest", "Boxes2D:labels").as_py()
    assert diagnosis.main.cause in labels
    assert diagnosis.causes[0] == diagnosis.main.cause
    assert sorted(diagnosis.causes) == sorted({one.cause for one in diagnosis.segments})
    assert read.array(entities.STACKED_COSTS, "Image:buffer").size > 10_000


def test_the_viewer_gets_no_line_where_nothing_came_back(hazy, tmp_path, monkeypatch):
    detection, truth = hazy
    monkeypatch.setattr("skyline_viz.diagnosis.diagnosing._MOST_LINES", 1)
    rows = truth.rows.copy()
    rows[400] = detection.skyline.rows[400]
    rows[401:] = detection.skyline.rows[401:] - 0.4
    rows[700] -= 40
    diagnosis = diagnose(detection, Skyline(rows=rows))
    lost, narrow = diagnosis.segments
    assert lost.proof is None
    with sv.new_recording(tmp_path / "d.rrd", "d") as recording:
        log_diagnosis(recording, diagnosis, detection, Skyline(rows=rows))
    read = Read(tmp_path / "d.rrd")
    strips = read.last(entities.COUNTERFACTUAL, "LineStrips2D:strips").as_py()
    assert len(strips) == (narrow.proof is not None)
    half = read.last(f"{entities.SEGMENTS}/largest", "Boxes2D:half_sizes").as_py()
    assert [2 * one[0] for one in half] == [lost.length, 6]
    assert diagnosis.markdown().startswith(f"**{lost.cause}")


def test_the_report_begins_with_the_largest_total_error(flat):
    truth = flat_truth([*range(20, 24), *range(100, 160)], 30)
    diagnosis = diagnose(flat, truth)
    assert [one.columns for one in diagnosis.segments] == [(20, 23), (100, 159)]
    words = diagnosis.markdown()
    assert words.index("columns 100 to 159") < words.index("columns 20 to 23")


def test_a_truth_that_climbs_wildly_gets_fewer_tries(flat):
    rows = np.random.default_rng(0).integers(0, 120, 300)
    (segment, *_) = diagnose(flat, Skyline(rows=rows)).by_error
    (steep,) = (one for one in segment.trials if {"cheaper path", "too steep"} <= set(one.changes))
    (plain,) = (one for one in segment.trials if one.changes == ("cheaper path",))
    assert steep.lines < plain.lines == 8
