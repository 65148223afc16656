"""Photos in memory, and what a photo to learn from must have."""

import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.datasets.item import photo_and_truth

PHOTO = np.zeros((8, 6, 3), np.uint8)


def test_what_is_in_memory_is_given_as_it_is():
    item = sv.LoadedItem("a", PHOTO, sv.Skyline([3.0] * 6))
    photo, truth = photo_and_truth(item)
    assert photo is PHOTO
    assert truth is item.skyline


@pytest.mark.parametrize(
    ("skyline", "says"),
    [
        (None, "there is no truth"),
        (sv.Skyline([3.0] * 5), "the photo is 6 columns wide, the truth 5"),
    ],
)
def test_what_cannot_be_learned_from_is_a_sentence(skyline, says):
    with pytest.raises(sv.SkylineError, match=says):
        photo_and_truth(sv.LoadedItem("a", PHOTO, skyline))


def test_a_photo_without_truth_is_not_even_read(tmp_path):
    with pytest.raises(sv.SkylineError, match="there is no truth"):
        photo_and_truth(sv.DatasetItem("gone", tmp_path / "gone.png"))
