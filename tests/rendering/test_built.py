"""Houses move the line, masts hide it, wires do neither."""

import numpy as np
import pytest

from skyline_viz.rendering.built import Houses, Wires, draw_built
from testing.level_ground import HORIZON, SUN, dice, level, noise


def drawn(spec, seed=1):
    picture = level()
    draw_built(picture, noise(seed), dice(seed), spec, SUN)
    return picture


@pytest.mark.parametrize("spec", [Houses(3, 0.6, 0.5, towers=1), Houses(3, 0.6, 0.5, flat=True)])
def test_houses_are_terrain(spec):
    picture = drawn(spec)
    rows = picture.line()
    assert rows.min() < HORIZON - 5
    assert (rows <= HORIZON).all()
    assert not picture.hidden.any()


def test_lamps_are_lit():
    dark, lit = (drawn(Houses(3, 0.8, 0.5, flat=True, lamps=part)) for part in (0.0, 1.0))
    assert lit.photo.mean() > dark.photo.mean()


def test_wires_are_seen_and_leave_the_line():
    picture = drawn(Wires(0.2, count=2))
    changed = (picture.photo != level().photo).any(axis=2)
    assert (changed.sum(axis=0) >= 2).all()
    assert (picture.line() == HORIZON).all()
    assert not picture.hidden.any()


def test_masts_hide_a_few_columns():
    picture = drawn(Wires(0.2, masts=2))
    assert (picture.line() == HORIZON).all()
    assert 1 <= np.count_nonzero(picture.hidden[HORIZON] > 0.5) < 12
