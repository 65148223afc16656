"""What routes are given: what the person works with, and checked parts of their addresses."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from fastapi import Depends, Path, Request

from annotate.server.desks import Desk
from annotate.work.learning import Learner
from annotate.work.shown import Pictures
from annotate.work.workbench import Workbench


def _desk(request: Request) -> Desk:
    desk: Desk = request.state.desk  # which `Guard` has found by the token
    return desk


TheDesk: TypeAlias = Annotated[Desk, Depends(_desk)]
"""What the person who asks works with."""


def _bench(desk: TheDesk) -> Workbench:
    return desk.bench


def _learner(desk: TheDesk) -> Learner:
    return desk.learner


def _pictures(desk: TheDesk) -> Pictures:
    return desk.pictures


Bench: TypeAlias = Annotated[Workbench, Depends(_bench)]
"""The labels of the person."""

TheLearner: TypeAlias = Annotated[Learner, Depends(_learner)]
"""What learns from them."""

ThePictures: TypeAlias = Annotated[Pictures, Depends(_pictures)]
"""The pictures of their photos."""

PhotoId: TypeAlias = Annotated[int, Path(ge=1, le=2**62)]
"""A photo, never by its path."""

Column: TypeAlias = Annotated[int, Path(ge=0, le=100_000)]
"""A column of a photo."""

Row: TypeAlias = Annotated[int, Path(ge=0, le=100_000)]
"""A row of a photo."""

Tile: TypeAlias = Annotated[int, Path(ge=0, le=1000)]
"""Number of a tile, across or down."""
