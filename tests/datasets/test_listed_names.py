"""Photos of a listing are those that a folder of the same names has."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.datasets.listed_names import told_apart
from skyline_viz.datasets.tree import photos_below


def kept(names):
    return [name for name, _, photo in told_apart((name, None) for name in names) if photo]


def test_truths_are_told_by_their_names_and_folders():
    names = ["a.jpg", "a-mask.png", "a_edge.png", "knife_edge.jpg", "Masks/b.png", "in/GT/c.png"]
    assert kept(names) == ["a.jpg", "knife_edge.jpg"]


def test_what_was_asked_for_may_be_called_as_truths_are():
    assert kept(["b.png", "c.png"]) == ["b.png", "c.png"]


def test_maps_of_geopose3k_lie_beside_their_photo():
    names = ["x/photo.jpg", "x/labels_crop.png", "x/pinhole/labels.png", "x/cyl/depth.png"]
    assert kept(names) == ["x/photo.jpg"]
    assert kept(["x/labels_of_wine.jpg", "x/cyl/depth.png"]) == [
        "x/labels_of_wine.jpg",
        "x/cyl/depth.png",
    ]


FOLDERS = st.sampled_from(["", "day/", "masks/", "images/", "day/labels/"])
STEMS = st.sampled_from(["a", "b", "a_mask", "a-gt", "b_edge", "c_truth", "d_label"])


@given(st.sets(st.tuples(FOLDERS, STEMS), min_size=1))
def test_a_folder_of_the_same_names_has_the_same_photos(tmp_path_factory, parts):
    folder = tmp_path_factory.mktemp("photos")
    names = [f"{home}{stem}.jpg" for home, stem in parts if not home.startswith("images")]
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).touch()
    there = {path.relative_to(folder).as_posix() for path in photos_below(folder)}
    assert {*kept(sorted(names, key=lambda name: (name.rpartition("/")[0], name)))} == there


@pytest.mark.parametrize("names", [[], ["masks/a.png"]])
def test_there_may_be_no_photo(names):
    assert kept(names) == []
