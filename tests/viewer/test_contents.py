"""What a recording holds: told by the detection and by how much is kept."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.methods.gradient import GradientCost
from skyline_viz.viewer.contents import Contents, MethodContents, fidelity_of


@pytest.fixture(scope="module")
def photo():
    photo = np.full((40, 60, 3), 200, np.uint8)
    photo[25:] = 60
    return photo


def test_a_full_recording_of_ours_holds_terms_and_the_bank(photo):
    found = sv.Detector().detect(photo)
    contents = Contents.of(found, "full", truth=True)
    assert (contents.height, contents.width, contents.truth, contents.bank) == (40, 60, True, True)
    assert {"edges", "strength", "score", "bin"} <= {one.name for one in contents.stages}
    assert "clear sky" in {one.name for one in contents.terms}


def test_a_lean_one_holds_neither(photo):
    contents = Contents.of(sv.Detector().detect(photo), "lean")
    assert (contents.bank, contents.terms) == (False, ())


def test_other_methods_have_no_bank_and_where_all_pixels_are_edges_none_are_shown(photo):
    found = GradientCost().detect(photo)
    assert not Contents.of(found, "full").bank
    assert found.edges.all()
    assert "edges" not in {one.name for one in MethodContents.of(found).stages}
    full = Contents.of(found, "full")
    assert "edges" not in {one.name for one in full.stages}
    assert "no edge" not in {one.name for one in full.terms}


def test_how_much_is_kept_goes_by_the_pixels():
    assert fidelity_of(10) == "full"
    assert fidelity_of(10, full_megapixels=1e-6) == "lean"
