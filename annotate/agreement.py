"""How far two passes over the same photos agree: pixels a column, and where they do not."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from annotate.store.labels import Label
from skyline_viz.arrays import F64, U8
from skyline_viz.overlay import draw_overlay
from skyline_viz.photo import PhotoError, read_photo

WITHIN = (1, 2, 5)
"""Differences, in pixels, of which the share of columns is told."""

_MOST = 6  # photos in a picture
_WIDTH = 960  # of a photo in a picture


@dataclass(frozen=True, eq=False)
class Pair:
    """Two labels of a photo."""

    first: Label
    second: Label
    differences: F64
    """``(m,)`` in pixels, in the columns that are visible in both."""

    @property
    def mean(self) -> float:
        """Mean difference, in pixels."""
        return float(self.differences.mean())

    @property
    def worst(self) -> float:
        """Largest difference, in pixels."""
        return float(self.differences.max())


@dataclass(frozen=True)
class Agreement:
    """How far two passes agree, over all columns of all photos."""

    photos: int
    columns: int
    mean: float
    """Mean difference, in pixels a column."""

    worst: float
    """Largest difference, in pixels."""

    within: tuple[float, ...]
    """Share of columns that differ by at most `WITHIN` pixels."""

    @classmethod
    def of(cls, pairs: Sequence[Pair]) -> Agreement:
        """Sum up pairs, of which there is at least one."""
        every = np.concatenate([pair.differences for pair in pairs])
        return cls(
            photos=len(pairs),
            columns=len(every),
            mean=float(every.mean()),
            worst=float(every.max()),
            within=tuple(float((every <= most).mean()) for most in WITHIN),
        )


def paired(first: Iterable[Label], second: Iterable[Label]) -> list[Pair]:
    """Accepted labels of the same photos, the ones that differ most in the mean first."""
    others = {label.digest: label for label in second if label.status == "accepted"}
    pairs = []
    for one in first:
        other = others.get(one.digest)
        if one.status != "accepted" or other is None or not one.skyline or not other.skyline:
            continue
        both = one.skyline.visible & other.skyline.visible
        if both.any():
            apart = np.abs(one.skyline.rows - other.skyline.rows)[both].astype(np.float64)
            pairs.append(Pair(one, other, apart))
    return sorted(pairs, key=lambda pair: -pair.mean)


def picture(pairs: Sequence[Pair], photos: Path) -> U8 | None:
    """The photos on which two passes differ most, the first in magenta, the second in turquoise.

    Returns:
        ``(h, w, 3)`` RGB; None where no photo can be read.
    """
    rows = []
    for pair in pairs[:_MOST]:
        try:
            photo = read_photo(photos / pair.first.name)
        except PhotoError:
            continue
        drawn = draw_overlay(photo, pair.first.skyline, pair.second.skyline)
        height = max(round(len(drawn) * _WIDTH / drawn.shape[1]), 1)
        small = cv2.resize(drawn, (_WIDTH, height), interpolation=cv2.INTER_AREA)
        title = np.full((28, _WIDTH, 3), 24, np.uint8)
        words = f"{Path(pair.first.name).name}  mean {pair.mean:.2f} px, worst {pair.worst:.0f} px"
        plain = words.encode("ascii", "replace").decode()
        cv2.putText(
            title, plain, (8, 19), cv2.FONT_HERSHEY_SIMPLEX, 0.5, (230, 230, 230), 1, cv2.LINE_AA
        )
        rows += [title, small]
    return np.concatenate(rows) if rows else None
