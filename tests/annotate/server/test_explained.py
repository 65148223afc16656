"""What the server answers about one pixel."""

import json

import numpy as np
import pytest

from annotate.server.explained import Explained
from skyline_viz.diagnosis.explanation import explain_pixel
from testing.labelling import DETECTOR, hills


def test_an_explanation_is_shown_whole():
    found = DETECTOR.detect(hills(3))
    told = explain_pixel(found, int(found.skyline.rows[40]), 40)
    shown = json.loads(Explained.of(told).model_dump_json())
    assert (shown["row"], shown["column"], shown["edge"]) == (told.row, told.column, told.edge)
    assert sum(shown["terms"].values()) == pytest.approx(shown["cost"], abs=1e-4)
    np.testing.assert_array_equal(shown["filtered"]["patch"], told.filtered.patch)
    assert shown["filtered"]["axes"] == pytest.approx(told.filtered.axes)
    assert np.shape(shown["colours"]) == told.colours.shape
