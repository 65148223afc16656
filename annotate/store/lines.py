"""A line as the store keeps it: rows, visible columns and origins in a few hundred bytes."""

from __future__ import annotations

import zlib
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from annotate.engine.edits import ORIGINS
from skyline_viz.skyline import Skyline


class LineError(ValueError):
    """Bytes are no line; the message says why."""


@dataclass(frozen=True, eq=False)
class Line:
    """A labelled skyline."""

    skyline: Skyline
    """Whole rows, and which columns are visible."""

    origin: npt.NDArray[np.uint8]
    """``(W,)`` where the row of each column is from, as an index into `labels.ORIGINS`."""

    def packed(self) -> bytes:
        """Bytes for the store: changes of the row from column to column, zlib-compressed."""
        rows = self.skyline.rows.astype(np.int32)
        changes = np.diff(rows, prepend=np.int32(0)).astype("<i4")
        visible = self.skyline.visible.astype(np.uint8)
        return zlib.compress(changes.tobytes() + visible.tobytes() + self.origin.tobytes(), 6)

    @classmethod
    def unpacked(cls, data: bytes) -> Line:
        """Read what `packed` gave.

        Raises:
            LineError: It is damaged.

        >>> line = Line(Skyline(rows=[3, 4, 9]), np.array([0, 1, 1], np.uint8))
        >>> Line.unpacked(line.packed()).skyline == line.skyline
        True
        """
        try:
            whole = zlib.decompress(data)
        except (zlib.error, TypeError) as error:
            raise LineError("its line is damaged.") from error
        width, rest = divmod(len(whole), 6)
        if rest or not width:
            raise LineError("its line is damaged.")
        rows = np.cumsum(np.frombuffer(whole, "<i4", width))
        visible = np.frombuffer(whole, np.uint8, width, 4 * width).astype(np.bool_)
        origin = np.frombuffer(whole, np.uint8, width, 5 * width)
        if origin.max() >= len(ORIGINS):
            raise LineError("its line is damaged.")
        return cls(Skyline(rows=rows.astype(np.float32), visible=visible), origin)
