"""The frame around a picture: how wide it is, and the photo without it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import cv2
import numpy as np

from skyline_viz.arrays import U8, Bool

Side: TypeAlias = Literal["left", "right", "top", "bottom"]
"""A rim of a picture."""

SIDES: tuple[Side, ...] = ("left", "right", "top", "bottom")
"""All of them."""

ACROSS: dict[Side, Side] = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}
"""The rim across."""


@dataclass(frozen=True)
class Frame:
    """How wide the frame of a photo is at each side, in pixels."""

    left: int = 0
    right: int = 0
    top: int = 0
    bottom: int = 0

    def inside(self, photo: U8) -> tuple[slice, slice]:
        """Rows and columns of the picture in its photo ``(H, W, ...)``.

        >>> photo = np.zeros((40, 60, 3), np.uint8)
        >>> photo[Frame(left=9, top=2).inside(photo)].shape
        (38, 51, 3)
        """
        height, width = photo.shape[:2]
        return slice(self.top, height - self.bottom), slice(self.left, width - self.right)

    def shows(self, width: int) -> Bool:
        """Columns of a photo in which there is picture, ``(W,)``: no line is visible in others.

        >>> Frame(left=2, right=1).shows(5).astype(int)
        array([0, 0, 1, 1, 0])
        """
        shows = np.zeros(width, np.bool_)
        shows[self.left : width - self.right] = True
        return shows

    def widened(self, side: Side, pixels: int) -> Frame:
        """The frame, so many pixels wider at one side."""
        return replace(self, **{side: getattr(self, side) + pixels})


def without_frame(photo: U8, frame: Frame) -> U8:
    """A photo whose frame is painted over with the rim of the picture; itself without a frame.

    >>> photo = np.uint8([[[0]], [[7]], [[9]]]).repeat(3, axis=2)
    >>> without_frame(photo, Frame(top=1))[:, 0, 0]
    array([7, 7, 9], dtype=uint8)
    """
    if frame == Frame():
        return photo
    inside = photo[frame.inside(photo)]
    painted = cv2.copyMakeBorder(
        inside, frame.top, frame.bottom, frame.left, frame.right, cv2.BORDER_REPLICATE
    )
    return np.asarray(painted, np.uint8)
