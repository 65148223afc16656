"""Tab *Columns*: error, margin and costs along the columns."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import bar_plot, chosen_view, errors_plot


def columns_tab(contents: Contents) -> rrb.Container:
    """Plots along the columns, with a cursor in a recording of one photo."""
    if not contents.columns:
        return _bars_tab(contents)
    titles = {
        **({"error": "Error (px)"} if contents.truth else {}),
        "margin": "Margin (cost): how much dearer the best other path is",
        **({"apart": "Truth less path (cost), mean of 9 columns"} if contents.truth else {}),
        "path": "Nodal and link cost of the path",
    }
    axis = rrb.TimeAxis(link=rrb.components.LinkAxis.LinkToGlobal)
    plots = [
        rrb.TimeSeriesView(
            origin=f"{entities.SERIES}/{name}",
            name=title,
            axis_x=axis,
            plot_legend=rrb.PlotLegend(corner=rrb.Corner2D.RightTop),
        )
        for name, title in titles.items()
    ]
    shares = [2, *(2 if name == "apart" else 1 for name in titles)]
    return rrb.Vertical(chosen_view(contents), *plots, row_shares=shares, name="Columns")


def _bars_tab(contents: Contents) -> rrb.Container:
    """Plots of several photos, whose timeline is that of the photos."""
    plots = [
        *([errors_plot()] if contents.truth else []),
        bar_plot(entities.MARGINS, "Margin (cost): how much dearer the best other path is"),
        bar_plot(entities.NODE_COSTS, "Nodal cost of the path"),
        bar_plot(entities.LINK_COSTS, "Link cost of the path"),
        *([bar_plot(entities.DIFFERENCES, "Difference (px)")] if contents.compared else []),
    ]
    return rrb.Vertical(*plots, name="Columns")
