"""Plots along the columns: with a cursor for one photo, as bars for several."""

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.columns import columns_tab
from testing.layouts import shown_in, views_of


def test_one_photo_has_plots_with_linked_axes():
    tab = columns_tab(Contents(300, 800, truth=True, columns=True))
    plots = [view for view in views_of(tab) if isinstance(view, rrb.TimeSeriesView)]
    assert {str(plot.origin) for plot in plots} == {
        f"{entities.SERIES}/{name}" for name in ("error", "margin", "apart", "path")
    }
    assert all("AxisX" in plot.properties or "TimeAxis" in plot.properties for plot in plots)


def test_several_photos_have_bars():
    shown = shown_in(columns_tab(Contents(300, 800, truth=True, photos=3)))
    assert entities.ERRORS in shown
    assert not [one for one in shown if one.startswith(entities.SERIES)]
