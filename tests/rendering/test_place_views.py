"""Views of other places."""

import numpy as np
import pytest

from skyline_viz.rendering import place_views
from skyline_viz.rendering.built import Houses
from skyline_viz.rendering.people import People
from skyline_viz.rendering.plain import Plain
from skyline_viz.rendering.plants import Trees
from skyline_viz.rendering.terrain import Frame
from skyline_viz.rendering.views import Choice
from skyline_viz.rendering.water import Water

FRAME = Frame(640, 360)


def made(view, seed=0):
    return view(Choice(FRAME, np.random.default_rng(seed)))


@pytest.mark.parametrize(
    ("view", "layer"),
    [
        (place_views.sea, Water),
        (place_views.lake, Water),
        (place_views.conifers, Trees),
        (place_views.grove, Trees),
        (place_views.village, Houses),
        (place_views.hikers, People),
        (place_views.aerial, Plain),
    ],
)
@pytest.mark.parametrize("seed", range(4))
def test_what_a_kind_is_called_after_is_there(view, layer, seed):
    assert any(isinstance(one, layer) for one in made(view, seed).layers)


def test_from_an_aircraft_the_horizon_is_steep_in_some():
    assert max(abs(made(place_views.aerial, seed).camera.roll) for seed in range(8)) > 0.1
