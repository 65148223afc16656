"""Tab *Search*: what the path search found, and the lines that it could have taken instead."""

from __future__ import annotations

import rerun as rr
import rerun.blueprint as rrb

from skyline_viz.system.names import shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.stage_maps import SEARCH

_BLACK = (12, 12, 12)
_THIN = 0.6  # half the width of a line on a map, in points of the screen


def search_tab(contents: Contents) -> rrb.Container:
    """The maps of the search; with one photo the best other lines above them, and what they pay."""
    maps = [_map(contents, one.title, entities.of_quantity(one)) for one in SEARCH]
    rows = [rrb.Horizontal(*maps[:2]), rrb.Horizontal(*maps[2:])]
    if not contents.other_lines:
        return rrb.Vertical(*rows, name="Search")
    known = [entities.PATH, *([entities.TRUTH] if contents.truth else []), entities.OTHER_LINES]
    lines = rrb.Spatial2DView(
        origin="/",
        contents=[f"+ /{entities.PHOTO}", *(f"+ /{line}/**" for line in known)],
        name="Magenta: path; numbered: the best lines along other ridges, cheapest first",
        background=_BLACK,
    )
    table = rrb.TextDocumentView(origin=entities.OTHER_LINES_TABLE, name="What they pay")
    if contents.width > 1.6 * contents.height:
        head = rrb.Horizontal(lines, table)
        return rrb.Vertical(head, *rows, row_shares=[4, 3, 3], name="Search")
    side = rrb.Vertical(table, *rows, row_shares=[5, 6, 6])
    return rrb.Horizontal(lines, side, name="Search")


def _map(contents: Contents, title: str, entity: str) -> rrb.View:
    lines = [entities.PATH, *([entities.TRUTH] if contents.truth else [])]
    thin = rr.LineStrips2D.from_fields(radii=[-_THIN]).visualizer()
    return rrb.Spatial2DView(
        origin="/",
        contents=[f"+ /{one}" for one in (entity, *lines)],
        name=shown_in_viewer(title),
        background=_BLACK,
        overrides={f"/{line}": thin for line in lines},
    )
