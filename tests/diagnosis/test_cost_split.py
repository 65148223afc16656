"""What a line pays for, column by column."""

import numpy as np
import pytest

from skyline_viz.diagnosis.cost_split import split_cost


def test_the_parts_of_a_cost_add_up_to_the_whole(hazy):
    detection, truth = hazy
    split = split_cost(detection, detection.skyline.rows.astype(np.int32))
    whole = sum(split.totals(0, truth.width - 1).values())
    assert whole == pytest.approx(detection.path_cost, rel=1e-5)
    other = split_cost(detection, truth.rows.astype(np.int32))
    assert sum(other.totals(0, truth.width - 1).values()) > whole
    assert (np.abs(split.stages["score"]) <= 1).all()
