"""Tab *Sweep*: how the path changes with a setting."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import is_wide, map_view, photo_view, with_halos


def sweep_tab(contents: Contents) -> rrb.Container:
    """The path with other values of a setting, and what they come to."""
    photo = photo_view(
        "Choose a timeline below and drag it. Yellow: path with that setting, magenta: path now"
        + (", turquoise: truth" if contents.truth else ""),
        [entities.PHOTO, *with_halos([entities.PATH, entities.TRUTH, entities.SWEEP_PATH])],
    )
    edges = map_view(contents, "Edges", [entities.SWEEP_EDGES])
    cost = map_view(
        contents,
        "Nodal cost, the cheapest of each column",
        [entities.SWEEP_COST],
    )
    pictures: rrb.Container
    if is_wide(contents):
        pictures = rrb.Vertical(photo, rrb.Horizontal(edges, cost), row_shares=[3, 2])
    else:
        pictures = rrb.Horizontal(photo, rrb.Vertical(edges, cost), column_shares=[3, 2])
    plot = rrb.TimeSeriesView(
        origin=entities.SWEEP_ERROR,
        name="A_err (px)" if contents.truth else "Mean distance from the present path (px)",
        plot_legend=rrb.PlotLegend(visible=False),
    )
    report = rrb.TextDocumentView(origin=entities.SWEEP_REPORT, name="The setting")
    side = rrb.Vertical(report, plot, row_shares=[3, 2])
    return rrb.Horizontal(pictures, side, column_shares=[2, 1], name="Sweep")
