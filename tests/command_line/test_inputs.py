"""What commands are given: photos, and the names of their outputs."""

from pathlib import Path

import pytest

import skyline_viz as sv
from skyline_viz.command_line.inputs import output_names


@pytest.mark.parametrize(
    ("items", "names"),
    [
        (["cvg/I.jpg", "panoramio/I.jpg"], ["cvg-I", "panoramio-I"]),
        (["a/A.png", "b/a.png"], ["a-A", "b-a"]),
        (["x.png", "X.jpg", "x-2.png"], ["x.png", "X.jpg", "x-2"]),
    ],
)
def test_output_names(items, names):
    made = [sv.DatasetItem(str(Path(item).with_suffix("")), Path(item)) for item in items]
    assert output_names(made) == names


def test_photos_of_one_name_are_called_after_their_folders_too():
    places = ["a/x.png", "b/x.png", "c/x-2.png"]
    made = [sv.DatasetItem(Path(place).stem, Path(place)) for place in places]
    assert output_names(made) == ["a-x", "b-x", "x-2"]


def test_numbers_do_not_clash_either():
    places = ["1/a/x.png", "2/a/x.png", "c/x-2.png"]
    made = [sv.DatasetItem(Path(place).stem, Path(place)) for place in places]
    assert output_names(made) == ["x", "x-3", "x-2"]


def test_geopose_photos_are_called_after_their_folders():
    made = [sv.DatasetItem(name, Path(name) / "photo.jpg", label_map=True) for name in ("n1", "n2")]
    assert output_names(made) == ["n1", "n2"]
    assert output_names(made[:1]) == ["n1"]


def test_some_names_are_taken():
    made = [sv.DatasetItem(name, Path(f"{name}.png")) for name in ("Run", "skylines", "ridge")]
    assert output_names(made, taken=("run", "skylines")) == ["Run-photo", "skylines-photo", "ridge"]
