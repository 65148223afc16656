"""The fused search: rows and costs to the bit those of the equation, written down plainly."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.cheapest import EVERY, MOST, cheapest
from testing.examples import examples


def plainly(columns, reach, link_weight):
    """Dynamic programming a column at a time, with the whole table at hand."""
    width, height = columns.shape
    table = columns.astype(np.float64)
    near = np.arange(height)
    for column in range(1, width):
        least = table[column - 1].copy()
        for change in range(1, reach + 1):
            link = link_weight * change
            least[:-change] = np.minimum(least[:-change], table[column - 1, change:] + link)
            least[change:] = np.minimum(least[change:], table[column - 1, :-change] + link)
        table[column] += least
    end = min(near, key=lambda row: (table[-1, row], abs(2 * row - height), row))
    rows = [end]
    for column in range(width - 2, -1, -1):
        row = rows[-1]
        changes = [0] + [sign * one for one in range(1, reach + 1) for sign in (-1, 1)]
        options = [row + one for one in changes if 0 <= row + one < height]
        paid = [table[column, one] + link_weight * abs(one - row) for one in options]
        rows.append(options[int(np.argmin(paid))])
    return rows[::-1], table[-1, end]


@examples(40)
@given(
    st.integers(1, 5 * EVERY + 3),
    st.integers(2, 160),
    st.integers(1, MOST),
    st.sampled_from([0.0, 0.1, 1.0, 7.3]),
    st.integers(0, 2**32 - 1),
    st.sampled_from([2, 4, 1000]),
    st.sampled_from([np.float32, np.float64]),
)
def test_agrees_with_the_plain_search(width, height, reach, link_weight, seed, values, kind):
    """Of few values are costs with many ties."""
    rng = np.random.default_rng(seed)
    columns = (rng.integers(0, values, (width, height)) / (values - 1)).astype(kind)
    reach = min(reach, height - 1)
    rows, cost = cheapest(columns, reach, link_weight)
    expected, total = plainly(columns, reach, link_weight)
    assert rows.tolist() == expected
    assert cost == total


@examples(60)
@given(st.integers(2, 3 * EVERY), st.integers(2, 30), st.integers(0, 2**32 - 1))
def test_forbidden_pixels_are_not_visited(width, height, seed):
    rng = np.random.default_rng(seed)
    columns = rng.random((width, height))
    columns[rng.random(columns.shape) < 0.3] = np.inf
    with np.errstate(invalid="ignore"):
        expected, total = plainly(columns, 1, 0.1)
    rows, cost = cheapest(columns, 1, 0.1)
    assert cost == total
    if np.isfinite(total):
        assert rows.tolist() == expected


@pytest.mark.parametrize("reach", [1, MOST])
def test_a_path_goes_as_steep_as_it_may(reach):
    width = 4 * EVERY
    columns = np.full((width, width * reach + 1), 5.0, np.float32)
    line = np.abs(np.arange(width) - width // 2) * reach
    columns[np.arange(width), line] = 0
    rows, cost = cheapest(columns, reach, 0.0)
    assert np.array_equal(rows, line)
    assert cost == 0
