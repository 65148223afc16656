"""What our detector found: whether it says how it was made, and asks its own sky model."""

import numpy as np
import pytest

import skyline_viz as sv


@pytest.fixture(scope="module")
def photo():
    return sv.render("clear", 2, 200, 140).photo


def test_it_says_what_made_it(photo):
    said = " ".join(sv.Detector().detect(photo).about())
    assert "Sky model small." in said
    assert "Canny thresholds" in said
    plain = " ".join(sv.Detector(config=sv.DetectorConfig.paper()).detect(photo).about())
    assert plain.startswith("The paper's settings.")
    assert "Sky model" not in plain


def test_starved_pixels_are_those_of_starved_bins(photo):
    found = sv.Detector().detect(photo)
    np.testing.assert_array_equal(found.starved, found.bank.starved[found.bins])


def test_a_switched_off_sky_model_is_asked_for_the_confidence(photo):
    with_sky = sv.Detector().detect(photo)
    without = sv.Detector(config=sv.DetectorConfig(sky_weight=0.0)).detect(photo)
    assert without.sky is None
    np.testing.assert_array_equal(without._sky_asked(), with_sky.sky)
