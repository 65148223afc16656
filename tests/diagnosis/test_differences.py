"""Signed differences of the maps of two detections."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.diagnosis.differences import ALIKE, cost_difference, differences, edge_difference
from skyline_viz.methods.registry import find_method
from testing.detections import mountains
from testing.examples import examples

PHOTO, _ = mountains()
DEFAULT = Detector().detect(PHOTO)
PAPER = Detector(config=DetectorConfig.paper()).detect(PHOTO)


def by_title(first, second):
    return {one.title: one for one in differences(first, second)}


def test_maps_of_one_detection_are_alike():
    for one in differences(DEFAULT, Detector().detect(PHOTO)):
        assert not one.apart.any(), one.title


def test_the_terms_that_differ_come_to_the_cost_that_differs():
    found = by_title(DEFAULT, PAPER)
    terms = [one.values.astype(np.float64) for one in found.values() if one.kind == "term"]
    np.testing.assert_allclose(sum(terms), found["cost"].values, atol=1e-4)


def test_edges_are_of_the_first_or_of_the_second():
    values = by_title(DEFAULT, PAPER)["edges"].values
    np.testing.assert_array_equal(values == 1, PAPER.edges & ~DEFAULT.edges)
    np.testing.assert_array_equal(values == -1, DEFAULT.edges & ~PAPER.edges)
    np.testing.assert_array_equal(values, edge_difference(DEFAULT, PAPER).values)


@examples(10)
@given(st.sampled_from(["paper", "default:v=0.9,delta=1", "default:fit_thresholds=false"]))
def test_the_other_way_round_all_signs_turn(name):
    other = find_method(name).detect(PHOTO)
    there, back = by_title(DEFAULT, other), by_title(other, DEFAULT)
    assert list(there) == list(back)  # in the order in which maps are made
    for title, one in there.items():
        if one.only:
            assert back[title].only == one.only == "default"
        elif title == "bin":
            np.testing.assert_array_equal(one.apart, back[title].apart)
        else:
            np.testing.assert_allclose(one.values, -back[title].values, atol=ALIKE)


def test_a_stage_that_only_one_has_is_said_to_be():
    found = by_title(DEFAULT, PAPER)
    assert (found["sky"].only, found["sky"].values, found["sky"].apart) == ("default", None, None)
    assert [title for title, one in found.items() if one.only] == ["sky"]


def test_costs_of_other_methods_are_not_taken_apart():
    other = find_method("edges").detect(PHOTO)
    found = by_title(DEFAULT, other)
    assert not any(one.kind == "term" for one in found.values())
    assert found["bin"].only == "default"
    ruled_out = ~other.edges
    assert np.isnan(cost_difference(DEFAULT, other).values[ruled_out]).all()


def test_two_photos_are_refused():
    with pytest.raises(ValueError, match="two sizes"):
        list(differences(DEFAULT, Detector().detect(PHOTO[:60])))
