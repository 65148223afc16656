"""The frame around a picture: how wide it is, and the photo without it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8, Bool

Side: TypeAlias = Literal["left", "right", "top", "bottom"]
"""A rim of a picture."""

SIDES: tuple[Side, ...] = ("left", "right", "top", "bottom")
"""All of them."""

ACROSS: dict[Side, Side] = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}
"""The rim across."""

MOST_REGIONS = 4
"""The map of a photo has at most so many times as many regions along an axis as that of the picture
inside its frame."""


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


def around_frame(inside: F32, frame: Frame, height: int, width: int) -> F32:
    """A map of the picture as one of its photo: at the frame it goes on as at its rim.

    Args:
        inside: ``(h, w)`` value of each region of the picture.
        frame: The frame.
        height: Rows of the photo, of which the map has as many more as the photo has more than the
            picture, up to `MOST_REGIONS` times as many.
        width: Its columns, likewise.

    Returns:
        ``(k, l)`` value of each region of the photo.

    >>> around_frame(np.float32([[1], [0]]), Frame(top=4), 8, 3)[:, 0].tolist()
    [1.0, 1.0, 1.0, 0.0]
    """
    if frame == Frame():
        return inside
    places = [
        _places(regions, before, after, length)
        for regions, before, after, length in (
            (inside.shape[0], frame.top, frame.bottom, height),
            (inside.shape[1], frame.left, frame.right, width),
        )
    ]
    across, down = np.meshgrid(places[1], places[0])
    return np.asarray(cv2.remap(inside, across, down, cv2.INTER_LINEAR), np.float32)


def _places(regions: int, before: int, after: int, length: int) -> F32:
    """Where in the map of a picture the middles of the regions of its photo lie, along an axis."""
    scale = regions / (length - before - after)
    count = min(round(length * scale), MOST_REGIONS * regions)
    middles = (np.arange(count) + 0.5) * (length / count)
    places: F32 = np.clip((middles - before) * scale - 0.5, 0, regions - 1).astype(np.float32)
    return places
