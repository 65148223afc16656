"""What a sky model learns from: small photos, and how much of each of their pixels is sky."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, check_photo
from skyline_viz.skyline import Skyline, SkylineError

ROWS, COLUMNS = 384, 256
"""Size that examples are squeezed to: twice the input of the small network, to crop from."""

STEP_SHARE = 0.015
"""A photo has a skyline when its sky differs from what lies above a line in this share at most."""


@dataclass(frozen=True, eq=False)
class Example:
    """A photo, squeezed to `ROWS` x `COLUMNS`."""

    photo: U8 = field(repr=False)
    """``(ROWS, COLUMNS, 3)`` uint8 RGB."""

    sky: U8 = field(repr=False)
    """``(ROWS, COLUMNS)`` uint8, the share of each pixel that is sky, 255 for all of it."""

    source: str
    """Data set that it is from."""

    @classmethod
    def of(cls, photo: U8, truth: Skyline, source: str) -> Example:
        """The example of a photo ``(H, W, 3)`` uint8 RGB and its true skyline.

        Columns in which the line is not visible take the line between their neighbours.

        Raises:
            SkylineError: They differ in width, or no column is visible.
        """
        check_photo(photo)
        height, width = photo.shape[:2]
        if truth.width != width:
            raise SkylineError(f"the truth has {truth.width} columns, the photo {width}")
        columns = np.flatnonzero(truth.visible)
        if not len(columns):
            raise SkylineError("no column of the truth is visible")
        rows = np.interp(np.arange(width), columns, truth.rows[columns])
        share = np.clip(rows[None, :] - np.arange(height, dtype=np.float32)[:, None], 0, 1)
        return cls(squeezed(photo), squeezed((share * 255).astype(np.uint8)), source)

    @cached_property
    def line(self) -> F32 | None:
        """``(COLUMNS,)`` row of its skyline; None where its sky is not all that lies above one."""
        share = self.sky.astype(np.float32) / 255
        rows: F32 = share.sum(axis=0)
        above = np.clip(rows - np.arange(ROWS, dtype=np.float32)[:, None], 0, 1)
        return rows if np.abs(share - above).mean() < STEP_SHARE else None


def squeezed(image: U8) -> U8:
    """A photo or a map at the size of examples."""
    small: U8 = cv2.resize(image, (COLUMNS, ROWS), interpolation=cv2.INTER_AREA)
    return small
