"""Tabs of two detections."""

import pytest

from skyline_viz.stage import OURS, SCORE, Quantity
from skyline_viz.viewer import entities
from skyline_viz.viewer.blueprints import detection_blueprint
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.compare import compare_tab, side_by_side_tab
from testing.layouts import shown_in, tab_of, views_of

APART = (
    Quantity("edges", about="Edges", group="apart/stage"),
    Quantity("sky", low=-0.5, high=0.5, about="Sky cost", group="apart/term"),
    *(
        Quantity(f"t{at}", low=-1.0, high=1.0, about=f"T{at}", group="apart/term")
        for at in range(5)
    ),
)


@pytest.mark.parametrize(("height", "width"), [(519, 1388), (1024, 1024), (1600, 1200)])
@pytest.mark.parametrize("truth", [True, False])
def test_every_map_has_both_lines_on_it_and_the_truth(height, width, truth):
    contents = Contents(height, width, truth=truth, first="default", compared="paper", apart=APART)
    found = list(views_of(compare_tab(contents)))
    maps = [one for one in found if any("apart/" in str(part) for part in one.contents or [])]
    assert len(maps) == len(APART)
    lines = {f"+ /{entities.PATH}", f"+ /{entities.ALTERNATIVE}"}
    for one in maps:
        assert lines <= set(one.contents)
        assert (f"+ /{entities.TRUTH}" in one.contents) == truth
    names = [one.name for one in maps]
    assert names[:2] == ["Edges of one alone", "Sky cost"]
    assert found[0].name.startswith("Magenta: default, yellow: paper")


@pytest.mark.parametrize(("height", "width"), [(519, 1388), (1024, 1024)])
def test_side_by_side_names_both(height, width):
    contents = Contents(height, width, first="default", compared="edges", compared_stages=OURS[:2])
    names = [one.name for one in views_of(side_by_side_tab(contents))]
    assert "Score: default" in names
    assert ("Score: edges" in names) == (SCORE in OURS[:2])
    assert "Score: edges has none" in names
    assert {"Report of default", "Report of edges"} <= set(names)
    assert not any("First" in name for name in names)


@pytest.mark.parametrize(
    ("count", "width", "rows"), [(3, 1000, 2), (8, 1000, 3), (2, 500, 1), (5, 500, 2)]
)
def test_cells_are_as_large_as_the_window_lets_them_be(count, width, rows):
    apart = APART[1:2] * count
    tab = compare_tab(Contents(1000, width, compared="paper", apart=apart))
    assert len(tab.contents[0].contents) == rows


def test_the_second_of_two_methods_shows_stages_that_the_first_has_not():
    probability = Quantity("sky probability", group="maps")
    contents = Contents(300, 800, compared="own", compared_stages=(*OURS[:1], probability))
    assert "other/maps/sky_probability/**" in shown_in(
        tab_of(detection_blueprint(contents), "Side by side")
    )
