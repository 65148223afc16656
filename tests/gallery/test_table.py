"""The layout of a gallery's recordings: made for its photos, of whatever shape they are."""

from dataclasses import replace

import pytest

from skyline_viz.evaluation.verdict import Verdict
from skyline_viz.gallery.entry import Entry
from skyline_viz.gallery.table import contents_of
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
    (fixed,) = bounds(contents)
    assert fixed.range.as_arrow_array().to_pylist()[0] == {
        "x_range": [0.0, 1000.0],
        "y_range": [0.0, 1024.0],
    }


def test_photos_of_other_sizes_fit_themselves_into_the_views():
    contents = contents_of([SQUARE, replace(SQUARE, name="b", width=1388)], truth=True)
    assert not contents.one_size
    assert bounds(contents) == []


@pytest.mark.parametrize(("method", "stages"), [("default", OURS), ("edges", OURS[:1])])
def test_the_layout_holds_what_the_recordings_hold(method, stages):
    contents = contents_of(
        [replace(SQUARE, method=method, stages=stages, compared="paper")], truth=False
    )
    assert contents == Contents(
        1024,
        1000,
        bank=False,
        stages=stages,
        first=method,
        compared="paper",
        apart=LEAN,
        diagnosed=True,
        stacked_costs=False,
    )
