"""The sizes of sky models. Light to import."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias


@dataclass(frozen=True)
class Size:
    """How large a network is."""

    rows: int
    """Rows of its input: more than columns, for a far ridge is low and wide."""

    columns: int
    """Columns of its input."""

    widths: tuple[int, ...]
    """Channels at each scale, from fine to coarse."""

    depth: int
    """Layers at each scale, besides the one that leads there."""


SizeName: TypeAlias = Literal["small", "large"]
"""Name of a size."""

SIZES: dict[SizeName, Size] = {
    "small": Size(192, 128, (16, 32, 48, 64, 68), 1),
    "large": Size(256, 160, (32, 64, 128, 192, 224), 1),
}
"""By name."""

BATCH = 16
"""Photos a step."""

STEPS = 6000
"""Batches that a model sees unless told otherwise."""
