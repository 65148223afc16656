"""What a diagnosis found in a segment, in sentences."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.rendering import render
from testing.injected import cases, main_cause


@pytest.fixture(scope="module")
def hazy():
    scene = render("hazy", 1)
    return sv.Detector().detect(scene.photo), scene.truth


@pytest.fixture(scope="module")
def flat():
    """A photo with a level ridge in row 60, and its detection, which is right."""
    photo = np.full((120, 300, 3), 200, np.uint8)
    photo[60:] = 60
    return sv.Detector().detect(photo)


def test_evidence_says_which_columns_it_counts(flat):
    (one,) = cases("missed edge", 1)
    segment = main_cause(one)
    case = Case(one.detection, one.truth, 4.0)
    reach = case.excursion(*segment.columns)
    assert reach != segment.columns
    assert segment.evidence.startswith(
        f"Between columns {reach[0]} and {reach[1]}, where the path leaves the truth, the truth "
    )
