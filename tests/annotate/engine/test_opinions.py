"""Second opinions, and what becomes of them among the numbered lines."""

import numpy as np

import skyline_viz as sv
from annotate.engine.live_wire import LiveWire
from annotate.engine.opinions import detectors, opinions
from skyline_viz.methods.edges_only import EdgesOnly


def test_one_trusts_the_sky_model_and_one_does_without():
    trusting, edges = detectors(sv.Detector(config=sv.DetectorConfig.paper()))
    assert trusting.config.sky_weight > sv.DetectorConfig().sky_weight
    assert (edges.config.sky_weight, edges.config.clear_sky) == (0, 0)
    own = sv.Detector(sky=sv.SkyModel.large())
    assert all(one.sky is own.sky for one in detectors(own))
    assert all(one.bank is not None for one in detectors(EdgesOnly()))


def test_they_are_lines_of_the_photo():
    scene = sv.render("clear", 4, 200, 140)
    found = list(opinions(sv.Detector(), scene.photo))
    assert [one.shape for one in found] == [(200,), (200,)]
    assert all(one.min() >= 0 and one.max() < 140 for one in found)


def test_a_wrong_proposal_has_the_ridge_of_a_second_opinion_first():
    wire = LiveWire(sv.render("clear", 4, 200, 140).photo, sv.Detector())
    elsewhere = np.full(200, int(wire.skyline.rows.max() + 140) // 2, np.int32)
    first, *others = wire.alternatives([elsewhere, elsewhere + 1])
    np.testing.assert_array_equal(first.rows, elsewhere)
    assert len(others) <= 3


def test_an_opinion_that_is_the_proposal_is_no_other_line():
    wire = LiveWire(sv.render("clear", 4, 200, 140).photo, sv.Detector())
    same = wire.alternatives([wire.skyline.rows.astype(np.int32)])
    own = wire.alternatives()
    assert len(same) == len(own)
    for one, other in zip(same, own, strict=True):
        np.testing.assert_array_equal(one.rows, other.rows)
