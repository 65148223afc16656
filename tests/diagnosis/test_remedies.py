"""Remedies: what other settings repair, and what they break."""

import numpy as np

import skyline_viz as sv
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.remedies import _broken as broken
from skyline_viz.diagnosis.remedies import settings_to_try, try_remedies
from testing.detections import flat_truth


def test_remedies_neither_repair_nor_break_in_hidden_columns(flat):
    visible = np.ones(300, bool)
    visible[110:190] = False
    truth = flat_truth(slice(100, 200), 30, visible)
    found = diagnose(flat, truth)
    assert all(one.repaired == 0 for one in try_remedies(flat, truth, found))


def test_a_segment_that_grows_by_more_than_half_is_broken():
    assert not broken((10, 24), [(10, 19), (40, 49)])
    assert broken((10, 25), [(10, 19), (40, 49)])
    assert broken((25, 30), [(10, 19), (40, 49)])
    assert not broken((10, 39), [(10, 19), (30, 39)])


def test_settings_are_given_with_their_flags():
    names = list(settings_to_try(sv.DetectorConfig.paper(), (50, 220)))
    assert "edges of the colour photo (--config.edge-source colour)" in names
    assert "half the Canny thresholds (--config.low-threshold 25 --config.high-threshold 110)" in (
        names
    )
    assert not any("link" in name for name in names)  # there is none to be halved
    fitted = settings_to_try(sv.DetectorConfig(), (20, 90))
    assert "half the Canny thresholds" in fitted  # those of each photo
    assert "twice the delta (--config.delta 8)" in fitted
