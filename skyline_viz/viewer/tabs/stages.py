"""Tabs of maps: *Stages*, figure 1 of the paper and what is added to it, *Tensor*, *Terms*."""

from __future__ import annotations

from collections.abc import Sequence

import rerun.blueprint as rrb

from skyline_viz.stage import ADDED, COST, FUSED, Quantity
from skyline_viz.viewer import entities
from skyline_viz.viewer.contents import Contents
from skyline_viz.viewer.tabs.views import grid, map_view, photo_view, with_halos

_PAPERS = ("edges", "score", "strength", "score and strength")  # figure 1 besides photo and path
_FIGURE_1 = {
    "edges": 0,
    "score": 1,
    "score and strength": 3,
    "cost": 4,
}  # where others have no place of their own: 2


def stages_tab(contents: Contents, stages: dict[str, list[str]], name: str) -> rrb.Container:
    """Maps beside each other, by their titles, with what each shows."""
    views = [
        photo_view(title, shown) if entities.PHOTO in shown else map_view(contents, title, shown)
        for title, shown in stages.items()
    ]
    return grid(contents, views, name)


def own_tab(contents: Contents, quantities: Sequence[Quantity], name: str) -> list[rrb.Container]:
    """A tab of those quantities that belong there; nothing without any."""
    views = {one.title: [entities.of_quantity(one)] for one in quantities if name in one.tabs}
    return [stages_tab(contents, views, name)] if views else []


def lettered(contents: Contents) -> dict[str, list[str]]:
    """Figure 1 of the paper, (a) to (f), and what we add to it as added; or all of another's."""
    figure = figure_1(contents.stages)
    path = [entities.PHOTO, *with_halos()]
    ours = FUSED in contents.stages
    papers = {one.title for one in contents.stages if one.name in _PAPERS or not ours}
    known = {title: shown for title, shown in figure.items() if title in papers}
    views = {"Photo": [entities.PHOTO], **known, "Path": path}
    named = {f"({chr(ord('a') + at)}) {title}": views[title] for at, title in enumerate(views)}
    added = {title: shown for title, shown in figure.items() if title not in papers}
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
