"""What the kinds of scenes are made of."""

import numpy as np
import pytest

from skyline_viz.rendering.kinds import KINDS, compose
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.plain import Plain
from skyline_viz.rendering.terrain import Frame
from skyline_viz.rendering.water import Water

FRAME = Frame(640, 360)


def made(kind, seed=0):
    return compose(kind, FRAME, np.random.default_rng(seed))


@pytest.mark.parametrize("kind", KINDS)
def test_a_seed_decides(kind):
    assert made(kind, 5) == made(kind, 5)
    assert made(kind, 5) != made(kind, 6)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(4))
def test_every_view_can_be_drawn(kind, seed):
    view = made(kind, seed)
    assert view.layers
    assert np.linalg.norm(view.light.sun) == pytest.approx(1)
    assert view.light.sun[2] > 0  # no night
    assert 0 <= view.contrast <= 1
    assert view.grain >= 0
    grounds = [layer for layer in view.layers if isinstance(layer, Range | Plain | Water)]
    assert grounds
    for ground in grounds:
        assert 0 <= ground.haze <= 1
        assert 0 < (ground.top if isinstance(ground, Range) else ground.horizon) < 1


def test_kinds_keep_their_places():
    """Each is seeded by its place: a new one comes last."""
    first = ("clear", "hazy", "cloudy", "snow", "foreground", "spires", "desert", "rover")
    assert KINDS[:8] == first
    assert len(set(KINDS)) == len(KINDS) == 22
