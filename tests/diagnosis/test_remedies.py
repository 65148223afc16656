"""Remedies: which settings are tried, and what counts as repaired and as broken."""

from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.diagnosis.diagnosing import diagnose
from skyline_viz.diagnosis.remedies import _broken as broken
from skyline_viz.diagnosis.remedies import settings_to_try, try_remedies
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.skyline import Skyline


@pytest.fixture(scope="module")
def photo():
    photo = np.full((120, 300, 3), 200, np.uint8)
    photo[60:] = 60
    return photo


def test_settings_are_given_with_their_flags(photo):
    paper = sv.Detector(config=sv.DetectorConfig.paper()).detect(photo)
    names = list(settings_to_try(replace(paper, thresholds=(50, 220))))
    assert "edges of the colour photo (--config.edge-source colour)" in names
    assert "half the Canny thresholds (--config.low-threshold 25 --config.high-threshold 110)" in (
        names
    )
    assert not any("half the link" in name for name in names)  # there is none to be halved
    assert "the link weight at 0.1 (--config.link-weight 0.1)" in names
    fitted = settings_to_try(replace(sv.Detector().detect(photo), thresholds=(20, 90)))
    assert "half the Canny thresholds" in fitted  # those of each photo
    assert "twice the delta (--config.delta 8)" in fitted


def test_every_term_is_tried_with_another_weight(photo):
    found = sv.Detector().detect(photo)
    tried = settings_to_try(found).values()
    for setting in found.cost_model.settings:
        assert {getattr(one, setting) for one in tried} - {getattr(found.config, setting)}


@pytest.mark.parametrize("setting", ["v", "clear_sky", "sky_weight", "link_weight"])
@pytest.mark.parametrize("most", [False, True])
def test_tried_settings_stay_in_their_range(photo, setting, most):
    config = replace(
        sv.DetectorConfig(), **{setting: {"v": 1, "link_weight": 1e6}.get(setting, 1e3)}
    )
    found = sv.Detector(config=config if most else sv.DetectorConfig()).detect(photo)
    assert settings_to_try(found)  # a configuration beyond its range cannot be made


def test_other_methods_have_no_remedies(photo):
    found = GradientCost().detect(photo)
    truth = Skyline(rows=np.full(300, 20))
    assert try_remedies(found, truth, diagnose(found, truth)) == ()
    with pytest.raises(ValueError, match="gradient has other settings"):
        found.again(sv.DetectorConfig())


def test_nothing_is_repaired_or_broken_in_hidden_columns(photo):
    visible = np.ones(300, bool)
    visible[110:190] = False
    rows = np.full(300, 60)
    rows[100:200] -= 30
    truth = Skyline(rows=rows, visible=visible)
    found = sv.Detector().detect(photo)
    assert all(one.repaired == 0 for one in try_remedies(found, truth, diagnose(found, truth)))


def test_a_segment_that_grows_by_more_than_half_is_broken():
    assert not broken((10, 24), [(10, 19), (40, 49)])
    assert broken((10, 25), [(10, 19), (40, 49)])
    assert broken((25, 30), [(10, 19), (40, 49)])
    assert not broken((10, 39), [(10, 19), (30, 39)])
