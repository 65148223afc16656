"""A state as bytes, so that a long log need not be folded from its beginning.

A checkpoint saves time and is never trusted further: what is damaged, of another version, or does
not fit the log counts as none, and the log is folded instead.
"""

from __future__ import annotations

import zlib
from types import MappingProxyType
from typing import Literal

from pydantic import BaseModel, ConfigDict, ValidationError

from annotate.engine.edits import Edits, Origin, Span
from annotate.engine.guide import Guide
from annotate.engine.hidden import Hidden
from annotate.engine.steering import Ground, Left, Side, Steering, Stroke
from annotate.store.history import State, Step
from annotate.store.labels import Status
from annotate.store.operations import Change

EVERY = 100
"""Operations of a label from one checkpoint to the next."""

_VERSION = 1  # to be raised whenever the same log gives another state
_SAME = ("taken", "status", "tags", "seconds", "at", "count", "last", "revision")  # as in a state


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _Span(_Part):
    kind: Origin
    first: int
    rows: tuple[int, ...]


class _Stroke(_Part):
    points: tuple[tuple[int, int], ...]
    radius: int
    allow: bool


class _Guide(_Part):
    first: int
    tops: tuple[int, ...]
    bottoms: tuple[int, ...]


class _Side(_Part):
    first: int
    rows: tuple[int, ...]
    ground: Ground


class _Left(_Part):
    points: tuple[tuple[int, int], ...]
    radius: int
    of: int


class _Checkpoint(_Part):
    version: Literal[1]
    label: int
    height: int
    width: int
    anchors: list[tuple[int, int]]
    spans: tuple[_Span, ...]
    strokes: tuple[_Stroke | _Guide | _Side | _Left, ...]
    hidden: tuple[Hidden, ...]
    steps: list[tuple[Change, Status]]
    taken: tuple[Change, ...]
    status: Status
    tags: tuple[str, ...]
    seconds: float
    at: float | None
    count: int
    last: int
    revision: int


_STEERING = {_Stroke: Stroke, _Guide: Guide, _Side: Side, _Left: Left}


def packed(state: State, label: int) -> bytes:
    """Bytes of the state of a label, without its line: JSON, zlib-compressed."""
    edits = state.edits
    checkpoint = _Checkpoint.model_construct(
        version=_VERSION,
        label=label,
        height=edits.height,
        width=edits.width,
        anchors=list(edits.anchors.items()),
        spans=tuple(_Span.model_construct(**vars(one)) for one in edits.spans),
        strokes=tuple(_steering(one) for one in edits.strokes),
        hidden=edits.hidden,
        steps=[(one.change, one.status) for one in state.steps],
        **{name: getattr(state, name) for name in _SAME},
    )
    return zlib.compress(checkpoint.model_dump_json(by_alias=True).encode(), 1)


def unpacked(data: bytes, label: int, empty: Edits) -> State | None:
    """The state that `packed` was given, but for its line; None where the bytes are of no use.

    Args:
        data: The bytes.
        label: The label that they should belong to.
        empty: No edits, of the size of its photo.
    """
    try:
        found = _Checkpoint.model_validate_json(zlib.decompress(data))
    except (zlib.error, TypeError, ValidationError):  # not compressed, no bytes, or not whole
        return None
    if (found.label, found.height, found.width) != (label, empty.height, empty.width):
        return None
    return State(
        edits=Edits(
            found.height,
            found.width,
            MappingProxyType(dict(found.anchors)),
            tuple(Span(**vars(one)) for one in found.spans),
            tuple(_STEERING[type(one)](**vars(one)) for one in found.strokes),
            found.hidden,
        ),
        steps=tuple(Step(change, status) for change, status in found.steps),
        **{name: getattr(found, name) for name in _SAME},
    )


def _steering(one: Steering) -> _Stroke | _Guide | _Side | _Left:
    if isinstance(one, Guide):
        return _Guide.model_construct(first=one.first, tops=one.tops, bottoms=one.bottoms)
    if isinstance(one, Side):
        return _Side.model_construct(first=one.first, rows=one.rows, ground=one.ground)
    if isinstance(one, Left):
        return _Left.model_construct(points=one.points, radius=one.radius, of=one.of)
    return _Stroke.model_construct(points=one.points, radius=one.radius, allow=one.allow)
