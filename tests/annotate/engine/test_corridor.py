"""The cheapest line through a corridor, against a search of the whole photo."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from annotate.engine.corridor import follow
from skyline_viz.constraints import Constraints, PathError
from skyline_viz.path import path_tables, shortest_path
from testing.examples import examples

HEIGHT, WIDTH, LINK = 14, 30, 0.05


@examples(150)
@given(st.data())
def test_the_line_is_the_cheapest_that_keeps_to_the_corridor(data):
    cost = np.random.default_rng(data.draw(st.integers(0, 30))).random((HEIGHT, WIDTH))
    cost = cost.astype(np.float32)
    delta = data.draw(st.integers(1, 4))
    first = data.draw(st.integers(0, WIDTH - 1))
    last = data.draw(st.integers(first, WIDTH - 1))
    ends = [
        sorted(data.draw(st.tuples(st.integers(0, HEIGHT - 1), st.integers(0, HEIGHT - 1))))
        for _ in range(last - first + 1)
    ]
    tops, bottoms = np.array(ends, np.int32).T.copy()
    forbidden = np.zeros(cost.shape, np.bool_)
    for at, column in enumerate(range(first, last + 1)):
        forbidden[: tops[at], column] = forbidden[bottoms[at] + 1 :, column] = True
    tables = path_tables(cost, delta, LINK)
    before = tables.forward[:, first - 1].copy() if first else np.empty(0)
    after = tables.backward[:, last + 1].copy() if last + 1 < WIDTH else np.empty(0)
    rows = np.full(WIDTH, -1, np.int32)
    columns = np.ascontiguousarray(cost.T)
    paid = follow(columns, tops, bottoms, first, before, after, delta, LINK, rows)
    try:
        wanted = shortest_path(cost, delta, LINK, Constraints(forbidden=forbidden))
    except PathError:
        assert np.isinf(paid)
        assert (rows == -1).all()
        return
    np.testing.assert_allclose(paid, wanted.cost, rtol=1e-6)
    inside = rows[first : last + 1]
    assert ((tops <= inside) & (inside <= bottoms)).all()
    assert (np.abs(np.diff(inside)) <= delta).all()
    assert (np.delete(rows, slice(first, last + 1)) == -1).all()
