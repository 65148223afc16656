"""Sweeps as Rerun entities."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.diagnosis.sweep import setting_sweeps, size_sweep
from skyline_viz.viewer import entities
from skyline_viz.viewer.sweep_recording import log_sweeps, opening_of
from testing.recordings import Read, banks_of_sizes, drawn_rows, scene, verify, visible_rows


@pytest.fixture(scope="module")
def found():
    photo, truth = scene(noise=25)
    return sv.Detector().detect(photo), truth


@pytest.fixture(scope="module")
def banks():
    return banks_of_sizes((3, 7, 11))


@pytest.fixture(scope="module")
def read(found, banks, tmp_path_factory):
    path = tmp_path_factory.mktemp("sweep") / "a.rrd"
    detection, truth = found
    sweeps = [*setting_sweeps(detection), size_sweep(detection, banks)]
    with sv.new_recording(path, "a") as recording:
        log_sweeps(recording, sweeps, detection, truth)
    verify(path)
    return Read(path), sweeps


def test_each_timeline_holds_the_path_of_each_value(read, found):
    recorded, sweeps = read
    for sweep in sweeps:
        lines = recorded.on(sweep.timeline, entities.SWEEP_PATH, "strips")
        values = [step.at for step in sweep.steps]
        assert sorted(lines) == sorted({opening_of(sweep), *values})
        for step, detection in sweep.detections(found[0]):
            line = drawn_rows(lines[step.at], detection.skyline.width)
            np.testing.assert_array_equal(line, visible_rows(detection.skyline))


def test_errors_and_reports_say_the_exact_value(read, found):
    recorded, sweeps = read
    for sweep in sweeps:
        errors = recorded.on(sweep.timeline, entities.SWEEP_ERROR, "scalars")
        reports = recorded.on(sweep.timeline, entities.SWEEP_REPORT, "text")
        for step, detection in sweep.detections(found[0]):
            error = sv.a_err(detection.skyline, found[1])
            assert errors[step.at] == pytest.approx([error])
            (report,) = reports[step.at]
            assert f"**{sweep.title} {step.value}**, now {sweep.now}" in report
            assert f"**A_err {error:.2f} px**" in report
            assert f"| {sweep.title} |" in report
        marks = recorded.on(sweep.timeline, f"{entities.SWEEP_ERROR}/present", "scalars")
        assert list(marks) == [sweep.present]


def test_maps_are_logged_where_they_change_only(read):
    recorded, sweeps = read
    for sweep in sweeps:
        edges = recorded.on(sweep.timeline, entities.SWEEP_EDGES, "blob")
        costs = recorded.on(sweep.timeline, entities.SWEEP_COST, "buffer")
        every = sorted({opening_of(sweep), *(step.at for step in sweep.steps)})
        first = every[:1] if every[0] == sweep.steps[0].at else every[:2]  # 0 is the present one
        if sweep.timeline == "sky_weight":  # without the model no edges are sought either
            assert every[0] == 0
            assert sorted(edges) in (every[:1], every[:2])
        else:
            assert sorted(edges) == (every if sweep.timeline == "canny_thresholds" else first)
        path_only = sweep.timeline in ("delta", "link_weight")
        assert sorted(costs) == (first if path_only else every)


def test_timelines_without_a_sweep_show_the_present_path(read, found):
    for timeline in (entities.IMAGE, entities.COLUMN):
        (strips,) = read[0].on(timeline, entities.SWEEP_PATH, "strips").values()
        line = drawn_rows(strips, found[0].skyline.width)
        np.testing.assert_array_equal(line, visible_rows(found[0].skyline))
        assert read[0].on(timeline, entities.SWEEP_EDGES, "blob")


def test_the_best_value_is_the_present_one_where_none_is_better(tmp_path):
    photo = np.full((60, 80, 3), 200, np.uint8)
    photo[30:] = 60
    detection = sv.Detector().detect(photo)
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        log_sweeps(recording, setting_sweeps(detection), detection, detection.skyline)
    report = Read(tmp_path / "a.rrd").last(entities.SWEEP_REPORT, "text").as_py()[0]
    for row in ("v | 0.00 px | 0.5 |", "delta | 0.00 px | 4 px |"):
        assert row in report


@pytest.mark.parametrize("value", [0, 128])
def test_photos_without_an_edge_and_without_a_truth(tmp_path, value):
    detection = sv.Detector().detect(np.full((40, 50, 3), value, np.uint8))
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        log_sweeps(recording, setting_sweeps(detection), detection)
    report = Read(tmp_path / "a.rrd").last(entities.SWEEP_REPORT, "text").as_py()[0]
    assert "moves the path by" in report
    assert "A_err" not in report
