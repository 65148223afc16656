"""Trees: rooted in terrain, they move the line; leaves from above do not."""

import numpy as np
import pytest

from skyline_viz.rendering.plants import Branches, Trees, draw_branches, draw_trees
from testing.level_ground import HORIZON, SUN, dice, level, noise


@pytest.mark.parametrize("shape", ["conifer", "crown", "bare"])
def test_trees_reach_above_the_line(shape):
    picture = level()
    draw_trees(picture, noise(), dice(), Trees(shape, 3, 0.9, 0.8), SUN)
    rows = picture.line()
    assert rows.min() < HORIZON - 5
    assert np.count_nonzero(rows == HORIZON) > 20
    assert picture.photo[:HORIZON][picture.cover[:HORIZON] > 0.95].max() < 0.5
    assert not picture.hidden.any()


def test_trees_on_the_crest_stand_on_it_and_not_on_each_other():
    picture = level()
    draw_trees(picture, noise(), dice(), Trees("conifer", 60, 0.0, 0.1), SUN)
    rows = picture.line()
    assert rows.min() >= HORIZON - 9
    assert rows.mean() < HORIZON - 0.5


@pytest.mark.parametrize("side", [-1, 1])
def test_leaves_from_above_come_from_their_side(side):
    picture = level()
    draw_branches(picture, noise(), Branches(side, 0.5), SUN)
    assert (picture.line() == HORIZON).all()
    near, far = picture.hidden[:20, :30].mean(), picture.hidden[:20, -30:].mean()
    assert (far > near + 0.2) if side == 1 else (near > far + 0.2)
