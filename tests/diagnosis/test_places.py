"""Where a path leaves the truth: what is measured on photos that show one thing each."""

from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.diagnosis.places import FAR, place_of
from skyline_viz.skyline import Skyline
from testing.detections import WITHOUT_SKY
from testing.injected import PLACE_MAKERS, cases, main_cause

WIDE, HIGH, RIDGE = 240, 160, 80
SKY, BLUE, GROUND = (200, 200, 200), (150, 180, 225), (60, 60, 60)


def found(photo, path, visible=None):
    """What a photo shows between its ridge and a level path."""
    detection = WITHOUT_SKY.detect(photo)
    detection = replace(detection, skyline=Skyline(rows=np.full(WIDE, path)))
    case = Case(detection, Skyline(rows=np.full(WIDE, RIDGE), visible=visible), 4.0)
    return place_of(case, np.ones(WIDE), 0, WIDE - 1)


def scene(sky=SKY, ground=GROUND):
    photo = np.empty((HIGH, WIDE, 3), np.uint8)
    photo[:RIDGE], photo[RIDGE:] = sky, ground
    return photo


def with_rows(first, last, colour, **colours):
    photo = scene(**colours)
    photo[first : last + 1] = colour
    return photo


@pytest.mark.parametrize(
    ("place", "photo", "path"),
    [
        ("cloud above", with_rows(40, RIDGE - 1, (120, 120, 120)), 40),
        ("wire", with_rows(40, 42, (20, 20, 20)), 40),
        ("frame", with_rows(0, 15, (10, 10, 10)), 16),
        ("frame", with_rows(140, HIGH - 1, (5, 5, 5), ground=(90, 90, 90)), 140),
        ("haze", with_rows(RIDGE, 109, (194, 194, 194)), 110),
        ("haze", with_rows(40, 59, (60, 60, 60), ground=(194, 194, 194)), 40),
        ("snow", with_rows(RIDGE, 109, (220, 222, 226), sky=BLUE), 110),
        ("foreground ridge", with_rows(RIDGE, 109, (150, 150, 150)), 110),
        ("snow", with_rows(RIDGE, 109, (220, 222, 226), sky=(140, 140, 140)), 110),
        ("foreground ridge", with_rows(RIDGE, 109, (200, 200, 205), sky=(240, 240, 240)), 110),
    ],
)
def test_a_place_is_told_by_what_is_measured(place, photo, path):
    assert found(photo, path).place == place


def test_a_thin_wire_before_a_cloud_is_a_wire():
    photo = with_rows(40, 40, (60, 60, 60))
    photo[43:60] = (160, 160, 160)  # the lower side of a cloud, a little under the wire
    assert found(photo, 40).place == "wire"


def test_a_soft_ridge_is_in_haze_whatever_lies_below():
    photo = scene(ground=(160, 160, 160))
    fade = np.linspace(0, 1, 30)[:, None]
    photo[RIDGE - 15 : RIDGE + 15] = ((1 - fade) * SKY + fade * (160, 160, 160))[:, None]
    assert found(photo, 140).place == "haze"


def test_near_the_truth_there_is_no_place():
    assert found(scene(), RIDGE - FAR) is None
    assert found(scene(), RIDGE - FAR - 1) is not None


def test_hidden_columns_show_nothing():
    visible = np.arange(WIDE) >= 100
    there = found(scene(), 40, visible)
    assert there.begins == 100
    assert found(scene(), 40, np.zeros(WIDE, bool)) is None


def test_the_columns_that_cost_most_decide():
    photo = with_rows(RIDGE, 109, (150, 150, 150))
    photo[RIDGE:110, :200] = 194
    detection = WITHOUT_SKY.detect(photo)
    detection = replace(detection, skyline=Skyline(rows=np.full(WIDE, 110)))
    case = Case(detection, Skyline(rows=np.full(WIDE, RIDGE)), 4.0)
    even = np.ones(WIDE)
    late = np.where(np.arange(WIDE) >= 200, 20.0, 1.0)
    assert place_of(case, even, 0, WIDE - 1).place == "haze"
    there = place_of(case, late, 0, WIDE - 1)
    assert there.place == "foreground ridge"
    assert 195 <= there.begins <= 205
    assert there.evidence.startswith(f"It begins at column {there.begins}, at a foreground ridge:")


@pytest.mark.parametrize("place", PLACE_MAKERS)
def test_a_painted_failure_is_told_from_others(place):
    told = [main_cause(one).place for one in cases(place, 2)]
    assert told.count(place) == 2, told
