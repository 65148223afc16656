"""The geometry of drawn labels: which pixels a polygon holds, and which rows a line has."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.datasets.outlines import line_rows, polygon_mask
from testing.examples import examples


@examples(30)
@given(
    data=st.data(),
)
def test_polygons_mean_the_pixels_whose_centres_they_hold(data):
    place = st.floats(-20, 60, allow_nan=False).map(lambda one: round(one, 2) + 0.003)
    points = data.draw(st.lists(st.tuples(place, place), min_size=3, max_size=8))
    mask, _ = polygon_mask([np.array(points)], 30, 40)
    for row, column in [(r, c) for r in range(0, 30, 3) for c in range(0, 40, 3)]:
        x, y = column + 0.5, row + 0.5
        crossed = [
            y0 + (x - x0) / (x1 - x0) * (y1 - y0)
            for (x0, y0), (x1, y1) in zip(points, [*points[1:], points[0]], strict=True)
            if (x0 <= x) != (x1 <= x)
        ]
        if all(abs(y - one) > 1e-6 for one in crossed):  # a centre on an edge may be either
            assert mask[row, column] == (sum(y > one for one in crossed) % 2 == 1)


@pytest.mark.parametrize(("height", "row"), [(20.4, 20), (20.5, 21), (20.6, 21), (0.2, 0)])
def test_rows_of_a_line_are_whole_and_the_nearest(height, row):
    rows, reached = line_rows([np.array([[0.0, height], [9.0, height]])], 48, 9)
    assert reached.all()
    assert set(rows) == {row}
