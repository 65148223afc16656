"""What other programs draw on photos, whatever their files are like: shapes with labels."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from skyline_viz.command_line.messages import counted
from skyline_viz.datasets.outlines import Points, Runs
from skyline_viz.system.names import listed

LINES, SKIES = ("skyline", "horizon"), ("sky",)
"""Labels of lines that are skylines, and of regions that are sky, unless others are named."""


@dataclass(frozen=True, eq=False)
class Shape:
    """Something that was drawn on a photo."""

    label: str
    """What it was said to be."""

    kind: str
    """``line``, ``polygon``, ``mask``, or the word of the program for what is not read."""

    rings: tuple[Points, ...] = ()
    """The points of a line, or the corners of polygons whose union it is."""

    runs: Runs | None = None
    """The pixels of a mask."""


@dataclass(frozen=True, eq=False)
class Drawing:
    """All that was drawn on one photo, in one file."""

    names: tuple[str, ...]
    """What the file calls the photo, the likeliest first."""

    size: tuple[int, int] | None
    """Height and width of the photo, where the file says so."""

    shapes: tuple[Shape, ...]
    tags: tuple[str, ...] = ()

    whole: bool = False
    """Whether columns without sky are known to have none, and not only left out."""


@dataclass(frozen=True)
class Wanted:
    """Which labels mean what, compared without case."""

    lines: frozenset[str] = frozenset(LINES)
    sky: frozenset[str] = frozenset(SKIES)
    terrain: frozenset[str] = frozenset()

    @classmethod
    def of(
        cls, label: str | None = None, sky: str | None = None, terrain: str | None = None
    ) -> Wanted:
        """What a user asks for; the usual labels where nothing is."""
        if label is None and sky is None and terrain is None:
            return cls()
        regions = _names(sky) if sky is not None else _names(label)
        return cls(_names(label), frozenset() if terrain is not None else regions, _names(terrain))

    def is_line(self, shape: Shape) -> bool:
        """Whether a shape is a skyline."""
        return shape.kind == "line" and _plain(shape.label) in self.lines

    def is_sky(self, shape: Shape) -> bool:
        """Whether a shape is a region of sky."""
        return shape.kind in ("polygon", "mask") and _plain(shape.label) in self.sky

    def is_terrain(self, shape: Shape) -> bool:
        """Whether a shape is a region of terrain."""
        return shape.kind in ("polygon", "mask") and _plain(shape.label) in self.terrain

    def takes(self, shape: Shape) -> bool:
        """Whether a shape is any of them."""
        return self.is_line(shape) or self.is_sky(shape) or self.is_terrain(shape)

    @property
    def said(self) -> str:
        """What is looked for, in words."""
        parts = []
        if self.lines:
            parts.append(f"a line {' or '.join(sorted(self.lines, reverse=True))}")
        if self.sky:
            parts.append(f"a region {' or '.join(sorted(self.sky))}")
        if self.terrain:
            parts.append(f"a region {' or '.join(sorted(self.terrain))} of terrain")
        return " or ".join(parts) or "nothing"


def labels_found(shapes: Iterable[Shape]) -> str:
    """The labels of shapes, with their kinds and numbers, in words.

    >>> labels_found([Shape("sky", "polygon"), Shape("sky", "polygon"), Shape("tree", "box")])
    'sky (2 polygons), tree (1 box)'
    """
    kinds = Counter((one.label.strip() or "(no name)", one.kind) for one in shapes)
    shown = [
        f"{label[:60]} ({count} boxes)"
        if kind == "box" and count > 1
        else f"{label[:60]} ({counted(count, kind)})"
        for (label, kind), count in kinds.most_common()
    ]
    return listed(shown) if shown else "none"


def _plain(label: str) -> str:
    return label.strip().casefold()


def _names(text: str | None) -> frozenset[str]:
    return frozenset(_plain(one) for one in (text or "").split(",") if one.strip())
