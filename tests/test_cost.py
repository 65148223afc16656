"""Nodal costs: the formula at edges, the constant elsewhere, and the clear-sky term."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.cost import add_blocks, edge_cost, nodal_cost, normalised
from testing.examples import examples

STEADY = examples(60)


def float32(*values):
    return np.array(values, np.float32)


def cost_of(edges, at_edges, non_edge=2.0, clear_sky=0.0):
    return nodal_cost(edges, at_edges, non_edge, clear_sky)


def slow_clear_sky(edges, weight):
    """Weighted mean number of edge pixels more than 3 rows above, over 9 columns."""
    height, width = edges.shape
    added = np.zeros(edges.shape)
    for row in range(height):
        for column in range(width):
            window = edges[: max(row - 3, 0), max(column - 4, 0) : column + 5]
            added[row, column] = weight * window.sum() / window.shape[1]
    return added


# Strength


def test_full_strength_is_a_percentile_of_the_photos_own():
    strength = np.arange(1, 102).astype(np.float32)
    found = normalised(strength, 95)
    assert found.dtype == np.float32
    assert np.allclose(found, np.minimum(strength / 96, 1))
    assert normalised(strength, 100)[-1] == 1
    assert normalised(strength, 100)[0] == pytest.approx(1 / 101)


@STEADY
@given(
    st.lists(st.floats(0, 1e6, width=32), min_size=1, max_size=20),
    st.floats(1, 100),
)
def test_normalised_strength_stays_between_0_and_1(values, percentile):
    found = normalised(float32(*values), percentile)
    assert found.dtype == np.float32
    assert 0 <= found.min() <= found.max() <= 1


@pytest.mark.parametrize("count", [0, 1, 5])
def test_no_strength_at_all(count):
    found = normalised(np.zeros(count, np.float32), 95)
    assert found.dtype == np.float32
    assert found.tolist() == [0] * count


def test_mostly_zero_strength():
    found = normalised(np.append(np.zeros(99), 5).astype(np.float32), 50)
    assert found.tolist() == [0] * 100


# Edge pixels


@pytest.mark.parametrize(
    ("score", "strength", "v", "cost"),
    [
        (1, 1, 0.5, 0),
        (0, 0, 0.5, 1),
        (1, 0, 0.5, 0.5),
        (0.25, 0.5, 0.5, 0.625),
        (0.25, 0.5, 1, 0.75),
        (0.25, 0.5, 0, 0.5),
        (0.2, 0.9, 0.3, 0.31),
    ],
)
def test_score_and_strength_are_fused(score, strength, v, cost):
    found = edge_cost(float32(score), float32(strength), v)
    assert found.dtype == np.float32
    assert found[0] == pytest.approx(cost, abs=1e-6)


def test_costs_stand_at_their_edge_pixels():
    edges = np.zeros((5, 7), bool)
    edges[[0, 2, 4, 4], [6, 1, 0, 3]] = True
    cost = cost_of(edges, float32(0.1, 0.2, 0.3, 0.4), non_edge=2.5)
    assert cost.shape == (5, 7)
    assert cost.dtype == np.float32
    expected = np.full((5, 7), 2.5, np.float32)
    expected[[0, 2, 4, 4], [6, 1, 0, 3]] = float32(0.1, 0.2, 0.3, 0.4)
    assert np.array_equal(cost, expected)


def test_columns_lie_together_in_memory():
    assert cost_of(np.zeros((5, 7), bool), float32()).T.flags.c_contiguous


def test_without_edges_every_pixel_costs_the_same():
    cost = cost_of(np.zeros((30, 20), bool), float32(), non_edge=3, clear_sky=0.5)
    assert (cost == 3).all()


# Clear sky


@STEADY
@given(st.integers(1, 16), st.integers(1, 22), st.integers(0, 2**32 - 1), st.floats(0.001, 2))
def test_clear_sky_against_plain_python(height, width, seed, weight):
    rng = np.random.default_rng(seed)
    edges = rng.random((height, width)) < 0.3
    at_edges = rng.random(edges.sum()).astype(np.float32)
    plain = cost_of(edges, at_edges)
    added = cost_of(edges, at_edges, clear_sky=weight) - plain
    assert np.allclose(added, slow_clear_sky(edges, weight), rtol=1e-4, atol=1e-5)


def test_an_edge_is_felt_four_rows_below():
    edges = np.zeros((12, 30), bool)
    edges[2, 15] = True
    added = cost_of(edges, float32(2.0), clear_sky=0.9) - 2
    assert np.flatnonzero(added.any(axis=1)).tolist() == list(range(6, 12))
    assert np.flatnonzero(added.any(axis=0)).tolist() == list(range(11, 20))
    assert np.allclose(added[6:, 11:20], 0.1)


def test_columns_outside_the_photo_are_no_clear_sky():
    edges = np.zeros((9, 20), bool)
    edges[1] = True
    added = cost_of(edges, np.full(20, 2, np.float32), clear_sky=0.5) - 2
    assert np.allclose(added[5:], 0.5)
    assert (added[:5] == 0).all()


# Blocks


def slow_blocks(blocks, height, width, side):
    """Values of blocks interpolated between their centres, repeated beyond the outer ones."""
    rows = np.arange(len(blocks)) * side + (side - 1) / 2
    columns = np.arange(blocks.shape[1]) * side + (side - 1) / 2
    downwards = np.array([np.interp(np.arange(height), rows, column) for column in blocks.T])
    return np.array([np.interp(np.arange(width), columns, row) for row in downwards.T])


@pytest.mark.parametrize(
    ("height", "width", "side", "down", "right"),
    [(32, 40, 8, 4, 5), (35, 46, 8, 4, 5), (5, 6, 8, 1, 1), (9, 8, 4, 2, 2), (8, 31, 8, 1, 3)],
)
def test_blocks_are_interpolated_between_their_centres(height, width, side, down, right):
    rng = np.random.default_rng(height)
    blocks = rng.normal(size=(down, right)).astype(np.float32)
    cost = cost_of(rng.random((height, width)) < 0.1, np.float32(0.5), clear_sky=0.1)
    before = cost.copy()
    add_blocks(cost, blocks, 3.0, side)
    expected = 3 * slow_blocks(blocks, height, width, side)
    assert cost.shape == (height, width)
    assert np.allclose(cost - before, expected, atol=1e-4)


def test_blocks_of_one_value_move_every_pixel_alike():
    cost = cost_of(np.zeros((20, 30), bool), float32())
    add_blocks(cost, np.full((2, 3), -0.25, np.float32), 2.0, 8)
    assert np.allclose(cost, 1.5)
