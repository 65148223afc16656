"""All stages in their order: what is told of them, and what the sky model sees."""

import numpy as np

from skyline_viz.config import DetectorConfig
from skyline_viz.detecting.pipeline import STAGES, run_stages, sky_inside
from skyline_viz.filter_bank import FilterBank
from skyline_viz.frames.frame import Frame
from skyline_viz.rendering import render
from skyline_viz.sky_model import SkyModel

SCENE = render("clear", 5, 120, 160)


def made(**settings):
    config = DetectorConfig(**settings)
    return run_stages(SCENE.photo, FilterBank.default(), config, SkyModel.small())


def test_the_path_is_the_cheapest_through_the_costs():
    stages = made()
    path = stages.path
    assert np.abs(path.rows - SCENE.truth.rows).mean() < 2
    paid = stages.cost[path.rows, np.arange(120)].sum()
    assert paid <= path.cost + 1e-3
    assert stages.edges.sum() == len(stages.pixels[0]) == len(stages.looks.scores)


def test_the_seconds_of_stages_that_ran_are_told():
    assert tuple(made().seconds) == STAGES
    without = made(sky_weight=0.0)
    assert tuple(without.seconds) == STAGES[1:]
    assert without.sky is None
    assert all(one > 0 for one in without.seconds.values())


def test_the_sky_model_sees_the_picture_without_its_frame():
    photo = np.zeros((200, 120, 3), np.uint8)
    photo[20:180] = SCENE.photo
    whole = sky_inside(SkyModel.small(), SCENE.photo, Frame())
    framed = sky_inside(SkyModel.small(), photo, Frame(top=20, bottom=20))
    assert np.allclose(framed[12:-12], whole, atol=1e-5)  # a frame of 20 rows is 12 of its regions
