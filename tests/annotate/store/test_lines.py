"""Lines as they are kept: exactly, and small."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from annotate.store.lines import Line
from skyline_viz.skyline import Skyline


@given(
    rows=st.lists(st.integers(0, 5000), min_size=1, max_size=50),
    data=st.data(),
)
def test_lines_are_kept_exactly(rows, data):
    width = len(rows)
    visible = data.draw(st.lists(st.booleans(), min_size=width, max_size=width))
    origin = data.draw(st.lists(st.integers(0, 3), min_size=width, max_size=width))
    line = Line(Skyline(rows=rows, visible=np.array(visible)), np.array(origin, np.uint8))
    kept = Line.unpacked(line.packed())
    assert kept.skyline == line.skyline
    np.testing.assert_array_equal(kept.origin, line.origin)


def test_a_line_of_a_photograph_takes_a_few_hundred_bytes():
    rows = 300 + np.cumsum(np.random.default_rng(0).integers(-2, 3, 1388))
    line = Line(Skyline(rows=rows), np.zeros(1388, np.uint8))
    assert len(line.packed()) < 1000
