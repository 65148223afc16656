"""A diagnosis as Rerun entities."""

from dataclasses import replace

import pytest

import skyline_viz as sv
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.remedies import Remedy
from skyline_viz.skyline import Skyline
from skyline_viz.viewer import entities
from skyline_viz.viewer.diagnosis_recording import log_diagnosis
from testing import detections
from testing.injected import cases
from testing.recordings import Read, verify


@pytest.fixture(scope="module")
def hazy():
    return detections.hazy()


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
    assert diagnosis.main.title in labels
    assert diagnosis.causes[0] == diagnosis.main.cause
    assert sorted(diagnosis.causes) == sorted({one.cause for one in diagnosis.segments})


def test_the_viewer_gets_no_line_where_nothing_came_back(hazy, tmp_path):
    detection, truth = hazy
    rows = truth.rows.copy()
    rows[400] = detection.skyline.rows[400]
    rows[401:] = detection.skyline.rows[401:] - 0.4
    rows[700] -= 40
    found = diagnose(detection, Skyline(rows=rows))
    wide, narrow = found.segments
    lost = replace(wide, trials=())  # as if nothing that was tried had helped
    assert lost.proof is None
    assert narrow.proof is not None
    diagnosis = replace(found, segments=(lost, narrow))
    with sv.new_recording(tmp_path / "d.rrd", "d") as recording:
        log_diagnosis(recording, diagnosis, detection, Skyline(rows=rows))
    read = Read(tmp_path / "d.rrd")
    strips = read.last(entities.COUNTERFACTUAL, "LineStrips2D:strips").as_py()
    assert len(strips) == 1
    half = read.last(f"{entities.SEGMENTS}/largest", "Boxes2D:half_sizes").as_py()
    assert [2 * one[0] for one in half] == [lost.length, 6]
    assert diagnosis.markdown().startswith(f"**{lost.cause}")


def test_the_remedy_is_drawn_with_its_flags(tmp_path):
    photo, truth = detections.lines_in_the_sky(1)
    found = detections.WITHOUT_SKY.detect(photo)
    diagnosis = diagnose(found, truth)
    remedy = Remedy("no link weight", "--config.link-weight 0", 1, 0, 1.5, -9.0, gross_miss=False)
    with sv.new_recording(tmp_path / "d.rrd", "d") as recording:
        log_diagnosis(recording, diagnosis, found, truth, mended=(remedy, truth))
    read = Read(tmp_path / "d.rrd")
    words = read.last(entities.DIAGNOSIS, "TextDocument:text").as_py()[0]
    assert "To be added: `--config.link-weight 0`" in words
    assert words.index("To be added") < words.index(diagnosis.main.title)  # what helps comes first
    named = f"{entities.REMEDY}/named"
    labels = read.last(named, "LineStrips2D:labels").as_py()
    assert labels == ["--config.link-weight 0: A_err 1.50 px"]
    dashes = [
        *read.last(entities.REMEDY, "LineStrips2D:strips").as_py(),
        *read.last(named, "LineStrips2D:strips").as_py(),
    ]
    columns = sorted(column for dash in dashes for column, _ in dash)
    assert len(columns) == len(set(columns)) == pytest.approx(truth.width / 2, abs=8)


def test_long_flags_stand_in_the_report_alone(tmp_path):
    photo, truth = detections.lines_in_the_sky(1)
    found = detections.WITHOUT_SKY.detect(photo)
    flags = "--config.link-weight 0 --config.strength-percentile 75"
    remedy = Remedy("both", flags, 1, 0, 1.5, -9.0, gross_miss=False)
    with sv.new_recording(tmp_path / "d.rrd", "d") as recording:
        log_diagnosis(recording, diagnose(found, truth), found, truth, mended=(remedy, truth))
    read = Read(tmp_path / "d.rrd")
    labels = read.last(f"{entities.REMEDY}/named", "LineStrips2D:labels").as_py()
    assert labels == ["other settings: A_err 1.50 px"]
    words = read.last(entities.DIAGNOSIS, "TextDocument:text").as_py()[0]
    assert f"To be added: `{flags}`" in words
