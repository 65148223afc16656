"""Nodal costs in one pass: those of the terms, written down plainly one after the other."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.frames.boundary import between_centres
from skyline_viz.kernels.nodal import BAND, WINDOW, Clear, Improbable, Own, nodal_costs
from testing.examples import examples


def plainly(edges, values, elsewhere, clear, sky):
    """With numpy, a term at a time; rounded where the loops round."""
    height, width = edges.shape
    cost = np.full(edges.shape, elsewhere, np.float32)
    cost[edges] = values
    half = WINDOW // 2
    padded = np.pad(edges, ((0, 0), (half, half))).astype(np.int64)
    window = sum(padded[:, shift : shift + width] for shift in range(WINDOW))
    above = np.zeros(edges.shape, np.int64)
    above[clear.rows + 1 :] = np.cumsum(window, axis=0)[: max(height - clear.rows - 1, 0)]
    column = np.arange(width)
    inside = np.minimum(column + half, width - 1) - np.maximum(column - half, 0) + 1
    step = (clear.weight / inside.astype(np.float32)).astype(np.float64)
    cost = (cost + np.minimum(step * above, np.float64(clear.cap))).astype(np.float32)
    here, there = sky.borders[sky.left], sky.borders[sky.right]
    lines = (here + sky.sideways[:, None] * (there - here)).T
    places = np.arange(height) * (len(lines) - 1) / height
    region = places.astype(int)
    within = (places - region).astype(np.float32)[:, None]
    pays = lines[region] + within * (lines[region + 1] - lines[region])
    return cost + np.minimum(pays - pays.min(axis=0), sky.cap)


@st.composite
def problems(draw):
    height, width = draw(st.integers(1, 3 * BAND)), draw(st.integers(1, 40))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    edges = rng.random((height, width)) < draw(st.floats(0, 1))
    values = rng.random(edges.sum(), np.float32)
    weight, cap = draw(st.sampled_from([0.0, 0.03, 0.9])), draw(st.sampled_from([0.4, 1.0]))
    clear = Clear(np.float32(weight), np.float32(cap), draw(st.integers(0, 5)))
    map_rows, map_columns = draw(st.integers(1, 100)), draw(st.integers(1, 20))
    borders = rng.normal(0, 3, (map_columns, map_rows + 1)).astype(np.float32)
    sky = Improbable(borders, *between_centres(width, map_columns), np.float32(cap))
    return edges, values, clear, sky


@examples(150)
@given(problems())
def test_agrees_with_numpy_to_the_bit(problem):
    edges, values, clear, sky = problem
    own = Own(*(one.astype(np.int32) for one in np.nonzero(edges)), values)
    found = nodal_costs(edges, own, 2.0, clear, sky)
    assert found.dtype == np.float32
    assert found.flags.c_contiguous
    assert np.array_equal(found.T, plainly(edges, values, 2.0, clear, sky))


@pytest.mark.parametrize("height", [1, BAND - 1, BAND, BAND + 1, 3 * BAND])
def test_without_terms_all_pay_the_same(height):
    edges = np.ones((height, 5), np.bool_)
    assert (nodal_costs(edges, None, 2.0) == 2).all()


def test_a_view_of_an_edge_map_will_do():
    edges = np.random.default_rng(0).random((50, 30)) < 0.3
    clear = Clear(np.float32(0.5), np.float32(1), 3)
    part = edges[::2, 3:20]
    found = nodal_costs(part, None, 0.0, clear)
    assert np.array_equal(found, nodal_costs(part.copy(), None, 0.0, clear))
    assert found.any()
