"""Shapes with labels: which of them are lines, sky or terrain, and values that are none."""

import numpy as np
import pytest

from annotate.formats.drawings import (
    Shape,
    Wanted,
    labels_found,
)
from skyline_viz.datasets.coco import list_of, side_of, size_of_drawing, text_of
from skyline_viz.datasets.outlines import FormatError


def kinds(wanted):
    """What each of some shapes is taken for."""
    found = {}
    for label in ("skyline", "Horizon ", "sky", "SKY", "rock"):
        for kind in ("line", "polygon", "mask", "box"):
            shape = Shape(label, kind)
            said = [
                what for what in ("line", "sky", "terrain") if getattr(wanted, f"is_{what}")(shape)
            ]
            assert wanted.takes(shape) == bool(said)
            if said:
                found[label, kind] = said
    return found


def test_the_usual_labels_count_without_case():
    assert kinds(Wanted.of()) == {
        ("skyline", "line"): ["line"],
        ("Horizon ", "line"): ["line"],
        ("sky", "polygon"): ["sky"],
        ("sky", "mask"): ["sky"],
        ("SKY", "polygon"): ["sky"],
        ("SKY", "mask"): ["sky"],
    }
    assert Wanted.of().said == "a line skyline or horizon or a region sky"


def test_other_labels_take_the_place_of_the_usual_ones():
    assert kinds(Wanted.of(terrain="Rock")) == {
        ("rock", "polygon"): ["terrain"],
        ("rock", "mask"): ["terrain"],
    }
    assert kinds(Wanted.of(label="rock")) == {
        ("rock", "line"): ["line"],
        ("rock", "polygon"): ["sky"],
        ("rock", "mask"): ["sky"],
    }
    assert Wanted.of(terrain="rock").said == "a region rock of terrain"


def test_what_was_found_is_listed_the_most_frequent_first():
    shapes = [
        Shape("tree", "box"),
        Shape("tree", "box"),
        Shape(" ", "line"),
        Shape("x" * 99, "line"),
    ]
    said = labels_found(shapes)
    assert said.startswith("tree (2 boxes), (no name) (1 line), ")
    assert "x" * 61 not in said
    assert labels_found([]) == "none"


@pytest.mark.parametrize("side", [None, "a", 0, -3, 10**6, float("inf"), float("nan"), True, []])
def test_what_is_no_side_of_a_photo_is_refused(side):
    with pytest.raises(FormatError):
        side_of(side)


def test_sides_may_be_text_and_may_be_missing():
    assert side_of("480") == 480
    assert size_of_drawing(480, 640) == (480, 640)
    assert size_of_drawing(None, 640) is None
    assert size_of_drawing(480, None) is None


def test_values_of_another_kind_are_refused_by_name():
    assert text_of("a", "its label") == "a"
    assert list_of([1], "its points") == [1]
    for check in (text_of, list_of):
        with pytest.raises(FormatError, match="its points is no"):
            check(np.zeros(3), "its points")
