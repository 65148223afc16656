"""Tabs of several methods: their lines and costs, and the stages of each."""

import pytest

from skyline_viz.stage import EDGES
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents, MethodContents
from skyline_viz.viewer.tabs.methods import method_tab, methods_tab
from testing.layouts import shown_in

TWO = (MethodContents("edges", (EDGES,)), MethodContents("gradient"))


@pytest.mark.parametrize("shape", [(300, 800), (500, 500)])
def test_lines_names_and_costs_of_all_are_in_sight(shape):
    shown = shown_in(methods_tab(Contents(*shape, truth=True, methods=TWO)))
    assert {entities.METHODS_SWATCHES, entities.METHODS_TABLE, f"{entities.COST}/**"} <= shown
    assert {f"{entities.stages_of(one.name)}/{entities.COST}/**" for one in TWO} <= shown


def test_a_method_shows_its_own_stages_with_its_line():
    shown = shown_in(method_tab(Contents(300, 800, methods=TWO), TWO[0]))
    assert {"methods/edges/edges/**", entities.line_of("edges"), "methods/edges/report"} <= shown
    assert not any("score" in one for one in shown)
