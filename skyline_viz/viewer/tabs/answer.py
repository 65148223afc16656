"""Tabs that answer first: *Skyline*, where is the line, is it right; *Photos*, which are not."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.stage import SKY
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import bar_plot, errors_plot, photo_view, with_halos


def skyline_tab(contents: Contents) -> rrb.Container:
    """Where the line is, and whether it is right."""
    line = photo_view(
        "Where is the line? magenta: path"
        + (", turquoise: truth" if contents.truth else "")
        + (f", yellow: {contents.compared}" if contents.compared else ""),
        [entities.PHOTO, *with_halos(), entities.STRIP, f"{entities.CHOSEN}/**"],
    )
    plot = errors_plot() if contents.truth else bar_plot(entities.MARGINS, "Margin (cost)")
    report = rrb.TextDocumentView(origin=entities.REPORT, name="Report")
    if contents.width < 1.2 * contents.height:
        side = rrb.Vertical(report, plot, row_shares=[3, 2])
        return rrb.Horizontal(line, side, column_shares=[3, 2], name="Skyline")
    foot = rrb.Horizontal(plot, report, column_shares=[3, 2])
    return rrb.Vertical(line, foot, row_shares=[3, 2], name="Skyline")


def photos_tab(contents: Contents) -> rrb.Container:
    """How several photos came out."""
    metrics = [("a_err", "A_err of each photo (px)")] if contents.truth else []
    metrics.append(("margin", "Margin of each photo (cost)"))
    if SKY in contents.stages:  # without it, nobody can tell
        metrics.append(("confidence", "Confidence that each photo has a skyline"))
    plots = [
        rrb.TimeSeriesView(origin=f"{entities.METRICS}/{metric}", name=title)
        for metric, title in metrics
    ]
    times = rrb.TimeSeriesView(origin=entities.TIMINGS, name="Time of each stage (ms)")
    return rrb.Vertical(*plots, times, name="Photos")
