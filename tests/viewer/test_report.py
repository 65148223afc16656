"""The short report of a detection."""

from dataclasses import replace

import pytest

import skyline_viz as sv
from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.viewer.report import listed_segments, report
from testing.detections import unseen
from testing.recordings import scene


@pytest.fixture(scope="module")
def photo():
    return scene()[0]


def told(detection, truth=None, shown=None, name="a.png"):
    line, height = detection.skyline, len(detection.photo)
    verdict = Verdict.of(line, detection.margins(), height, truth)
    return report(name, detection, verdict, len(detection.scores) if shown is None else shown)


def test_it_says_how_good_and_how_sure(photo):
    detection = sv.Detector().detect(photo)
    rows = detection.skyline.rows.copy()
    rows[10:30] -= 25
    said = told(detection, sv.Skyline(rows))
    assert "**a.png**" in said
    assert f"**A_err {25 * 20 / 120:.2f} px**" in said
    assert "**Worst** 25.0 px at column 10" in said
    assert "**Wrong columns** 10 to 29" in said
    assert "**Margin** " in said
    assert f"**Edges** {len(detection.scores):,} pixels" in said
    assert ("A gross miss" in said) == (0.05 * len(photo) < 25 * 20 / 120)


def test_without_a_truth_it_says_so(photo):
    said = told(sv.Detector().detect(photo))
    assert "There is no truth to compare with" in said
    assert "A_err" not in said


def test_it_says_how_many_edge_pixels_are_shown(photo):
    detection = sv.Detector().detect(photo)
    assert "Maps show the 7 cheapest" in told(detection, shown=7)
    assert "Maps show" not in told(detection)


def test_it_says_how_the_detection_was_made(photo):
    assert "Default settings." in told(sv.Detector().detect(photo))
    assert "Filters learned from " in told(sv.Detector().detect(photo))
    paper = sv.Detector(config=sv.DetectorConfig.paper()).detect(photo)
    assert "The paper's settings" in told(paper)
    own = sv.Detector(config=sv.DetectorConfig(delta=2, v=0.25)).detect(photo)
    assert "V 0.25, delta 2" in told(own)
    other = told(EdgesOnly().detect(photo))
    assert "Method edges." in other
    assert "Canny" not in other


def test_a_name_cannot_be_markdown(photo):
    said = told(sv.Detector().detect(photo), name="**a** <b>")
    assert "**a**" not in said.splitlines()[0][2:-4]


def test_many_segments_are_cut_short():
    segments = [(10 * one, 10 * one + one) for one in range(9)]
    assert (
        listed_segments(segments)
        == "0, 10 to 11, 20 to 22, 30 to 33, 40 to 44, 50 to 55 and 3 more"
    )
    assert listed_segments([]) == ""


def test_settings_that_differ_are_named():
    assert sv.DetectorConfig().changed() == []
    config = replace(sv.DetectorConfig(), clear_sky=0.0)
    assert config.changed() == ["clear_sky 0"]


def test_it_says_whether_there_is_a_skyline(photo):
    assert "**" not in unseen().detect(photo).visibility.said
    assert "No skyline is visible: there seems to be no sky" in told(unseen().detect(photo))
    assert "evidence" not in told(EdgesOnly().detect(photo))
