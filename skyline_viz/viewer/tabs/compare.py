"""Tab *Compare*: the stages of two detections beside each other."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.system.names import shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.entities import below
from skyline_viz.viewer.tabs.views import columns_for, lines_of, map_view


def compare_tab(contents: Contents) -> rrb.Container:
    """The stages of a second detection beside those of the first."""
    both = dict.fromkeys([*contents.stages, *contents.compared_stages])
    stages = [one for one in both if "Stages" in one.tabs and one.group != "tensor"]
    pairs = []
    for one in stages:
        title, stage = one.word or one.name, entities.of_quantity(one)
        theirs = f"{contents.compared}: {title}"
        pairs.append(
            [
                map_view(contents, f"First: {title}", [stage], lines_of(contents)),
                map_view(
                    contents,
                    theirs,
                    [below(entities.OTHER, stage)],
                    [entities.ALTERNATIVE, *lines_of(contents)[1:]],
                ),
            ]
        )
    many = columns_for(contents, len(pairs), together=2)
    rows = [pairs[at : at + many] for at in range(0, len(pairs), many)]
    maps = [rrb.Horizontal(*(view for pair in row for view in pair)) for row in rows]
    text = rrb.TextDocumentView(origin=entities.COMPARISON, name="What differs")
    title = shown_in_viewer(f"Report of {contents.compared}")
    other = rrb.TextDocumentView(origin=below(entities.OTHER, entities.REPORT), name=title)
    side = rrb.Vertical(text, other)
    return rrb.Horizontal(rrb.Vertical(*maps), side, column_shares=[3, 1], name="Compare")
