"""A second detection beside the first: its line, its stages, and what differs."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.viewer import entities
from skyline_viz.viewer.comparison import LEAN, log_comparison, reach_of, rounded_up
from testing.recordings import Read, drawn_rows, scene, visible_rows


@pytest.mark.parametrize("apart", [0, 30])
def test_it_says_where_the_second_one_differs(apart, tmp_path):
    photo, truth = scene()
    detection = sv.Detector().detect(photo)
    changed = photo.copy()
    if apart:  # a wall in the sky, which the second detector sees
        changed[5:, 20:60] = 20
    other = sv.Detector().detect(changed)
    with sv.new_recording(tmp_path / "a.rrd", "a") as recording:
        found = log_comparison(recording, detection, other, truth, "the <second> one")
    assert found.verdict.a_err == pytest.approx(sv.a_err(other.skyline, truth))
    read = Read(tmp_path / "a.rrd")
    line = drawn_rows(read.last(entities.ALTERNATIVE, "strips").as_py(), photo.shape[1])
    np.testing.assert_array_equal(line, visible_rows(other.skyline))
    assert entities.below(entities.OTHER, entities.COST) in read.entities()
    (text,) = read.last(entities.COMPARISON, "text").as_py()
    lower = np.abs(other.skyline.rows - detection.skyline.rows)
    assert f"mean distance {lower.mean():.2f} px, largest {lower.max():.0f} px" in text
    assert ("nowhere apart" in text) == (apart == 0)
    assert "<second>" not in text
    assert bool(found.unlike) == bool(apart)


@pytest.fixture(scope="module")
def compared(tmp_path_factory):
    """A full recording of two detectors, and a lean one."""
    photo, truth = scene()
    detection = sv.Detector().detect(photo)
    other = sv.Detector(config=sv.DetectorConfig.paper()).detect(photo)
    read = {}
    for fidelity in ("full", "lean"):
        file = tmp_path_factory.mktemp("compared") / "a.rrd"
        with sv.new_recording(file, "a") as recording:
            found = log_comparison(recording, detection, other, truth, "a", fidelity)
        read[fidelity] = Read(file), found
    return detection, other, read


def test_every_map_that_differs_has_one_of_its_own(compared):
    _, _, read = compared
    full, found = read["full"]
    assert {(one.kind, one.name) for one in found.parting.parts if not one.only} == {
        *((one.group.split("/")[1], one.name) for one in found.unlike),
        ("stage", "path"),
    }
    for one in found.unlike:
        assert entities.of_quantity(one) in full.entities()
        if one.name != "edges":
            assert one.low == -one.high  # alike is in the middle of the colours
    assert {one.name for one in found.of_any_photo} >= {"edges", "cost", "clear sky"}


def test_a_map_holds_the_second_less_the_first(compared):
    detection, other, read = compared
    full, found = read["full"]
    (cost,) = (one for one in found.maps if one.name == "cost")
    height, width = detection.edges.shape
    pixels = np.array(full.last(entities.of_quantity(cost), "buffer").as_py()[0], np.uint8)
    classes = pixels.reshape(height, width).astype(np.float64)
    values = np.where(classes > 0, cost.low + (classes - 1) * (cost.high - cost.low) / 254, 0.0)
    expected = other.cost - detection.cost
    np.testing.assert_allclose(values, expected, atol=(cost.high - cost.low) / 254)
    edges = np.array(full.last("apart/stage/edges", "buffer").as_py()[0], np.uint8)
    np.testing.assert_array_equal(
        edges.reshape(height, width), detection.edges + 2 * other.edges.astype(np.uint8)
    )


def test_a_lean_recording_has_edges_and_cost_alone(compared):
    _, _, read = compared
    lean, found = read["lean"]
    assert [(one.group, one.name) for one in found.maps] == [(one.group, one.name) for one in LEAN]
    assert "apart/term/sky" not in lean.entities()


@pytest.mark.parametrize("largest", [0.7, 3.0, 1e6])
def test_costs_that_forbid_pixels_leave_the_others_their_colours(largest):
    sizes = np.append(np.linspace(0.1, 0.5, 99), largest).astype(np.float32)
    assert reach_of(sizes, forbidding=False) == np.float32(largest)
    reach = reach_of(sizes, forbidding=True)
    assert reach == (np.float32(largest) if largest <= 3 else pytest.approx(0.48, abs=0.02))
    assert reach_of(sizes[:0], forbidding=True) == 0


@given(st.floats(1e-4, 1e6))
def test_ends_of_ranges_hold_their_values_and_are_not_far_beyond(value):
    assert value * (1 - 1e-6) <= rounded_up(value) <= 1.5 * value + 1e-6
