"""Tab *Search*: what the path search found, and the lines that it could have taken instead."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.maps.stage_maps import SEARCH
from skyline_viz.viewer.tabs.views import lines_of, map_view, photo_view, with_halos


def search_tab(contents: Contents) -> rrb.Container:
    """The maps of the search; with one photo the best other lines above them, and what they pay."""
    drawn = lines_of(contents)
    maps = [  # in short, for there is little room; the docs say what they are
        map_view(contents, one.title.split(":")[0], [entities.of_quantity(one)], drawn)
        for one in SEARCH
    ]
    rows = [rrb.Horizontal(*maps[:2]), rrb.Horizontal(*maps[2:])]
    if not contents.other_lines:
        return rrb.Vertical(*rows, name="Search")
    lines = photo_view(
        "Magenta: path; numbered: the best lines along other ridges, cheapest first",
        [entities.PHOTO, *with_halos([*drawn, entities.OTHER_LINES])],
    )
    table = rrb.TextDocumentView(origin=entities.OTHER_LINES_TABLE, name="What they pay")
    if contents.width > 1.6 * contents.height:
        head = rrb.Horizontal(lines, table)
        return rrb.Vertical(head, *rows, row_shares=[4, 3, 3], name="Search")
    side = rrb.Vertical(table, *rows, row_shares=[7, 7, 7])
    return rrb.Horizontal(lines, side, name="Search")
