"""Options of a cross-validation: groups, folds, split files, and what is said of them."""

import cv2
import numpy as np
import pytest

from skyline_viz.command_line.folds import Folds
from skyline_viz.datasets.item import LoadedItem
from skyline_viz.rendering import render


@pytest.fixture(scope="module")
def items():
    photos = [render(kind, 4, 480, 320).photo for kind in ("clear", "snow", "spires")]
    named = zip(("a1", "a2", "b1"), photos, strict=True)
    return [
        *(LoadedItem(*one) for one in named),
        LoadedItem("copy", cv2.resize(photos[2], (240, 160))),
    ]


def test_without_folds_nothing_is_dealt(items):
    assert not Folds().asked
    assert Folds().dealt(items, None) is None
    assert Folds().groups(items) is None
    assert Folds().said(None, None) == ""


def test_copies_stay_together_and_it_is_said(items, capsys):
    groups = Folds(folds=2).groups(items)
    assert groups["b1"] == groups["copy"]
    assert len({*groups.values()}) == 3
    told = "kept in one fold, as they are nearly the same or of a clip: 2 photos in 1 group."
    assert told in capsys.readouterr().err
    folds = Folds(folds=3)
    dealt = folds.dealt(items, groups)
    assert dealt["b1"] == dealt["copy"]
    assert folds.said(dealt, groups) == "3-fold cross-validation of 3 groups"


def test_photos_that_differ_are_no_groups(items, capsys):
    assert Folds(folds=2).groups(items[:3]) is None
    assert capsys.readouterr().err == ""


def test_groups_that_were_asked_for_are_joined_with_copies(items):
    groups = Folds(folds=2, group="[ab]").groups(items)
    assert groups["a1"] == groups["a2"]
    assert groups["b1"] == groups["copy"] != groups["a1"]
    assert Folds(group="near").groups(items)["copy"] == groups["copy"]
    assert Folds(group="^a").groups(items) == {"a1": "a", "a2": "a", "b1": "=b1", "copy": "=copy"}


def test_a_split_says_what_it_leaves_out(items, tmp_path, capsys):
    file = tmp_path / "s.csv"
    file.write_text("name,fold\na1,train\nb1,test\n")
    with pytest.raises(ValueError, match="leave out --folds and --group"):
        Folds(folds=2, split=file)
    folds = Folds(split=file)
    assert folds.asked
    assert folds.dealt(items, None) == {"a1": 1, "b1": 0}
    assert f"left out, because {file} has no fold for them: a2, copy." in capsys.readouterr().err


def test_too_many_folds_are_refused(items):
    with pytest.raises(ValueError, match="from 2 to the 4 photos, not 5"):
        Folds(folds=5).dealt(items, Folds(folds=5).groups(items))
    near = Folds(folds=4, group="near")
    with pytest.raises(ValueError, match="from 2 to the 3 groups of the 4 photos, not 4"):
        near.dealt(items, near.groups(items))
    assert Folds(folds=4).groups(items) is None  # copies are told by the results then
    with pytest.raises(ValueError, match="photos, not 1"):
        Folds(folds=1).dealt([LoadedItem("a", np.zeros((4, 4, 3), np.uint8))], None)
