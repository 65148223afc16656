"""Which pixels of a large photo a full recording keeps exactly: those near the lines.

A line is looked at from near. So the maps of a large photo have every pixel within some rows of the
path, and of the truth, as exact as those of a small one. Elsewhere one pixel stands for a block of
them, and is as exact; nothing is averaged, and nothing is made of pixels that are not kept.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
import rerun as rr

from skyline_viz.arrays import Bool, Int
from skyline_viz.skyline import Skyline
from skyline_viz.stage import Quantity
from skyline_viz.system.memory import give_back
from skyline_viz.viewer.maps.value_maps import FINE, ValueMap, classes_of, value_range

NEAR_PIXELS = 600_000
"""Pixels that are kept exactly, all lines together: 36 bytes each make 22 MB."""

BLOCK = 8
"""Rows and columns for which one pixel stands elsewhere."""

Sampler: TypeAlias = Callable[[Int, Int], npt.NDArray[np.floating[Any]]]
"""Gives the values of pixels at some rows and columns ``(k,)``, in ascending order of rows."""


@dataclass(frozen=True, eq=False)
class Sampled:
    """What is kept of a map of a large photo."""

    blocks: npt.NDArray[np.floating[Any]]
    """``(h, w)`` the value of one pixel of each block."""

    exact: npt.NDArray[np.floating[Any]]
    """``(k,)`` values of the near pixels, row by row."""


@dataclass(frozen=True, eq=False)
class Near:
    """The pixels of a photo that are near some lines."""

    shape: tuple[int, int]
    """Height and width of the photo."""

    around: int
    """Rows above and below each line that are near."""

    rows: Int
    """``(k,)`` rows of the near pixels, row by row."""

    columns: Int
    """``(k,)`` their columns."""

    @classmethod
    def to(cls, shape: tuple[int, int], *lines: Skyline | None) -> Near:
        """What is near some lines.

        Args:
            shape: Height and width of the photo.
            lines: The lines; None for one that there is not.
        """
        height, width = shape
        known = [line.rows for line in lines if line is not None]
        around = max(NEAR_PIXELS // (width * len(known)) // 2, 1)
        mask = np.zeros((width, height), np.bool_)
        for rows in known:
            first = np.clip(rows - around, 0, height).astype(np.intp)
            last = np.clip(rows + around, -1, height - 1).astype(np.intp)
            for column, (begin, end) in enumerate(zip(first.tolist(), last.tolist(), strict=True)):
                mask[column, begin : end + 1] = True
        places = np.flatnonzero(mask.T)
        return cls(
            shape,
            around,
            (places // width).astype(np.int32),
            (places % width).astype(np.int32),
        )

    @property
    def mask(self) -> Bool:
        """``(H, W)`` whether a pixel is near. It is made each time, and not kept."""
        made: Bool = np.zeros(self.shape, np.bool_)
        made[self.rows, self.columns] = True
        return made

    def sample(self, values: Sampler) -> Sampled:
        """Values of one pixel of each block, and of the near pixels."""
        rows, columns = (_middles(length) for length in self.shape)
        blocks = values(np.repeat(rows, len(columns)), np.tile(columns, len(rows)))
        return Sampled(blocks.reshape(len(rows), len(columns)), values(self.rows, self.columns))

    def map(self, quantity: Quantity, sampled: Sampled, levels: int) -> ValueMap:
        """The map of a whole photo.

        Args:
            quantity: What the values are.
            sampled: The values; NaN is none.
            levels: Values to tell apart.
        """
        height, width = self.shape
        known = (one[np.isfinite(one)] for one in (sampled.blocks, sampled.exact))
        low, high = value_range(quantity, *known)
        wide = classes_of(sampled.blocks, low, high, levels).repeat(BLOCK, axis=1)[:, :width]
        classes = np.empty((height, width), wide.dtype)
        for row, line in enumerate(wide):
            classes[row * BLOCK : (row + 1) * BLOCK] = line
        classes[self.rows, self.columns] = classes_of(sampled.exact, low, high, levels)
        return ValueMap(classes, levels, quantity, low, high)

    def log(
        self, recording: rr.RecordingStream, entity: str, quantity: Quantity, sampled: Sampled
    ) -> None:
        """Log a map, and beside it the exact values of the near pixels, row by row."""
        self.map(quantity, sampled, FINE).log(recording, entity)
        let_go(recording)
        recording.log(entity, rr.AnyValues(exact=sampled.exact))

    def said(self) -> str:
        """What is kept, as a sentence."""
        return (
            f"Maps hold every pixel within {self.around} rows of a line, and elsewhere one of each "
            f"{BLOCK} by {BLOCK}; of edge pixels elsewhere those that are cheapest in their column."
        )


def let_go(recording: rr.RecordingStream) -> None:
    """Have a map of a large photo written, and its memory given back, before the next one is made.

    What was freed has to go each time: the next map is put where the last ones were.
    """
    recording.flush()
    give_back()


def _middles(length: int) -> Int:
    """The pixel that stands for each block of a row or column."""
    middles: Int = np.arange(BLOCK // 2, length + BLOCK // 2, BLOCK, dtype=np.int32)
    return np.minimum(middles, length - 1)
