"""What several labels of a photo have in common, and where they do not agree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from annotate.agreement.pairs import NEAR
from annotate.engine.edits import ORIGINS
from annotate.store.labels import Label
from annotate.store.lines import Line
from skyline_viz.arrays import Bool, Int, runs
from skyline_viz.skyline import Skyline

WITHIN = 2.0
"""Rows by which lines may differ that agree, in pixels."""

Origins: TypeAlias = npt.NDArray[np.uint8]

_PROPOSAL = ORIGINS.index("proposal")


@dataclass(frozen=True, eq=False)
class Common:
    """The line that several labels have in common."""

    line: Line
    """Where they agree, the median of their rows. Elsewhere that of the label nearest to the
    others. Each column has the origin of a label that agrees with it; `proposal` only where none of
    these has been changed there."""

    apart: tuple[tuple[int, int], ...]
    """First and last column of each span in which they do not agree."""

    worst: float
    """Largest difference in these, in pixels; 0 where they differ only in what is visible."""


def common(labels: Sequence[Label], within: float = WITHIN) -> Common:
    """Compare labels of one photo.

    They agree in a column where all of them see the line, their rows differing by no more than
    `within`, and where none of them sees it.

    Args:
        labels: Labels with a line, one at least.
        within: Rows by which lines may differ that agree, in pixels.
    """
    lines = [label.skyline for label in labels if label.skyline is not None]
    rows = np.stack([line.rows for line in lines]).astype(np.int32)
    visible = np.stack([line.visible for line in lines])
    between = np.ptp(rows, axis=0)
    all_see: Bool = np.all(visible, axis=0)
    none_sees: Bool = ~np.any(visible, axis=0)
    differ: Bool = ~none_sees & ~(all_see & (between <= within))
    spans = runs(differ, gap=round(NEAR * rows.shape[1]))
    middle = np.floor(np.median(rows, axis=0) + 0.5).astype(np.int32)
    seen = all_see.copy()
    for first, last in spans:
        inside = slice(first, last + 1)
        nearest = _nearest(rows[:, inside], visible[:, inside])
        middle[inside], seen[inside] = rows[nearest, inside], visible[nearest, inside]
    origins = np.stack([label.origin for label in labels if label.skyline is not None])
    skyline = Skyline(rows=middle.astype(np.float32), visible=seen)
    worst = float(between[differ & all_see].max(initial=0))
    return Common(Line(skyline, _origin(rows, middle, origins, within)), tuple(spans), worst)


def _nearest(rows: Int, visible: Bool) -> int:
    """Place of the line that is nearest to all others, of ``(n, m)`` rows; the first of several.

    A column that one sees and another does not counts as if they were as far from each other as any
    two are.
    """
    far = max(int(np.ptp(rows)), 1)
    apart = np.abs(rows[:, None] - rows[None])
    apart[visible[:, None] != visible[None]] = far
    return int(apart.sum(axis=(1, 2), dtype=np.int64).argmin())


def _origin(rows: Int, middle: Int, origins: Origins, within: float) -> Origins:
    """``(W,)`` origin of a label that agrees with the row of each column, see `Common`."""
    far = np.abs(rows - middle)
    agrees = far <= np.maximum(far.min(axis=0), within)
    changed = agrees & (origins != _PROPOSAL)
    best = np.where(changed, far, np.where(agrees, far + far.max() + 1, np.iinfo(np.int32).max))
    chosen: Origins = np.take_along_axis(origins, best.argmin(axis=0)[None], axis=0)[0]
    return chosen
