"""Tabs of several methods: *Methods*, and one of the stages of each."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.system.names import shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents, MethodContents
from skyline_viz.viewer.entities import below
from skyline_viz.viewer.tabs.stages import figure_1
from skyline_viz.viewer.tabs.views import (
    grid,
    is_wide,
    lines_of,
    map_view,
    photo_view,
    whole_photo,
    with_halos,
)


def methods_tab(contents: Contents) -> rrb.Container:
    """The lines and costs of several methods."""
    lines = with_halos([entities.PATH, entities.TRUTH, entities.METHOD_LINES])
    photo = photo_view(
        "What each method finds",
        [entities.PHOTO, *lines, entities.METHODS_SWATCHES],
        whole_photo(contents),
    )
    table = rrb.TextDocumentView(origin=entities.METHODS_TABLE, name="Methods")
    truth = lines_of(contents)[1:]
    costs = [
        map_view(contents, "Ours: nodal cost", [entities.COST], lines_of(contents)),
        *(
            map_view(
                contents,
                f"{one.name}: nodal cost",
                [below(_stages_of(one), entities.COST)],
                [entities.line_of(one.name), *truth],
            )
            for one in contents.methods[:3]
        ),
    ]
    if is_wide(contents):
        foot = rrb.Horizontal(table, *costs)
        return rrb.Vertical(photo, foot, row_shares=[3, 2], name="Methods")
    side = rrb.Vertical(table, rrb.Grid(*costs, grid_columns=2), row_shares=[1, 2])
    return rrb.Horizontal(photo, side, column_shares=[1, 1], name="Methods")


def method_tab(contents: Contents, one: MethodContents) -> rrb.Container:
    """The stages of a method, as the stages of ours."""
    line, truth = entities.line_of(one.name), lines_of(contents)[1:]
    pictures = [
        map_view(
            contents,
            title,
            [below(_stages_of(one), stage) for stage in shown],
            [line, *truth],
        )
        for title, shown in figure_1(one.stages).items()
    ]
    path = photo_view("Path", [entities.PHOTO, *with_halos([line, entities.TRUTH])])
    report = rrb.TextDocumentView(origin=below(_stages_of(one), entities.REPORT), name="Report")
    return grid(contents, [*pictures, path, report], shown_in_viewer(one.name))


def _stages_of(one: MethodContents) -> str:
    return entities.stages_of(one.name)
