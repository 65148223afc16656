"""What a sky model is judged by, and that it learns."""

import numpy as np
import pytest

from skyline_viz.sky_training.examples import COLUMNS, ROWS, Example
from testing.deep import needs_deep

pytestmark = needs_deep


@pytest.fixture
def fitting():
    pytest.importorskip("torch")
    from skyline_viz.sky_training import fitting  # noqa: PLC0415

    return fitting


def column(sky):
    import torch  # noqa: PLC0415

    return torch.tensor(sky, dtype=torch.float32).view(1, 1, -1, 1)


def test_the_right_row_is_judged_best(fitting):
    sky = column([1, 1, 1, 0, 0, 0])
    losses = [
        float(fitting.judged(column([4.0] * row + [-4.0] * (6 - row)), sky)) for row in range(7)
    ]
    assert int(np.argmin(losses)) == 3
    assert losses[3] < losses[2] < losses[1] < losses[0]


def test_a_second_ridge_costs_more_than_its_regions(fitting):
    """Wrong regions that move the line are worse than as many that do not."""
    sky = column([1.0] * 6 + [0.0] * 6)
    moved = column([4.0] * 3 + [-4.0] * 9)  # three regions of sky called terrain, at the line
    spread = column([4.0, -4.0] * 3 + [-4.0] * 6)
    assert float(fitting.judged(moved, sky)) > float(fitting.judged(spread, sky))


def test_a_photo_without_a_line_is_judged_region_by_region(fitting):
    import torch  # noqa: PLC0415

    sky = column([0, 1, 1, 0, 1, 0])
    logits = column([-2.0, 2.0, 1.0, -1.0, 3.0, 0.5])
    alone = torch.nn.functional.binary_cross_entropy_with_logits(logits, sky)
    assert float(fitting.judged(logits, sky)) == pytest.approx(float(alone))


def test_a_large_data_set_counts_for_more_but_not_for_all(fitting):
    blank = np.zeros((ROWS, COLUMNS, 3), np.uint8), np.zeros((ROWS, COLUMNS), np.uint8)
    few, many = [Example(*blank, "few")] * 4, [Example(*blank, "many")] * 16
    share = fitting.shares(few + many)
    assert share.sum() == pytest.approx(1)
    assert share[4:].sum() == pytest.approx(2 * share[:4].sum())
