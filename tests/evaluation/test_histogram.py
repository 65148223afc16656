"""The histogram: shares, and the picture."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from skyline_viz.evaluation.histogram import histogram, write_histogram
from testing.detections import result


@given(st.lists(st.floats(0, 1e4), min_size=1, max_size=20))
def test_shares_of_the_histogram_sum_to_one(errors):
    shares = histogram([result("a", error) for error in errors])
    assert shares.sum() == pytest.approx(1.0)
    assert shares[-1] == pytest.approx(np.mean(np.array(errors) >= 10))


def test_the_histogram_as_a_picture(tmp_path):
    few, many = tmp_path / "few.png", tmp_path / "many.png"
    write_histogram(few, {"edges": [result("a", 0.5)]}, "one photo")
    write_histogram(many, {"edges": [result("a", 0.5), result("b", 1e6)]}, "one photo")
    pictures = [np.asarray(Image.open(path).convert("RGB")) for path in (few, many)]
    assert pictures[0].shape == pictures[1].shape
    magenta = [(picture == (0xFF, 0x2D, 0x95)).all(axis=2).sum() for picture in pictures]
    assert magenta[0] == 0 < magenta[1]  # what is far off stands out


def test_a_histogram_of_nothing_is_empty():
    assert histogram([]).sum() == 0


def test_several_methods_stand_side_by_side_under_a_legend(tmp_path):
    results = {
        "default": [result("a", 0.5), result("b", 30.0)],
        "$odd_name": [result("a", 2.5)],
        "none": [],
    }
    write_histogram(tmp_path / "all.png", results, "two photos")
    write_histogram(tmp_path / "one.png", {"default": results["default"]}, "two photos")
    both, one = (Image.open(tmp_path / f"{name}.png").convert("RGB") for name in ("all", "one"))
    assert both.width > one.width
    colours = {colour for _, colour in both.getcolors(1 << 20)}
    assert (0x44, 0x01, 0x54) in colours  # the first of the methods
    assert (0x21, 0x91, 0x8C) in colours or len(colours) > 10
