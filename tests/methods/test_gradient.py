"""The gradient cost."""

import numpy as np
import pytest

from skyline_viz.edges import to_grey
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.methods.gradient import GradientCost, gradient_cost
from skyline_viz.rendering import render


@pytest.fixture(scope="module")
def even_scene():
    return render("cloudy", 3, 480, 270)


def test_gradient_cost_is_the_equation():
    photo = np.random.default_rng(0).integers(0, 256, (7, 9, 3), dtype=np.uint8)
    grey = np.pad(to_grey(photo).astype(np.float64), 1, mode="reflect")
    across, down = np.zeros((2, 7, 9))
    for row in range(7):
        for column in range(9):
            part = grey[row : row + 3, column : column + 3]
            across[row, column] = (part * np.outer((1, 2, 1), (-1, 0, 1))).sum()
            down[row, column] = (part * np.outer((-1, 0, 1), (1, 2, 1))).sum()
    strength = np.hypot(across, down)
    change = np.abs(strength - np.column_stack([strength[:, 1:], strength[:, -1:]]))
    wanted = 0.3 * change / change.max() + 0.7 * (1 - strength / strength.max())
    assert gradient_cost(photo, 0.3, 0) == pytest.approx(wanted, abs=1e-5)


def test_gradient_finds_an_easy_skyline_and_scores_what_it_costs(even_scene):
    detection = GradientCost().detect(even_scene.photo)
    assert a_err(detection.skyline, even_scene.truth) < 2
    assert detection.edges.all()
    assert detection.cost.ravel() == pytest.approx(1 - detection.scores, abs=1e-6)
