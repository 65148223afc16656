"""What routes are given: the workbench, and checked parts of their addresses."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from fastapi import Depends, Path, Request

from annotate.work.learning import Learner
from annotate.work.shown import Pictures
from annotate.work.workbench import Workbench


def _bench(request: Request) -> Workbench:
    bench: Workbench = request.app.state.bench
    return bench


def _learner(request: Request) -> Learner:
    learner: Learner = request.app.state.learner
    return learner


def _pictures(request: Request) -> Pictures:
    pictures: Pictures = request.app.state.pictures
    return pictures


Bench: TypeAlias = Annotated[Workbench, Depends(_bench)]
"""The workbench of the server."""

TheLearner: TypeAlias = Annotated[Learner, Depends(_learner)]
"""What learns from the labels."""

ThePictures: TypeAlias = Annotated[Pictures, Depends(_pictures)]
"""The pictures of its photos."""

PhotoId: TypeAlias = Annotated[int, Path(ge=1, le=2**62)]
"""A photo, never by its path."""

Column: TypeAlias = Annotated[int, Path(ge=0, le=100_000)]
"""A column of a photo."""

Row: TypeAlias = Annotated[int, Path(ge=0, le=100_000)]
"""A row of a photo."""

Tile: TypeAlias = Annotated[int, Path(ge=0, le=1000)]
"""Number of a tile, across or down."""
