"""Which other settings are tried as remedies, and with which flags they are set."""

from dataclasses import replace

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.diagnosis.other_settings import PAIRED, flags, pairs_to_try, settings_to_try


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


def test_each_setting_goes_up_and_down(photo):
    found = sv.Detector().detect(photo)
    tried = settings_to_try(found).values()
    for name in ("v", "non_edge_cost", "clear_sky", "sky_weight", "sky_cap", "delta"):
        present = getattr(found.config, name)
        others = {getattr(one, name) for one in tried}
        assert min(others) < present < max(others), name


def test_settings_that_helped_most_are_tried_in_pairs():
    config = sv.DetectorConfig()
    single = {
        "a": replace(config, delta=8),
        "b": replace(config, v=0.75),
        "c": replace(config, delta=2),
        "d": replace(config, clear_sky=0.0),
        "e": replace(config, sky_cap=2.0),
        "f": replace(config, sky_weight=9.0),
    }
    changes = {"a": -9.0, "b": -8.0, "c": -7.0, "d": -6.0, "e": -5.0, "f": 1.0}
    pairs = pairs_to_try(config, single, changes)
    assert [*pairs] == ["a and b", "a and d", "b and c", "b and d", "c and d"]  # not two deltas
    assert PAIRED == 4  # so neither e nor f
    assert pairs["a and b"] == replace(config, delta=8, v=0.75)
    assert pairs_to_try(config, single, dict.fromkeys(single, 0.5)) == {}


def test_presets_are_tried_as_a_whole(photo):
    found = sv.Detector().detect(photo)
    assert settings_to_try(found)["all settings of paper (--preset paper)"] == (
        sv.DetectorConfig.paper()
    )


def test_flags_set_what_they_say(photo, tmp_path, capsys):
    sv.write_photo(tmp_path / "a.png", photo)
    low = replace(sv.DetectorConfig(), fit_thresholds=False, low_threshold=20.0)
    said = flags(sv.DetectorConfig(), low)
    assert said == "--config.low-threshold 20 --config.no-fit-thresholds"
    words = ["detect", str(tmp_path / "a.png"), "--out", str(tmp_path / "o"), *said.split()]
    assert main(words) == 0
    capsys.readouterr()
