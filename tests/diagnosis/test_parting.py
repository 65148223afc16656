"""Where two detections part."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.diagnosis.parting import parting, settings_apart, turns
from skyline_viz.methods.registry import find_method
from testing.detections import mountains
from testing.examples import examples

PHOTO, TRUTH = mountains()
CONFIG = DetectorConfig()
DEFAULT = Detector().detect(PHOTO)


def detect(**changes):
    return Detector(config=replace(CONFIG, **changes)).detect(PHOTO)


def test_equal_detections_part_nowhere():
    found = parting(DEFAULT, Detector().detect(PHOTO), TRUTH)
    assert (found.at, found.on_lines, found.parts, found.settings) == (None, None, (), ())
    assert (found.turns, found.turned_by, found.apart, found.distance) == ((), "", (), 0)
    assert found.change == 0


@examples(12)
@given(st.sampled_from([5.0, 30.0, 80.0]), st.sampled_from([90.0, 150.0, 300.0]))
def test_other_thresholds_part_at_the_edges_or_nowhere(low, high):
    other = detect(low_threshold=low, high_threshold=high, fit_thresholds=False, sky_edges=1.0)
    ours = detect(sky_edges=1.0)
    found = parting(ours, other)
    if (ours.edges == other.edges).all():
        assert found.at is None
    else:
        assert found.at.title == "edges"
        there = (ours.edges != other.edges).any(axis=0)
        assert (found.at.column, found.at.columns) == (there.argmax(), there.sum())


@pytest.mark.parametrize(
    ("setting", "value", "term"),
    [
        ("v", 0.8, "score"),
        ("strength_percentile", 50.0, "strength"),
        ("non_edge_cost", 3.0, "no edge"),
        ("clear_sky", 0.3, "clear sky"),
        ("sky_weight", 2.0, "sky"),
        ("sky_cap", 0.2, "sky"),
    ],
)
def test_another_weight_parts_at_its_term(setting, value, term):
    found = parting(DEFAULT, detect(**{setting: value}))
    assert (found.at.kind, found.at.name) == ("term", term)
    assert [one.name for one in found.settings] == [setting]


@examples(12)
@given(st.sampled_from([0.0, 0.5, 3.0, 50.0]), st.sampled_from([1, 4, 9]))
def test_another_link_alone_parts_at_the_path_or_nowhere(weight, delta):
    other = detect(link_weight=weight, delta=delta)
    found = parting(DEFAULT, other)
    lines = [one.skyline.rows for one in (DEFAULT, other)]
    assert [one.title for one in found.parts] == (["path"] if (lines[0] != lines[1]).any() else [])
    if found.at:
        assert found.at.column == (lines[0] != lines[1]).argmax()
        assert found.distance == pytest.approx(np.abs(lines[1] - lines[0]).mean())


def test_errors_and_distances_are_those_of_the_lines():
    other = detect(v=0.0, link_weight=0.0)
    found = parting(DEFAULT, other, TRUTH)
    errors = [sv.a_err(one.skyline, TRUTH) for one in (DEFAULT, other)]
    assert found.a_errs == pytest.approx(errors)
    assert found.change == pytest.approx(errors[1] - errors[0])
    assert parting(DEFAULT, other).change is None
    unseen = sv.Skyline(TRUTH.rows, np.zeros(TRUTH.width, bool))
    assert parting(DEFAULT, other, unseen).a_errs is None


def two_lines():
    """A faint line in the sky above a strong one."""
    photo = np.full((140, 200, 3), 215, np.uint8)
    photo[40:46], photo[100:] = 160, 40
    return photo


def test_the_term_that_turned_the_path_is_named_and_columns_on_the_lines_are_counted():
    ours, other = (
        Detector(config=replace(CONFIG, sky_weight=0.0, clear_sky=weight)).detect(two_lines())
        for weight in (0.0, 1.0)
    )
    found = parting(ours, other)
    assert found.apart == ((0, 199),)
    assert found.turned_by == "clear sky"
    assert found.on_lines.name == "clear sky"
    assert found.on_lines.on_lines == tuple(range(200))
    assert parting(other, ours).turned_by == "clear sky"


@examples(8)
@given(st.sampled_from([0.0, 0.1, 1.0]), st.sampled_from([0.0, 0.4, 1.0]))
def test_each_detector_finds_the_line_of_the_other_dearer(clear_sky, v):
    config = replace(CONFIG, sky_weight=0.0, clear_sky=0.0)
    ours = Detector(config=config).detect(two_lines())
    other = Detector(config=replace(config, clear_sky=clear_sky, v=v)).detect(two_lines())
    found = turns(ours, other)
    assert {one.term for one in found} == {one.name for one in ours.cost_model.terms}
    assert sum(one.first for one in found) >= -1e-3
    assert sum(one.second for one in found) <= 1e-3
    assert [one.change for one in found] == sorted(one.change for one in found)


def test_a_line_that_is_too_steep_is_turned_by_delta():
    photo = np.full((120, 200, 3), 210, np.uint8)
    photo[40:, :100], photo[100:, 100:] = 50, 50
    free = Detector(config=replace(CONFIG, sky_weight=0.0, delta=60)).detect(photo)
    stiff = Detector(config=replace(CONFIG, sky_weight=0.0, delta=1)).detect(photo)
    found = parting(stiff, free)
    assert found.apart
    assert found.turned_by == "delta"
    assert found.settings[0].name == "delta"


def test_settings_name_the_sky_model_the_filters_and_the_thresholds():
    paper = Detector(config=DetectorConfig.paper()).detect(PHOTO)
    told = {one.name: (one.first, one.second) for one in settings_apart(DEFAULT, paper)}
    assert told["sky"] == ("small", "none")
    assert told["edge_source"] == ("colour", "grey")
    assert told["Canny thresholds used"][1] == "50 and 220"
    bank = sv.FilterBank.default()
    other = Detector(replace(bank, filters=bank.filters * 0.9)).detect(PHOTO)
    (filters,) = settings_apart(DEFAULT, other)
    assert filters.second == f"{filters.first} (other filters)"
    found = parting(DEFAULT, other)
    assert found.at.title == "score"


def test_of_other_methods_neither_settings_nor_terms_are_known():
    found = parting(DEFAULT, find_method("edges").detect(PHOTO))
    assert (found.settings, found.turns) == ((), ())
    assert found.at.only == "default"
    assert found.on_lines is None or not found.on_lines.only
