"""What a console shows of the objects: a line each, whatever they hold."""

import pytest

import skyline_viz as sv

SCENE = sv.render("clear", 1, 300, 200)
FOUND = sv.Detector().detect(SCENE.photo)


@pytest.mark.parametrize(
    "value",
    [
        sv.FilterBank.default(),
        SCENE,
        SCENE.truth,
        FOUND,
        FOUND.cost_model,
        *FOUND.stages.values(),
        sv.find_method("edges").detect(SCENE.photo),
    ],
    ids=lambda value: type(value).__name__,
)
def test_it_is_a_line(value):
    said = repr(value)
    assert "\n" not in said
    assert len(said) < 250
    assert said.startswith(type(value).__name__)


def test_a_line_tells_what_is_hidden():
    assert repr(sv.Skyline(rows=[2, 5, 3], visible=[True, False, True])) == (
        "Skyline(3 columns, rows 2 to 5, 1 not visible)"
    )
