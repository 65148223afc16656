"""Sweeps: which values are tried, and that each gives what a detection of its own would give."""

from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.config import DetectorConfig
from skyline_viz.diagnosis.sweep import setting_sweeps, size_sweep
from testing.networks import bright_model
from testing.recordings import banks_of_sizes, scene

SIZES = (3, 7, 11)
SETTINGS = (
    "canny_thresholds",
    "v",
    "non_edge_cost",
    "clear_sky",
    "sky_weight",
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
    return sv.Detector(sky=bright_model()).detect(photo), truth


@pytest.fixture(scope="module")
def banks():
    return banks_of_sizes(SIZES)


@pytest.mark.parametrize("config", CONFIGS.values(), ids=CONFIGS)
def test_the_present_value_is_among_the_steps_and_gives_the_present_path(config):
    found = sv.Detector(config=config).detect(scene()[0])
    sweeps = setting_sweeps(found)
    assert {sweep.timeline for sweep in sweeps} >= set(SETTINGS)
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
    assert [step.at for step in sweep.steps] == list(SIZES)
    assert sweep.present == 7
    assert "2 photos of two scenes" in sweep.note
    for (_, detection), bank in zip(sweep.detections(found[0]), banks, strict=True):
        alone = sv.Detector(bank, sky=found[0].detector.sky).detect(found[0].photo)
        assert np.array_equal(detection.scores, alone.scores)
        assert np.array_equal(detection.skyline.rows, alone.skyline.rows)
