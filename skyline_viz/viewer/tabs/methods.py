"""Tabs of several methods: *Compare*, two side by side; *Methods*, more, and one of each."""

from __future__ import annotations

import rerun.blueprint as rrb

from skyline_viz.system.names import shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents, MethodContents
from skyline_viz.viewer.entities import below
from skyline_viz.viewer.tabs.stages import figure_1
from skyline_viz.viewer.tabs.views import grid, photo_view, whole_photo, with_halos


def compare_tab(contents: Contents) -> rrb.Container:
    """The stages of a second detection beside those of the first."""
    views = []
    both = dict.fromkeys([*contents.stages, *contents.compared_stages])
    stages = [one for one in both if "Stages" in one.tabs and one.group != "tensor"]
    for one in stages:
        title, stage = one.word or one.name, entities.of_quantity(one)
        views += [
            photo_view(f"First: {title}", [stage, *with_halos([entities.PATH])]),
            photo_view(
                f"{contents.compared}: {title}",
                [below(entities.OTHER, stage), *with_halos([entities.ALTERNATIVE])],
            ),
        ]
    text = rrb.TextDocumentView(origin=entities.COMPARISON, name="What differs")
    title = shown_in_viewer(f"Report of {contents.compared}")
    other = rrb.TextDocumentView(origin=below(entities.OTHER, entities.REPORT), name=title)
    shares = [4] * len(stages) + [6]  # the reports need their lines
    return rrb.Grid(*views, text, other, grid_columns=2, row_shares=shares, name="Compare")


def methods_tab(contents: Contents) -> rrb.Container:
    """The lines and costs of several methods."""
    lines = with_halos([entities.PATH, entities.TRUTH, entities.METHOD_LINES])
    photo = photo_view(
        "What each method finds",
        [entities.PHOTO, *lines],
        whole_photo(contents),
    )
    table = rrb.TextDocumentView(origin=entities.METHODS_TABLE, name="Methods")
    costs = [
        photo_view(
            f"{one.name}: nodal cost",
            [
                below(_stages_of(one), entities.COST),
                *with_halos([entities.line_of(one.name)]),
            ],
        )
        for one in contents.methods[:3]
    ]
    foot = rrb.Horizontal(table, *costs)
    return rrb.Vertical(photo, foot, row_shares=[3, 2], name="Methods")


def method_tab(contents: Contents, one: MethodContents) -> rrb.Container:
    """The stages of a method, as the stages of ours."""
    line = entities.line_of(one.name)
    views = {
        title: [below(_stages_of(one), stage) for stage in shown]
        for title, shown in figure_1(one.stages).items()
    }
    views["Path"] = [entities.PHOTO, *with_halos([line, entities.TRUTH])]
    pictures = [photo_view(title, shown) for title, shown in views.items()]
    report = rrb.TextDocumentView(origin=below(_stages_of(one), entities.REPORT), name="Report")
    return grid(contents, [*pictures, report], shown_in_viewer(one.name))


def _stages_of(one: MethodContents) -> str:
    return entities.stages_of(one.name)
