"""Tabs of maps: the paper's figure in its order, what is added, and lines on every map."""

from skyline_viz.stage import ADDED, SKY
from skyline_viz.viewer import entities
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.contents import Contents
from testing.layouts import tab_of, views_of


def views(**more):
    return list(views_of(tab_of(detection_blueprint(Contents(300, 800, **more)), "Stages")))


def test_what_the_paper_has_is_lettered_and_what_we_add_is_called_added():
    names = [view.name for view in views(terms=(ADDED,))]
    assert [name[:3] for name in names[:6]] == ["(a)", "(b)", "(c)", "(d)", "(e)", "(f)"]
    assert names[4].startswith("(e) Score and strength")
    assert [name for name in names[6:] if name.startswith("Added: ")] == [
        f"Added: {one.title}" for one in (SKY, ADDED)
    ]


def test_maps_have_path_and_truth_on_them():
    edges = views(truth=True)[1]
    assert {f"+ /{entities.PATH}", f"+ /{entities.TRUTH}"} <= set(edges.contents)


def test_lean_maps_say_that_they_are():
    assert "lean" in views(lean=True)[1].name
