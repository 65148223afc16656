"""Sweeps: which values are tried, and that each gives what a detection of its own would give."""

from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.config import FILTER_SIZES, DetectorConfig, TrainingConfig
from skyline_viz.diagnosis.sweep import setting_sweeps, size_sweep
from skyline_viz.training import train
from skyline_viz.viewer import entities
from skyline_viz.viewer.sweep_recording import log_sweeps
from testing.recordings import Read, verify
from tests.viewer.test_recording import scene

SETTINGS = (
    "canny_thresholds",
    "v",
    "non_edge_cost",
    "clear_sky",
    "terrain_weight",
    "link_weight",
    "delta",
)
CONFIGS = {
    "default": DetectorConfig(),
    "paper": DetectorConfig.paper(),
    "odd": DetectorConfig(v=0.337, delta=31, link_weight=0.0123, low_threshold=33.3),
    "least": DetectorConfig(v=0, delta=0, link_weight=0, low_threshold=0, high_threshold=0),
    "most": DetectorConfig(v=1, delta=100_000, link_weight=1e6, high_threshold=1e5),
}


@pytest.fixture(scope="module")
def found():
    photo, truth = scene(noise=25)
    return sv.Detector().detect(photo), truth


@pytest.fixture(scope="module")
def banks():
    return [
        train([scene(seed=1), scene(seed=2)], 0, TrainingConfig(filter_size=size), "two scenes")
        for size in FILTER_SIZES
    ]


@pytest.fixture(scope="module")
def read(found, banks, tmp_path_factory):
    path = tmp_path_factory.mktemp("sweep") / "a.rrd"
    detection, truth = found
    sweeps = [*setting_sweeps(detection), size_sweep(detection, banks)]
    with sv.new_recording(path, "a") as recording:
        log_sweeps(recording, sweeps, detection, truth)
    verify(path)
    return Read(path), sweeps


@pytest.mark.parametrize("config", CONFIGS.values(), ids=CONFIGS)
def test_the_present_value_is_among_the_steps_and_gives_the_present_path(config):
    found = sv.Detector(config=config).detect(scene()[0])
    sweeps = setting_sweeps(found)
    assert [sweep.timeline for sweep in sweeps] == list(SETTINGS)
    for sweep in sweeps:
        places = [step.at for step in sweep.steps]
        assert places == sorted(set(places))
        assert all(isinstance(at, int) and at >= 0 for at in places)
        ((step, same),) = [one for one in sweep.detections(found) if one[0].at == sweep.present]
        assert step.value == sweep.now
        assert np.array_equal(same.skyline.rows, found.skyline.rows), sweep.timeline
        assert np.array_equal(same.cost, found.cost), sweep.timeline


@pytest.mark.parametrize("number", range(len(SETTINGS)), ids=SETTINGS)
def test_every_value_gives_what_a_detection_of_its_own_gives(found, number):
    sweep = setting_sweeps(found[0])[number]
    lines = set()
    for step, detection in sweep.detections(found[0]):
        alone = step.detector.detect(found[0].photo)
        for stage in ("edges", "bins", "scores", "cost", "forward"):
            assert np.array_equal(getattr(detection, stage), getattr(alone, stage)), stage
        assert np.array_equal(detection.skyline.rows, alone.skyline.rows)
        assert (detection.config, detection.path_cost) == (alone.config, alone.path_cost)
        lines.add(detection.skyline.rows.tobytes())
    assert len(lines) > 1


def test_the_values_around_the_defaults(found):
    sweeps = {sweep.timeline: sweep for sweep in setting_sweeps(found[0])}
    thresholds, v, clear_sky, link_weight, delta = (
        sweeps[name] for name in ("canny_thresholds", "v", "clear_sky", "link_weight", "delta")
    )
    assert [step.at for step in clear_sky.steps] == list(range(0, 91, 6))
    assert [step.at for step in thresholds.steps] == list(range(30, 201, 10))
    assert [step.at for step in v.steps] == list(range(0, 101, 5))
    assert [step.at for step in delta.steps] == list(range(1, 13))
    assert [step.at for step in link_weight.steps] == list(range(0, 301, 20))
    assert (v.now, delta.now, link_weight.now) == ("0.5", "4 px", "0.1")


def test_only_one_setting_changes(found):
    own = found[0].config
    for sweep in setting_sweeps(found[0])[1:]:
        for step in sweep.steps:
            value = getattr(step.detector.config, sweep.timeline)
            assert step.detector.config == replace(own, **{sweep.timeline: value})


def test_stages_that_a_setting_leaves_are_not_computed_again(found):
    sweeps = setting_sweeps(found[0])
    v = sweeps[1]
    for sweep in sweeps[-2:]:
        for _, detection in sweep.detections(found[0]):
            assert detection.cost is found[0].cost
            assert [stage for stage, took in detection.seconds.items() if took] == ["path"]
    for _, detection in v.detections(found[0]):
        assert detection.scores is found[0].scores


def test_filter_sizes_are_those_of_the_banks(found, banks):
    sweep = size_sweep(found[0], banks)
    assert [step.at for step in sweep.steps] == list(FILTER_SIZES)
    assert sweep.present == 7
    assert "2 photos of two scenes" in sweep.note
    for (_, detection), bank in zip(sweep.detections(found[0]), banks, strict=True):
        alone = sv.Detector(bank).detect(found[0].photo)
        assert np.array_equal(detection.scores, alone.scores)
        assert np.array_equal(detection.skyline.rows, alone.skyline.rows)


def test_each_timeline_holds_the_path_of_each_value(read, found):
    recorded, sweeps = read
    for sweep in sweeps:
        lines = recorded.on(sweep.timeline, entities.SWEEP_PATH, "strips")
        assert sorted(lines) == [step.at for step in sweep.steps]
        for step, detection in sweep.detections(found[0]):
            (line,) = lines[step.at]
            assert np.array_equal(np.array(line)[:, 1], detection.skyline.rows)


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
        every = [step.at for step in sweep.steps]
        assert sorted(edges) == (every if sweep.timeline == "canny_thresholds" else every[:1])
        path_only = sweep.timeline in ("delta", "link_weight")
        assert sorted(costs) == (every[:1] if path_only else every)


def test_timelines_without_a_sweep_show_the_present_path(read, found):
    for timeline in (entities.IMAGE, entities.COLUMN):
        ((line,),) = read[0].on(timeline, entities.SWEEP_PATH, "strips").values()
        assert np.array_equal(np.array(line)[:, 1], found[0].skyline.rows)
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
