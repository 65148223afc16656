"""Tab *Columns*: error, margin and costs along the columns."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import (
    bar_plot,
    chosen_view,
    errors_plot,
    is_wide,
    series_plot,
)


def columns_tab(contents: Contents) -> rrb.Container:
    """Plots along the columns, with a cursor in a recording of one photo."""
    if not contents.columns:
        return _bars_tab(contents)
    titles = {
        **({"error": "Error (px)"} if contents.truth else {}),
        "margin": "Margin (cost): how much dearer the best other path is",
        **(
            {"apart": "Truth less path (cost), mean of 9 columns; sums beside the names"}
            if contents.truth
            else {}
        ),
        "path": "Nodal and link cost of the path",
    }
    plots = [
        series_plot(contents, name, title, legend=name in ("apart", "path"))
        for name, title in titles.items()
    ]
    shares = [2.4 if name == "apart" else 1.0 for name in titles]
    photo = chosen_view(contents)
    if is_wide(contents):
        return rrb.Vertical(photo, *plots, row_shares=[1.6, *shares], name="Columns")
    side = rrb.Vertical(*plots, row_shares=shares)
    return rrb.Horizontal(photo, side, column_shares=[2, 3], name="Columns")


def _bars_tab(contents: Contents) -> rrb.Container:
    """Plots of several photos, whose timeline is that of the photos."""
    plots = [
        *([errors_plot(contents)] if contents.truth else []),
        bar_plot(entities.MARGINS, "Margin (cost): how much dearer the best other path is"),
        bar_plot(entities.NODE_COSTS, "Nodal cost of the path"),
        bar_plot(entities.LINK_COSTS, "Link cost of the path"),
        *([bar_plot(entities.DIFFERENCES, "Difference (px)")] if contents.compared else []),
    ]
    return rrb.Vertical(*plots, name="Columns")
