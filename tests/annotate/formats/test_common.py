"""What all formats share: safe names for files, lines as runs of points, labels that fit."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from annotate.formats.common import (
    FormatError,
    check_size,
    entries_of,
    one_each,
    orphans_of,
    runs_of_points,
    safe_stems,
    size_of,
)
from skyline_viz.skyline import Skyline
from testing.exports import HEIGHT, WIDTH, label, put, without_line


@pytest.fixture
def photos(tmp_path):
    put(tmp_path / "photos", "a.png")
    return tmp_path / "photos"


@example(["Ab.png", "aB.png"])
@given(st.lists(st.text(min_size=1, max_size=15), max_size=8))
def test_stems_are_safe_and_no_two_are_alike(names):
    stems = safe_stems(names)
    assert set(stems) == set(names)
    folded = [stem.casefold() for stem in stems.values()]
    assert len(set(folded)) == len(folded)
    for stem in stems.values():
        assert stem
        assert "/" not in stem
        assert not stem.startswith(".")
        assert stem.isprintable() or all(not one.isspace() or one == " " for one in stem)


def test_a_stem_is_never_the_name_of_another_photo():
    stems = safe_stems(["a.png", "a.jpg", "a", "b/a"])
    assert stems["a"] == "a"
    assert len(set(stems.values())) == 4


@given(st.lists(st.booleans(), min_size=1, max_size=30))
def test_runs_of_points_are_the_visible_columns(visible):
    rows = np.arange(len(visible)) + 0.25
    runs = runs_of_points(Skyline(rows, np.array(visible)))
    points = np.concatenate([*runs, np.zeros((0, 2))])
    np.testing.assert_array_equal(points[:, 0], np.flatnonzero(visible) + 0.5)
    np.testing.assert_array_equal(points[:, 1], rows[visible])
    for run in runs:
        assert (np.diff(run[:, 0]) == 1).all()
    for one, other in pairwise(runs):
        assert other[0, 0] - one[-1, 0] > 1


def test_lines_that_do_not_fit_their_photo_are_refused(photos):
    fits = check_size("a.png", Skyline(np.full(WIDTH, 4.4)), photos, HEIGHT)
    assert set(fits.rows) == {4}
    for skyline, height, reason in (
        (Skyline(np.full(WIDTH - 1, 4)), None, f"a.png has {WIDTH} columns, its label {WIDTH - 1}"),
        (Skyline(np.full(WIDTH, 4)), HEIGHT + 1, f"has {HEIGHT} rows, its label is for"),
        (Skyline(np.full(WIDTH, HEIGHT + 9)), None, "a.png: "),
    ):
        with pytest.raises(FormatError, match=reason):
            check_size("a.png", skyline, photos, height)
    with pytest.raises(FormatError, match="no such file"):
        size_of("b.png", photos)


def test_labels_of_other_photos_are_left_out_with_a_sentence(photos):
    put(photos, "b.png", seed=1)
    swapped = label(photos, "b.png")
    put(photos, "b.png", seed=2)
    entries, notes = entries_of(
        [label(photos, "a.png"), swapped, label(photos, "gone.png"), without_line(photos, "a.png")],
        photos,
    )
    assert [(one.label.name, one.stem) for one in entries] == [("a.png", "a")]
    assert notes == [
        "b.png is another photo now.",
        "gone.png is not in the folder.",
        "a.png has no line.",
    ]


def test_orphans_of_a_name_that_is_taken_are_called_after_their_content(photos):
    orphan, other = label(photos, "a.png"), label(photos, "gone.png")
    entries, notes = orphans_of([orphan, other, without_line(photos, "x.png")], photos)
    assert [one.stem for one in entries] == [f"a.sha256-{orphan.digest[:12]}", "gone"]
    assert notes == ["x.png has no line."]


def test_the_first_of_several_labels_of_a_photo_counts(photos):
    entries, _ = entries_of([label(photos, "a.png"), label(photos, "a.png")], photos)
    kept, notes = one_each(entries)
    assert kept == entries[:1]
    assert notes[0].startswith("a.png has several labels, and only that of ann, pass 2, is in it")
