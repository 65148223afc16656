"""Tabs that answer first: *Skyline*, where is the line, is it right; *Photos*, which are not."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import (
    bar_plot,
    beside,
    errors_plot,
    photo_view,
    series_plot,
    with_halos,
)


def skyline_tab(contents: Contents) -> rrb.Container:
    """Where the line is, and whether it is right."""
    line = photo_view(
        "Where is the line? magenta: path"
        + (", turquoise: truth" if contents.truth else "")
        + (f", yellow: {contents.compared}" if contents.compared else "")
        + (". Strip: bright where wrong" if contents.truth else ". Strip: bright where unsure"),
        [entities.PHOTO, *with_halos(), entities.STRIP, f"{entities.CHOSEN}/**"],
    )
    report = rrb.TextDocumentView(origin=entities.REPORT, name="Report")
    return beside(contents, line, [report, _plot(contents)], "Skyline")


def _plot(contents: Contents) -> rrb.View:
    if contents.truth:
        return errors_plot(contents)
    if contents.columns and not contents.swept:
        return series_plot(contents, "margin", "Margin (cost)", legend=False)
    return bar_plot(entities.MARGINS, "Margin (cost)")


def photos_tab(contents: Contents) -> rrb.Container:
    """How several photos came out."""
    metrics = [("a_err", "A_err of each photo (px)")] if contents.truth else []
    metrics.append(("margin", "Margin of each photo (cost)"))
    metrics.append(("confidence", "Confidence that the line of each photo is the skyline"))
    plots = [
        rrb.TimeSeriesView(origin=f"{entities.METRICS}/{metric}", name=title)
        for metric, title in metrics
    ]
    times = rrb.TimeSeriesView(origin=entities.TIMINGS, name="Time of each stage (ms)")
    return rrb.Vertical(*plots, times, name="Photos")
