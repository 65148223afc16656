"""Terms of the cost: each against plain Python, and its pixels against its map."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.terms import (
    ClearSky,
    EdgeTerm,
    GivenEdges,
    GivenOthers,
    Link,
    MapTerm,
    NoEdge,
    Sky,
    Term,
)
from testing.examples import examples

STEADY = examples(60)


def some_edges(seed, height=16, width=22):
    return np.random.default_rng(seed).random((height, width)) < 0.3


def slow_clear_sky(edges, weight):
    """Weighted mean number of edge pixels more than 3 rows above, over 9 columns, up to 1."""
    height, width = edges.shape
    added = np.zeros(edges.shape)
    for row in range(height):
        for column in range(width):
            window = edges[: max(row - 3, 0), max(column - 4, 0) : column + 5]
            added[row, column] = min(weight * window.sum() / window.shape[1], 1)
    return added


def clear_sky(edges, weight):
    return ClearSky(name="clear sky", weight=weight, edges=edges).map()


# All of them


def terms(edges):
    rng = np.random.default_rng(0)
    good = rng.random(edges.sum()).astype(np.float32)
    values = rng.random(edges.shape).astype(np.float32)
    score = EdgeTerm(name="score", weight=0.5, edges=edges, good=good)
    return [
        score,
        NoEdge(name="no edge", weight=2.0, edges=edges),
        ClearSky(name="clear sky", weight=0.1, edges=edges),
        MapTerm(name="map", weight=3.0, edges=edges, values=values),
        GivenEdges(name="edge", weight=1.0, edges=edges, cost=values, score=score),
        GivenOthers(name="others", weight=1.0, edges=edges, cost=values),
        Sky(name="sky", weight=3.0, edges=edges, sky=values[:5, :6], cap=0.7),
    ]


@pytest.mark.parametrize("number", range(7))
def test_pixels_pay_what_the_map_says(number):
    edges = some_edges(1)
    term = terms(edges)[number]
    rows, columns = np.indices(edges.shape).reshape(2, -1)
    np.testing.assert_allclose(term.at(rows, columns), term.map().ravel(), atol=1e-6)
    line = np.arange(22) % 16
    np.testing.assert_allclose(term.along(line), term.map()[line, np.arange(22)], atol=1e-6)
    if term.paid_by == "edges":
        np.testing.assert_allclose(term.of_edges(), term.map()[edges], atol=1e-6)
        assert not term.map()[~edges].any()
    elif term.paid_by == "others":
        assert not term.map()[edges].any()


def test_a_term_says_what_it_adds_and_all_else_follows():
    class One(Term):
        def add(self, cost):
            cost += self.weight

    term = One(name="one", weight=2.0, edges=some_edges(1))
    assert (term.map() == 2).all()
    assert term.answer(some_edges(2), 0) is None
    assert not One(name="one", weight=0.0, edges=some_edges(1)).map().any()
    with pytest.raises(NotImplementedError):
        Term(name="none", weight=1.0, edges=some_edges(1)).map()


def test_a_line_pays_for_each_change_of_row():
    paid = Link(weight=0.5, delta=4).along(np.array([3, 3, 5, 4], np.int32))
    assert paid.tolist() == [0, 0, 1, 0.5]


# Clear sky


@STEADY
@given(st.integers(1, 16), st.integers(1, 22), st.integers(0, 2**32 - 1), st.floats(0.001, 2))
def test_clear_sky_against_plain_python(height, width, seed, weight):
    edges = some_edges(seed, height, width)
    added = clear_sky(edges, weight)
    assert np.allclose(added, slow_clear_sky(edges, weight), rtol=1e-4, atol=1e-5)


def test_an_edge_is_felt_four_rows_below():
    edges = np.zeros((12, 30), bool)
    edges[2, 15] = True
    added = clear_sky(edges, 0.9)
    assert np.flatnonzero(added.any(axis=1)).tolist() == list(range(6, 12))
    assert np.flatnonzero(added.any(axis=0)).tolist() == list(range(11, 20))
    assert np.allclose(added[6:, 11:20], 0.1)


def test_a_sky_full_of_clouds_costs_no_more_than_a_pixel_without_an_edge():
    edges = np.ones((40, 20), bool)
    added = clear_sky(edges, 0.1)
    assert (np.diff(added[4:14], axis=0) > 0.09).all()
    assert (added[14:] == 1).all()


def test_columns_outside_the_photo_are_no_clear_sky():
    edges = np.zeros((9, 20), bool)
    edges[1] = True
    added = clear_sky(edges, 0.5)
    assert np.allclose(added[5:], 0.5)
    assert (added[:5] == 0).all()


# Sky


def slow_sky(sky, height, width, weight, cap):
    """What pixels pay, by adding up the improbable parts of each column row by row."""
    regions, across = sky.shape
    centres = (np.arange(across) + 0.5) * width / across - 0.5
    column_of = np.array([np.interp(np.arange(width), centres, line) for line in sky]).T
    paid = np.empty((height, width))
    for column in range(width):
        for row in range(height):
            line = row / height  # the upper side of the row, in heights of the photo
            total = 0.0
            for region in range(regions):
                first, last = region / regions, (region + 1) / regions
                above = min(max(line - first, 0), last - first)
                p = column_of[column, region]
                total += above * (1 - p) + (last - first - above) * p
            paid[row, column] = weight * total
        paid[:, column] -= paid[:, column].min()
    return np.minimum(paid, cap)


def sky_map(sky, height, width, weight=1.0, cap=1e6):
    edges = np.zeros((height, width), bool)
    sky = np.asarray(sky, np.float32)
    return Sky(name="sky", weight=weight, edges=edges, sky=sky, cap=cap).map()


@STEADY
@given(
    st.tuples(st.integers(1, 23), st.integers(1, 19), st.integers(1, 7), st.integers(1, 6)),
    st.integers(0, 2**32 - 1),
    st.floats(0.001, 9),
    st.floats(0, 3),
)
def test_sky_against_plain_python(sizes, seed, weight, cap):
    height, width, regions, across = sizes
    sky = np.random.default_rng(seed).random((regions, across)).astype(np.float32)
    paid = sky_map(sky, height, width, weight, cap)
    np.testing.assert_allclose(paid, slow_sky(sky, height, width, weight, cap), atol=2e-5)


@STEADY
@given(st.integers(2, 90), st.integers(1, 60), st.integers(1, 12), st.integers(0, 2**32 - 1))
def test_sky_costs_nothing_at_the_best_row_and_never_more_than_the_cap(height, width, across, seed):
    sky = np.random.default_rng(seed).random((across + 3, across)).astype(np.float32)
    paid = sky_map(sky, height, width, 5.0, 0.4)
    assert (paid.min(axis=0) == 0).all()
    assert paid.max() <= np.float32(0.4)


def test_a_sure_map_is_cheapest_where_sky_ends_and_every_height_beyond_costs_the_weight():
    sky = np.repeat([[1.0], [1.0], [0.0], [0.0]], 3, axis=1)
    paid = sky_map(sky, 40, 30, weight=8.0)
    assert (paid.argmin(axis=0) == 20).all()
    assert paid[20].tolist() == [0] * 30
    assert np.allclose(paid[25], 1)  # an eighth of the height
    assert np.allclose(paid[0], 4)
    unsure = sky_map(np.full((4, 3), 0.5), 40, 30, weight=8.0)
    assert not unsure.any()
