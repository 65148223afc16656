"""Views of mountains by day."""

import numpy as np

from skyline_viz.rendering import mountain_views
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.plain import Plain
from skyline_viz.rendering.terrain import Frame
from skyline_viz.rendering.views import Choice

FRAME = Frame(640, 360)


def made(view, seed=0):
    return view(Choice(FRAME, np.random.default_rng(seed)))


def test_what_a_kind_is_called_after_is_there():
    for seed in range(4):
        assert (
            made(mountain_views.cloudy, seed).sky.heaps > made(mountain_views.clear, seed).sky.heaps
        )
        assert any(
            one.towers > 0
            for one in made(mountain_views.spires, seed).layers
            if isinstance(one, Range)
        )
        assert {one.cover for one in made(mountain_views.snow, seed).layers} & {"snow"}
        assert any(isinstance(one, Plain) for one in made(mountain_views.rover, seed).layers)
        far = max(one.haze for one in made(mountain_views.hazy, seed).layers)
        assert far > max(ranges(made(mountain_views.clear, seed)))


def ranges(view):
    return [one.haze for one in view.layers if isinstance(one, Range)]
