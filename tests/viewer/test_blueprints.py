"""How the viewer lays a recording out: what is in it decides about its tabs."""

import pytest

from skyline_viz.stage import ADDED, OURS, SKY, Quantity
from skyline_viz.viewer import entities
from skyline_viz.viewer.blueprints import detection_blueprint, stages_blueprint
from skyline_viz.viewer.contents import Contents, MethodContents

PLAIN = Contents(300, 800)


def tabs(blueprint):
    return [tab.name for tab in blueprint.root_container.contents]


def origins(part):
    """Entity paths that views begin at or show, whatever they lie in."""
    found = [str(getattr(part, "origin", ""))]
    found += [str(one) for one in getattr(part, "contents", []) or [] if isinstance(one, str)]
    for one in getattr(part, "contents", []) or []:
        if not isinstance(one, str):
            found += origins(one)
    return found


def test_a_plain_detection_has_the_tabs_of_our_detector():
    assert tabs(detection_blueprint(PLAIN)) == [
        "Skyline",
        "Stages",
        "Tensor",
        "Filter bank",
        "Columns",
    ]


@pytest.mark.parametrize(
    ("more", "name"),
    [
        ({"diagnosed": True, "truth": True}, "Diagnosis"),
        ({"swept": "delta"}, "Sweep"),
        ({"compared": "paper"}, "Compare"),
        ({"compared": "paper"}, "Side by side"),
        ({"photos": 3}, "Photos"),
        ({"methods": (MethodContents("edges"),)}, "edges"),
    ],
)
def test_what_else_is_in_it_has_a_tab(more, name):
    contents = Contents(300, 800, **more)
    assert name in tabs(detection_blueprint(contents))
    assert name not in tabs(detection_blueprint(PLAIN))
    front = detection_blueprint(contents, active=name).root_container
    assert tabs(detection_blueprint(contents))[front.active_tab] == name


def test_what_the_paper_has_is_lettered_and_what_we_add_is_called_added():
    contents = Contents(300, 800, terms=(ADDED,))
    stages = detection_blueprint(contents).root_container.contents[1]
    names = [view.name for row in stages.contents for view in row.contents]
    assert [name[:3] for name in names[:6]] == ["(a)", "(b)", "(c)", "(d)", "(e)", "(f)"]
    assert names[4].startswith("(e) Score and strength")
    assert [name for name in names[6:] if name.startswith("Added: ")] == [
        f"Added: {one.title}" for one in (SKY, ADDED)
    ]


def test_maps_have_path_and_truth_on_them():
    contents = Contents(300, 800, truth=True)
    edges = detection_blueprint(contents).root_container.contents[1].contents[0].contents[1]
    assert {f"+ /{entities.PATH}", f"+ /{entities.TRUTH}"} <= set(edges.contents)


def test_lean_maps_say_that_they_are():
    stages = detection_blueprint(Contents(300, 800, lean=True)).root_container.contents[1]
    assert "lean" in stages.contents[0].contents[1].name


def test_other_methods_have_neither_tensor_nor_bank():
    other = Contents(300, 800, stages=(OURS[0],), bank=False)
    assert tabs(detection_blueprint(other)) == ["Skyline", "Stages", "Columns"]


def test_a_tab_that_there_is_not_cannot_be_in_front():
    with pytest.raises(ValueError, match="Sweep"):
        detection_blueprint(PLAIN, active="Sweep")


def test_the_stages_of_another_detector_are_shown_by_their_names():
    blueprint = stages_blueprint(300, 800, ["mine/heat", "mine/line_of_sight"])
    assert tabs(blueprint) == ["Skyline", "Stages"]
    shown = origins(blueprint.root_container)
    assert "+ /mine/heat" in shown
    assert "+ /mine/line_of_sight" in shown


@pytest.mark.parametrize(("width", "columns"), [(800, 2), (400, 3)])
def test_wide_photos_have_room_for_two_views_side_by_side(width, columns):
    stages = detection_blueprint(Contents(300, width)).root_container.contents[1]
    rows = [len(row.contents) for row in stages.contents]
    assert max(rows) == columns
    assert min(rows) >= columns - 1  # and no hole


def test_the_second_of_two_methods_shows_stages_that_the_first_has_not():
    probability = Quantity("sky probability", group="maps")
    contents = Contents(300, 800, compared="own", compared_stages=(*OURS[:1], probability))
    tab = detection_blueprint(contents).root_container.contents[-1]
    assert tab.name == "Side by side"
    assert "+ /other/maps/sky_probability" in origins(tab)
