"""Tabs of maps: the paper's figure in its order, what is added, and lines on every map."""

from skyline_viz.stage import ADDED, COST, EDGES, FUSED, OURS, SKY
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


def test_lean_maps_say_that_they_are_and_those_that_are_whole_do_not():
    lean = tuple(one for one in OURS if one != FUSED)
    names = [view.name for view in views(lean=True, stages=lean)]
    assert [name.removeprefix("Lean: ")[:3] for name in names[:5]] == [
        "(a)",
        "(b)",
        "(c)",
        "(d)",
        "(f)",
    ]
    assert [name.startswith("Lean: ") for name in names] == [
        any(word in name for word in ("Score", "strength", "cost")) for name in names
    ]


def test_all_stages_of_another_method_have_letters():
    assert [view.name[:3] for view in views(stages=(EDGES, COST))] == ["(a)", "(b)", "(c)", "(d)"]
