"""The boundary of a map of sky: the share of a column that is improbable, and where it is least."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from skyline_viz.frames.boundary import boundary, improbable
from testing.examples import examples

MAPS = hnp.arrays(
    np.float32,
    st.tuples(st.integers(1, 12), st.integers(1, 9)),
    elements=st.floats(0, 1, width=32),
)


@given(MAPS)
@examples(60)
def test_what_is_improbable_is_terrain_above_and_sky_below(sky):
    borders = improbable(sky)
    assert borders.shape == (sky.shape[1], len(sky) + 1)
    for column, row in np.ndindex(borders.shape):
        above, below = sky[:row, column], sky[row:, column]
        share = ((1 - above).sum() + below.sum()) / len(sky)
        assert borders[column, row] == pytest.approx(share, abs=1e-5)


@given(MAPS, st.integers(1, 30), st.integers(1, 40))
@examples(60)
def test_the_boundary_is_a_border_of_regions_and_the_least_doubtful(sky, height, width):
    rows, doubt = boundary(sky, height, width)
    assert rows.shape == doubt.shape == (width,)
    assert ((rows >= 0) & (rows <= height)).all()
    borders = rows * len(sky) / height
    assert np.allclose(borders, np.rint(borders), atol=1e-4)
    assert (doubt >= -1e-6).all()
    assert (doubt <= 0.5 + 1e-6).all()  # all sky or all terrain is no worse than that
    first, last = sky[:, 0], sky[:, -1]  # the outermost columns are those of the outer regions
    for column, region in ((0, first), (width - 1, last)):
        if width >= sky.shape[1]:
            alone = improbable(region[:, None])[0]
            assert doubt[column] == pytest.approx(alone.min(), abs=1e-5)


@pytest.mark.parametrize(("sky", "row"), [(1.0, 50.0), (0.0, 0.0)])
def test_a_map_of_one_kind_has_its_boundary_at_a_rim(sky, row):
    rows, doubt = boundary(np.full((4, 3), sky, np.float32), 50, 30)
    assert (rows == row).all()
    assert (doubt == 0).all()
