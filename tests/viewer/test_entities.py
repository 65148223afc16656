"""Entity paths, which are part of the interface."""

import re

from skyline_viz.stage import Quantity
from skyline_viz.viewer import entities
from skyline_viz.viewer.entities import below, of_quantity

PATHS = {
    name: value
    for name, value in vars(entities).items()
    if name.isupper() and isinstance(value, str)
}


def test_they_differ_and_are_plain():
    assert len(set(PATHS.values())) == len(PATHS)
    for path in PATHS.values():
        assert re.fullmatch(r"[a-z0-9_]+(/[a-z0-9_]+)*", path)


def test_no_stage_lies_below_another():
    stages = ("PHOTO", "EDGES", "STRENGTH", "COHERENCE", "BIN", "SCORE", "COST", "DETOUR")
    for one in stages:
        for other in stages:
            assert not PATHS[one].startswith(f"{PATHS[other]}/")


def test_maps_and_parents():
    assert of_quantity(Quantity("sky  probability", group="maps")) == "maps/sky__probability"
    assert below(entities.OTHER, entities.SCORE) == "other/score"
    assert below("", entities.SCORE) == entities.SCORE
