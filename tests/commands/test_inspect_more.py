"""What ``skyline-viz inspect`` logs besides a detection."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.commands.inspect_more import begin_sweeps, log_diagnosis, log_methods, log_sweeps
from skyline_viz.methods.edges_only import EdgesOnly
from skyline_viz.viewer import entities
from testing.recordings import Read, scene


@pytest.fixture(scope="module")
def found():
    photo, truth = scene()
    return sv.Detector().detect(photo), truth


def test_a_diagnosis_is_logged_where_there_is_something_to_say(found, tmp_path):
    detection, truth = found
    rows = truth.rows.copy()
    rows[30:90] = 80
    for name, line in (("right", detection.skyline), ("wrong", sv.Skyline(rows))):
        with sv.new_recording(tmp_path / f"{name}.rrd", name) as recording:
            diagnosis = log_diagnosis(recording, detection, line, name)
        assert diagnosis.right == (name == "right")
        logged = entities.DIAGNOSIS in Read(tmp_path / f"{name}.rrd").entities()
        assert logged == (name == "wrong")


def test_other_methods_tell_what_there_is_of_them(found, tmp_path):
    detection, truth = found
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        assert log_methods(recording, detection, (), truth, "lean") == ()
        methods = (EdgesOnly(), sv.Detector(config=sv.DetectorConfig.paper()))
        edges, paper = log_methods(recording, detection, methods, truth, "lean")
    assert (edges.name, paper.name) == ("edges", "paper")
    assert {"edges", "cost"} <= {one.name for one in edges.stages}
    assert {one.name for one in paper.stages} - {one.name for one in edges.stages} >= {"bin"}


def test_sweeps_begin_with_a_timeline_each_and_say_what_is_left_out(found, tmp_path, capsys):
    detection, truth = found
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        sweeps = begin_sweeps(recording, detection, ())
        assert "The filter size is not swept" in capsys.readouterr().out
        log_sweeps(recording, sweeps[:1], detection, truth)
    read = Read(tmp_path / "a.rrd")
    (name,) = {sweep.timeline for sweep in sweeps[:1]}
    steps = {one.as_py() for one in read.values[entities.SWEEP_PATH, name]}
    assert steps == {0} | {step.at for step in sweeps[0].steps}  # it opens at 0, with what is now
    assert np.isfinite(list(steps)).all()
