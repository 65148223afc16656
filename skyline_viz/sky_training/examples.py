"""What a sky model learns from: small photos, and how much of each of their pixels is sky."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, check_photo
from skyline_viz.datasets.item import Item
from skyline_viz.sky_model import SkyModel
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.fingerprints import fingerprint

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

    seen: str = ""
    """Fingerprint of the photo as it was; empty where it is not known."""

    @classmethod
    def of(cls, photo: U8, truth: Skyline, source: str, name: str = "") -> Example:
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
        sky = squeezed((share * 255).astype(np.uint8))
        return cls(squeezed(photo), sky, source, fingerprint(photo, name))

    @classmethod
    def with_line(cls, line: F32 | None, photo: U8, sky: U8, source: str, seen: str) -> Example:
        """An example of which the line is known already, and need not be told from its sky."""
        one = cls(photo, sky, source, seen)
        vars(one)["line"] = line
        return one

    @cached_property
    def line(self) -> F32 | None:
        """``(COLUMNS,)`` row of its skyline; None where its sky is not all that lies above one."""
        share = self.sky.astype(np.float32) / 255
        rows: F32 = share.sum(axis=0)
        above = np.clip(rows - np.arange(ROWS, dtype=np.float32)[:, None], 0, 1)
        return rows if np.abs(share - above).mean() < STEP_SHARE else None


def example_of(item: Item, source: str, teacher: SkyModel | None = None) -> Example | None:
    """What there is to learn from a photo of a data set; None for nothing.

    Args:
        item: A photo, with its truth or without.
        source: Name of the data set.
        teacher: A network that says what is sky in a photo without truth.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: Its truth does not fit.
    """
    truth = item.truth()
    if truth is not None:
        if not truth.visible.any():
            return None
        one = Example.of(item.photo(), truth, source, item.name)
    elif teacher is not None:
        one = taught(item.photo(), teacher, source, item.name)
    else:
        return None
    _ = one.line  # told here, in whatever process this is, and goes along
    return one


def taught(photo: U8, teacher: SkyModel, source: str, name: str = "") -> Example:
    """The example of a photo ``(H, W, 3)`` of which a teacher says what is sky.

    It sees the photo mirrored as well, and the mean of both is taken.
    """
    mirrored = np.ascontiguousarray(photo[:, ::-1])
    sky = (teacher.sky(photo) + teacher.sky(mirrored)[:, ::-1]) / 2
    levels = np.rint(sky * 255).astype(np.uint8)
    return Example(squeezed(photo), squeezed(levels), source, fingerprint(photo, name))


def squeezed(image: U8) -> U8:
    """A photo or a map at the size of examples."""
    small: U8 = cv2.resize(image, (COLUMNS, ROWS), interpolation=cv2.INTER_AREA)
    return small
