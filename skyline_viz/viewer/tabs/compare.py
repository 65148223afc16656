"""Tabs of two detections: *Compare*, where they part, and *Side by side*, the stages of both."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import rerun.blueprint as rrb

from skyline_viz.stage import EDGES, Quantity
from skyline_viz.system.names import shortened, shown_in_viewer
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.entities import below
from skyline_viz.viewer.tabs.views import lines_of, map_view, photo_view

_MOST = 24  # characters of a name in a title
_WIDE = 1.6  # columns to a row from which on a photo is a panorama
_LEFT = (800.0, 700.0)  # width and height of the part of a window that has pictures, in points
_TITLE = 28.0  # height of the title of a view, in points
_LEAST = 240.0  # width of a view of whose title enough is seen, in points


def compare_tab(contents: Contents) -> rrb.Container:
    """Both lines on the photo and on every map of what differs, and where they part."""
    first, second = (shortened(one, _MOST) for one in (contents.first, contents.compared))
    truth = ", turquoise: truth" if contents.truth else ""
    lines = [entities.PATH, entities.ALTERNATIVE, *([entities.TRUTH] if contents.truth else [])]
    photo = photo_view(
        f"Magenta: {first}, yellow: {second}{truth}",
        [entities.PHOTO, *(f"{line}/**" for line in lines)],
    )
    maps = [_difference(contents, one, lines) for one in contents.apart]
    text = rrb.TextDocumentView(origin=entities.COMPARISON, name="Where they part")
    shape = contents.width / contents.height
    if not maps:
        return rrb.Horizontal(photo, text, column_shares=[3, 2], name="Compare")
    pictures: rrb.Container = _in_rows([photo, *maps], shape, _LEFT)
    if shape > _WIDE:  # a panorama needs the width
        below_it = _in_rows(maps, shape, (_LEFT[0], _LEFT[1] * 0.6))
        shares = [2, 1 + len([*below_it.contents])]
        pictures = rrb.Vertical(photo, below_it, row_shares=shares)
    return rrb.Horizontal(pictures, text, column_shares=[5, 3], name="Compare")


def side_by_side_tab(contents: Contents) -> rrb.Container:
    """The stages of both detections, each beside that of the other."""
    views, truth = [], lines_of(contents)[1:]
    first, second = (shortened(one, _MOST) for one in (contents.first, contents.compared))
    both = dict.fromkeys([*contents.stages, *contents.compared_stages])
    stages = [one for one in both if "Stages" in one.tabs and one.group != "tensor"]
    for one in stages:
        title, stage = (one.word or one.name).capitalize(), entities.of_quantity(one)
        names = (
            first if one in contents.stages else f"{first} has none",
            second if one in contents.compared_stages else f"{second} has none",
        )
        views += [
            map_view(contents, f"{title}: {names[0]}", [stage], [entities.PATH, *truth]),
            map_view(
                contents,
                f"{title}: {names[1]}",
                [below(entities.OTHER, stage)],
                [entities.ALTERNATIVE, *truth],
            ),
        ]
    reports = [
        rrb.TextDocumentView(origin=origin, name=shown_in_viewer(f"Report of {name}"))
        for name, origin in (
            (first, entities.REPORT),
            (second, below(entities.OTHER, entities.REPORT)),
        )
    ]
    if contents.width > _WIDE * contents.height:
        return rrb.Horizontal(
            rrb.Grid(*views, grid_columns=2),
            rrb.Vertical(*reports),
            column_shares=[3, 1],
            name="Side by side",
        )
    above, under = views[::2], views[1::2]
    rows = [
        rrb.Horizontal(*row, report) for row, report in zip((above, under), reports, strict=True)
    ]
    return rrb.Vertical(*rows, name="Side by side")


def _difference(contents: Contents, one: Quantity, lines: Sequence[str]) -> rrb.View:
    """A map of what the second has more. Its title is short: of many maps each has little room."""
    title = "Edges of one alone" if one.name == EDGES.name else one.title
    return map_view(contents, title, [entities.of_quantity(one)], lines)


def _in_rows(views: Sequence[rrb.View], shape: float, room: tuple[float, float]) -> rrb.Container:
    """Views in as many rows as let their pictures be largest; a row may have one less than others.

    Args:
        views: The views.
        shape: Width of a picture by its height.
        room: Width and height that there is, in points.
    """
    count = len(views)

    def size(rows: int) -> float:
        wide, high = room[0] / -(-count // rows), room[1] / rows - _TITLE
        return min(wide / shape, high) if wide >= _LEAST or rows == count else 0.0

    rows = np.array_split(np.arange(count), max(range(1, count + 1), key=size))
    return rrb.Vertical(*(rrb.Horizontal(*(views[at] for at in row)) for row in rows))
