"""Dealing photos into folds: all of them, evenly, and what belongs together stays together."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import skyline_viz as sv
from skyline_viz.datasets.item import LoadedItem
from skyline_viz.evaluation.dealing import (
    deal,
    fingerprints,
    grouped,
    kept_together,
    read_split,
    write_split,
)
from skyline_viz.photo import PhotoError
from skyline_viz.rendering import render
from testing.examples import examples


def named(*names):
    return [LoadedItem(name, np.zeros((4, 4, 3), np.uint8)) for name in names]


class Broken:
    name = "broken"

    def photo(self):
        raise PhotoError("it is gone.")

    def truth(self):
        return None


@examples(40)
@given(st.lists(st.integers(0, 9), min_size=2, max_size=30), st.integers(2, 5))
def test_groups_are_whole_and_folds_are_filled(of, folds):
    items = named(*(f"{place:02}" for place in range(len(of))))
    groups = {item.name: f"{group}" for item, group in zip(items, of, strict=True)}
    if len({*of}) < folds:
        with pytest.raises(ValueError, match="groups"):
            deal(items, folds, groups)
        return
    dealt = deal(items, folds, groups)
    assert {*dealt.values()} == {*range(folds)}
    for group in {*groups.values()}:
        assert len({dealt[name] for name in groups if groups[name] == group}) == 1


@examples(40)
@given(st.integers(2, 20), st.integers(2, 5))
def test_photos_alone_are_dealt_one_after_the_other(count, folds):
    items = named(*(f"{place:02}" for place in range(count)))
    if folds > count:
        return
    assert [*deal(items, folds).values()] == [place % folds for place in range(count)]


def test_groups_by_folder_and_pattern():
    items = named("x/a1", "x/a2", "y/a1")
    assert grouped(items, "folder") == {"x/a1": "x", "x/a2": "x", "y/a1": "y"}
    assert grouped(items, "a[0-9]") == {"x/a1": "a1", "x/a2": "a2", "y/a1": "a1"}
    assert grouped(items, "(x)/") == {"x/a1": "x", "x/a2": "x", "y/a1": "=y/a1"}
    with pytest.raises(ValueError, match="in no name"):
        grouped(items, "zebra")
    with pytest.raises(ValueError, match="no pattern"):
        grouped(items, "(")


def test_copies_and_clips_stay_together_with_what_else_does():
    photos = [render(kind, 4, 480, 320).photo for kind in ("clear", "snow", "spires", "hazy")]
    small = cv2.resize(photos[0], None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    names = ("clip1-1", "clip1-2", "clip2-1", "far")
    items = [LoadedItem(*one) for one in zip(names, photos, strict=True)]
    items += [LoadedItem("copy", small), Broken()]
    groups = kept_together(items)
    assert groups["clip1-1"] == groups["clip1-2"] == groups["copy"]
    assert len({*groups.values()}) == 4
    joined = kept_together(items, {"copy": "x", "far": "x"})
    assert joined["far"] == joined["clip1-2"] != joined["clip2-1"]
    assert grouped(items, "near") == groups
    assert {*fingerprints(items)} == {*names, "copy"}


def test_names_that_all_begin_alike_tell_of_no_clip():
    photos = [render(kind, 4, 480, 320).photo for kind in ("clear", "snow")]
    items = [LoadedItem(f"set2_{place}", photo) for place, photo in enumerate(photos)]
    assert len({*kept_together(items).values()}) == 2


def test_a_cross_validation_never_learns_from_a_copy():
    scenes = [render("desert", seed, 160, 120) for seed in (1, 2, 3)]
    items = [LoadedItem(one.name, one.photo, one.truth) for one in scenes]
    items.append(LoadedItem("desert-2b", scenes[1].photo, scenes[1].truth))
    found = sv.cross_validate(items, "default:sky_weight=0", folds=2)
    assert found.fold_of["desert-2"] == found.fold_of["desert-2b"]
    assert found.notes == []


def test_a_split_comes_back(tmp_path):
    items = named("a", "b", "c")
    write_split(tmp_path / "s.csv", {"a": 1, "b": 0, "c": 1})
    assert read_split(tmp_path / "s.csv", items) == {"a": 1, "b": 0, "c": 1}
    (tmp_path / "s.csv").write_text("name,fold\na,train\nb,test\nzebra,test\n")
    assert read_split(tmp_path / "s.csv", items) == {"a": 1, "b": 0}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("photo,fold\n", "is not name,fold"),
        ("", "is not name,fold"),
        ("name,fold\na\n", "no fold for a"),
        ("name,fold\na,0\na,1\n", "names a twice"),
        ("name,fold\na,0\nb,0\n", "into 1 folds"),
    ],
)
def test_a_split_of_no_use_is_refused(tmp_path, text, said):
    (tmp_path / "s.csv").write_text(text)
    with pytest.raises(ValueError, match=said):
        read_split(tmp_path / "s.csv", named("a", "b"))
