"""The sweep: path, edges, cost and error with the value that is chosen."""

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.sweep import sweep_tab
from testing.layouts import shown_in


def test_all_that_a_setting_changes_is_in_sight():
    shown = shown_in(sweep_tab(Contents(300, 800, swept="delta")))
    assert {
        f"{entities.SWEEP_PATH}/**",
        f"{entities.SWEEP_EDGES}/**",
        f"{entities.SWEEP_COST}/**",
        entities.SWEEP_ERROR,
        entities.SWEEP_REPORT,
    } <= shown
