"""Tabs of maps: *Stages*, figure 1 of the paper and what is added to it, *Tensor*, *Terms*."""

from __future__ import annotations

from collections.abc import Sequence

import rerun.blueprint as rrb

from skyline_viz.stage import ADDED, BIN, COST, Quantity
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import grid, lines_of, map_view, photo_view, with_halos

_LETTERS = {"edges": "b", "score": "c", "strength": "d", "score and strength": "e"}
"""Letters of the paper's figure 1, in which (a) is the photo and (f) the path."""

_FIGURE_1 = {
    "edges": 0,
    "score": 1,
    "score and strength": 3,
    "cost": 4,
}  # where others have no place of their own: 2


def stages_tab(contents: Contents, stages: dict[str, list[str]], name: str) -> rrb.Container:
    """Maps beside each other, by their titles, with what each shows."""
    views = [
        photo_view(title, shown)
        if entities.PHOTO in shown
        else map_view(contents, title, shown, lines_of(contents))
        for title, shown in stages.items()
    ]
    return grid(contents, views, name)


def own_tab(contents: Contents, quantities: Sequence[Quantity], name: str) -> list[rrb.Container]:
    """A tab of those quantities that belong there; nothing without any."""
    views = {one.title: [entities.of_quantity(one)] for one in quantities if name in one.tabs}
    return [stages_tab(contents, views, name)] if views else []


def lettered(contents: Contents) -> dict[str, list[str]]:
    """Figure 1 of the paper, (a) to (f), and what we add to it as added; or all of another's."""
    figure, path = figure_1(contents.stages), [entities.PHOTO, *with_halos()]
    if BIN not in contents.stages:
        views = {"Photo": [entities.PHOTO], **figure, "Path": path}
        return {f"({chr(ord('a') + at)}) {title}": views[title] for at, title in enumerate(views)}
    letters = {one.title: _LETTERS.get(one.name) for one in contents.stages}
    named = {f"({letters[title]}) {title}": figure[title] for title in figure if letters[title]}
    named = {"(a) Photo": [entities.PHOTO], **named, "(f) Path": path}
    added = {title: figure[title] for title in figure if not letters[title]}
    if ADDED in contents.terms:
        added[ADDED.title] = [entities.of_quantity(ADDED)]
    return named | {
        title if title == COST.title else f"Added: {title}": shown for title, shown in added.items()
    }


def figure_1(stages: Sequence[Quantity]) -> dict[str, list[str]]:
    """Titles and entities of the stages, in the order of the paper's figure."""
    mine = [one for one in stages if "Stages" in one.tabs]
    mine.sort(key=lambda one: _FIGURE_1.get(one.name, 2))
    return {one.title: [entities.of_quantity(one)] for one in mine}
