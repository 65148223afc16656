"""What the kinds of scenes are made of."""

import numpy as np
import pytest

from skyline_viz.rendering.kinds import KINDS, compose
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.plain import Plain
from skyline_viz.rendering.terrain import Frame

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
    assert view.terrain
    assert np.linalg.norm(view.light.sun) == pytest.approx(1)
    assert view.light.sun[2] > 0  # no night
    assert 0 <= view.contrast <= 1
    assert view.grain >= 0
    for ground in view.terrain:
        assert isinstance(ground, Range | Plain)
        assert 0 <= ground.haze <= 1
        assert 0 < (ground.top if isinstance(ground, Range) else ground.horizon) < 1


def test_what_a_kind_is_called_after_is_there():
    for seed in range(4):
        assert made("cloudy", seed).sky.heaps > made("clear", seed).sky.heaps
        assert any(one.towers > 0 for one in made("spires", seed).terrain)
        assert {one.cover for one in made("snow", seed).terrain} & {"snow"}
        assert any(isinstance(one, Plain) for one in made("rover", seed).terrain)
        far = max(one.haze for one in made("hazy", seed).terrain)
        assert far > max(one.haze for one in made("clear", seed).terrain)
