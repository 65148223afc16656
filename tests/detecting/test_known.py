"""What is taken from another detection: the same pixels, to the bit."""

from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.detecting.known import looks_of, places_among
from skyline_viz.detector import Detector
from skyline_viz.edges import edge_pixels
from skyline_viz.rendering import render


@pytest.fixture(scope="module")
def found():
    return Detector().detect(render("desert", 3, 240, 180).photo)


def test_places_are_those_of_the_same_pixels():
    rng = np.random.default_rng(0)
    some, others = (edge_pixels(rng.random((20, 30)) < share) for share in (0.3, 0.5))
    known = [(row, column) for row, column in zip(*others, strict=True)]
    wanted = [known.index(one) if one in known else -1 for one in zip(*some, strict=True)]
    assert places_among(some, others).tolist() == wanted


def test_known_and_new_pixels_look_as_if_all_were_new(found):
    edges = found.edges ^ (np.random.default_rng(1).random(found.edges.shape) < 0.1)
    pixels = edge_pixels(edges)
    joined, anew = (
        looks_of(found.photo, pixels, found.bank, {}, found=one) for one in (found, None)
    )
    for name in ("strength", "coherence", "orientation"):
        assert np.array_equal(getattr(joined.tensor, name), getattr(anew.tensor, name))
    assert np.array_equal(joined.bins, anew.bins)
    assert np.array_equal(joined.scores, anew.scores)


@pytest.mark.parametrize(
    "changes", [{"frame": 0}, {"sky_edges": 1.0}, {"low_threshold": 30.0}, {"v": 0.2}, {"delta": 2}]
)
def test_rows_again_are_those_of_a_detection(found, changes):
    other = replace(found.detector, config=replace(found.config, **changes))
    assert np.array_equal(other.rows_again(found), other.detect(found.photo).skyline.rows)


def test_what_comes_out_the_same_is_taken_over(found):
    assert found.frame.inside(found.photo)[1] == slice(0, 240)
    again = found.again(replace(found.config, frame=0))
    assert again.cost is found.cost
    assert again.scores is found.scores


def test_quantities_are_those_of_the_stages(found):
    without = found.again(replace(found.config, sky_weight=0.0))
    for one in (found, without):
        assert one.quantities == tuple(stage.quantity for stage in one.stages.values())
