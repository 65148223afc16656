"""Where a truth may lie, and which photo it is of then."""

import pytest

import skyline_viz as sv
from testing.datasets import MASK, SKYLINE, names, only, put


@pytest.mark.parametrize(
    ("photo", "truth", "name"),
    [
        ("images/a.png", "labels/a.png", "a"),
        ("images/a.png", "masks/sky/a.png", "a"),
        ("images/a.png", "sky/a.png", "a"),
        ("photos/a.png", "annotations/a_mask.png", "a"),
        ("a.png", "a_mask.png", "a"),
        ("images/n1/original.png", "images/n1/mask.png", "n1"),
        ("images/n1/original.png", "masks/n1.png", "n1"),
        ("images/n1/original.png", "masks/n1/sky.png", "n1"),
        ("images/day/a.png", "masks/day/a.png", "day/a"),
        ("images/day/a.png", "masks/day__a.png", "day/a"),
        ("images/day/a.png", "masks/images__day__a.png", "day/a"),
        ("images/a.png", "labels/images__a.png", "a"),
        ("images/R_GImag0010.png", "labels/images__R_GImag0010.png", "R_GImag0010"),
        ("images/day/R_GImag0010.png", "labels/day__R_GImag0010.png", "day/R_GImag0010"),
        ("images/day/a.png", "images/day/masks/a.png", "day/a"),
        ("images/day/a.png", "masks/masks/day/a.png", "day/a"),
    ],
)
def test_layouts_of_the_field(tmp_path, photo, truth, name):
    put(tmp_path / photo)
    put(tmp_path / truth, MASK)
    item = only(sv.open_dataset(tmp_path))
    assert (item.name, item.truth()) == (name, SKYLINE)


def test_a_truth_of_another_folder_is_not_taken(tmp_path):
    for day in ("day1", "day2"):
        put(tmp_path / "images" / day / "a.png")
    put(tmp_path / "masks" / "day2" / "a.png", MASK)
    put(tmp_path / "masks" / "a.png", MASK)
    dataset = sv.open_dataset(tmp_path)
    assert [item.truth() for item in dataset] == [None, SKYLINE]
    assert dataset.problems == ("masks/a.png has no photo.",)


@pytest.mark.parametrize("sky", [0, 1, 255])
def test_masks_in_any_polarity(tmp_path, sky):
    put(tmp_path / "a.png")
    other = {0: 255, 1: 0, 255: 0}[sky]
    mask = (MASK == 0) * (sky - other) + other
    put(tmp_path / "a_mask.png", mask.astype("uint8"))
    assert only(sv.open_dataset(tmp_path)).truth() == SKYLINE


def test_names_tell_photos_apart(tmp_path):
    for name in ("images/a.png", "photos/a.png", "a.jpg", "b/c.png"):
        put(tmp_path / name)
    assert names(sv.open_dataset(tmp_path)) == ["a.jpg", "b/c", "images/a.png", "photos/a.png"]
