"""The picture of stacked costs."""

import numpy as np

from skyline_viz.evaluation.stacked import _smooth as smooth
from skyline_viz.evaluation.stacked import stacked_columns


def test_stacked_costs_do_not_droop_at_the_rims():
    np.testing.assert_allclose(smooth(np.ones(30)), 1)
    assert len(smooth(np.arange(5.0))) == 5


def test_every_name_has_its_colour_in_the_picture():
    values = {"a": np.full(40, 2.0), "b": np.full(40, -1.0)}
    picture = stacked_columns({"one": values}, {"a": "#FF0000", "b": "#00FF00"})
    assert picture.dtype == np.uint8
    for colour in ((255, 0, 0), (0, 255, 0)):
        assert (picture == colour).all(axis=2).sum() > 1000
