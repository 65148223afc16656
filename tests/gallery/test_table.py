"""The layout of a gallery's recordings: made for its photos, of whatever shape they are."""

from dataclasses import replace

import pytest

from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.gallery.entry import Entry
from skyline_viz.gallery.table import by_shape, contents_of
from skyline_viz.stage import OURS
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.comparison import LEAN
from skyline_viz.viewer.contents import Contents

VERDICT = Verdict(None, None, None, None, None, 1.0, 0)
SQUARE = Entry("a", "", "", 1024, 1000, VERDICT, OURS, causes=("too steep",))


def all_views(part):
    """Every view of a layout, from the outermost container on."""
    inner = getattr(part, "contents", None)
    if getattr(part, "root_container", None) is not None:
        return all_views(part.root_container)
    if isinstance(inner, (list, tuple)) and not hasattr(part, "class_identifier"):
        return [view for one in inner for view in all_views(one)]
    return [part]


def bounds(contents):
    """Fixed bounds of views."""
    views = all_views(detection_blueprint(contents))
    assert len(views) > 5
    return [one.properties["VisualBounds2D"] for one in views if "VisualBounds2D" in one.properties]


def test_the_layout_is_made_for_the_shape_of_the_first_photo():
    contents = contents_of([SQUARE, replace(SQUARE, name="b")], truth=True)
    assert (contents.height, contents.width, contents.one_size) == (1024, 1000, True)
    assert contents.diagnosed
    for fixed in bounds(contents):
        shown = fixed.range.as_arrow_array().to_pylist()[0]
        assert shown["y_range"] == [0.0, 1024.0]
        assert shown["x_range"][0] == 0.0
        assert 1000 <= shown["x_range"][1] < 1200  # with a scale of colours


def test_photos_of_other_sizes_fit_themselves_into_the_views():
    contents = contents_of([SQUARE, replace(SQUARE, name="b", width=1388)], truth=True)
    assert not contents.one_size
    assert bounds(contents) == []


def test_photos_of_each_size_have_a_layout_of_their_own():
    wide = replace(SQUARE, name="wide", width=1388, height=519)
    shapes = by_shape([SQUARE, wide, replace(SQUARE, name="b")])
    assert {name: [one.name for one in alike] for name, alike in shapes.items()} == {
        "photos": [SQUARE.name, "b"],
        "photos-2": ["wide"],
    }


def test_photos_of_many_sizes_are_together_by_their_shape():
    many = [replace(SQUARE, name=str(more), height=1000 + more) for more in range(20)]
    wide = replace(SQUARE, name="wide", width=3000)
    assert [len(alike) for alike in by_shape([*many, wide]).values()] == [20, 1]


@pytest.mark.parametrize(("method", "stages"), [("default", OURS), ("edges", OURS[:1])])
def test_the_layout_holds_what_the_recordings_hold(method, stages):
    contents = contents_of(
        [replace(SQUARE, method=method, stages=stages, compared="paper")], truth=False
    )
    assert contents == Contents(
        1024,
        1000,
        bank=False,
        lean=True,
        stages=stages,
        first=method,
        compared="paper",
        apart=LEAN,
        diagnosed=True,
    )
