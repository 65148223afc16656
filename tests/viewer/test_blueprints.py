"""How the viewer lays a recording out: what is in it decides about its tabs."""

import pytest

from skyline_viz.stage import OURS
from skyline_viz.viewer.blueprints import detection_blueprint, stages_blueprint
from skyline_viz.viewer.contents import Contents, MethodContents
from testing.layouts import shown_in, tab_titles

PLAIN = Contents(300, 800)


def test_a_plain_detection_has_the_tabs_of_our_detector():
    assert tab_titles(detection_blueprint(PLAIN)) == [
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
    assert name in tab_titles(detection_blueprint(contents))
    assert name not in tab_titles(detection_blueprint(PLAIN))
    front = detection_blueprint(contents, active=name).root_container
    assert tab_titles(detection_blueprint(contents))[front.active_tab] == name


def test_other_methods_have_neither_tensor_nor_bank():
    other = Contents(300, 800, stages=(OURS[0],), bank=False)
    assert tab_titles(detection_blueprint(other)) == ["Skyline", "Stages", "Columns"]


def test_a_tab_that_there_is_not_cannot_be_in_front():
    with pytest.raises(ValueError, match="Sweep"):
        detection_blueprint(PLAIN, active="Sweep")


def test_the_stages_of_another_detector_are_shown_by_their_names():
    blueprint = stages_blueprint(300, 800, ["mine/heat", "mine/line_of_sight"])
    assert tab_titles(blueprint) == ["Skyline", "Stages"]
    assert {"mine/heat/**", "mine/line_of_sight/**"} <= shown_in(blueprint.root_container)
