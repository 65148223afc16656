"""Layouts of the viewer, taken apart."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any


def tab_of(blueprint: Any, name: str) -> Any:
    """The tab of that name."""
    return next(tab for tab in blueprint.root_container.contents if tab.name == name)


def tab_titles(blueprint: Any) -> list[str]:
    """Names of the tabs, from left to right."""
    return [tab.name for tab in blueprint.root_container.contents]


def views_of(part: Any) -> Iterator[Any]:
    """All views of a tab, from left to right and from top to bottom."""
    inside = [one for one in getattr(part, "contents", []) or [] if not isinstance(one, str)]
    if not inside:
        yield part
    for one in inside:
        yield from views_of(one)


def shown_in(part: Any) -> set[str]:
    """Entity paths that the views of a tab begin at or show."""
    views = list(views_of(part))
    wanted = {one.removeprefix("+ /") for view in views for one in view.contents or []}
    return wanted | {str(view.origin).removeprefix("/") for view in views}
