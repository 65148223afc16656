"""The line of a neighbouring photo, carried over to a photo that shows the same place.

Points of the ground near the line are found again in the other photo (SIFT: Lowe, *Distinctive
image features from scale-invariant keypoints*, 2004). A camera that turns, or is far away, moves
all of them by one homography. So many that agree on one are no accident: the photos overlap, and
the line is moved in the same way. Clouds move on their own, so nothing is looked for high above the
line.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from annotate.engine.guide import thinned
from skyline_viz.arrays import F32, F64, U8, Bool, Int, runs
from skyline_viz.skyline import Skyline

SIDE = 480
"""Longest side of a photo as it is compared, in pixels."""

AGREEING = 16
"""Points that have to agree before photos are said to overlap."""

RADIUS = 0.0125
"""Part of the height by which the line may lie beside where it is carried to."""

_MOST = 2000  # points of a photo
_CONTRAST = 0.02  # least contrast of a point: hazy ridges have little
_ABOVE, _BELOW = 0.08, 0.3  # part of the height above and below the line in which points count
_BETTER = 0.8  # how much nearer the best match has to be than the next one
_BESIDE = 3.0  # pixels of the reduced photo by which a point may miss its place
_BACK = 0.02  # part of the width by which a turned line may run back over itself, as at a tower
_LEAST = 0.1  # part of the width below which a piece of a line says nothing
_WITHIN = 2.0  # pixels that the points of the stroke lie beside the line at the most


@dataclass(frozen=True)
class Stroke:
    """A stroke along the line as it was carried over, to be given to `LiveWire.guide`."""

    points: tuple[tuple[int, int], ...]
    """Column and row of each point."""

    radius: int
    """What its place is uncertain by, in pixels."""


def carried_over(before: U8, line: Skyline, photo: U8) -> Stroke | None:
    """Where the line of a photo lies in its neighbour; None where the two do not overlap.

    Args:
        before: ``(H, W, 3)`` uint8 RGB, the photo whose line is known.
        line: Its line; the longest run of columns in which it is visible is carried over.
        photo: ``(H, W, 3)`` uint8 RGB, the neighbour.
    """
    if before.shape != photo.shape or not line.visible.any():
        return None
    motion, agreeing = motion_between(before, line, photo)
    if motion is None or agreeing < AGREEING:
        return None
    moved = moved_line(line, motion, len(photo))
    return None if moved is None else stroke_along(*moved, len(photo))


def stroke_along(first: int, rows: Int, height: int) -> Stroke:
    """The stroke along a line that was carried over.

    Args:
        first: Its first column.
        rows: Row in each of its columns.
        height: Rows of the photo.
    """
    return Stroke(thinned(first, rows, _WITHIN), max(round(RADIUS * height), 2))


def motion_between(before: U8, line: Skyline, photo: U8) -> tuple[F64 | None, int]:
    """How the scene around a line has moved, and how many points agree on it.

    Args:
        before: ``(H, W, 3)`` uint8 RGB.
        line: Its line.
        photo: ``(H, W, 3)`` uint8 RGB.

    Returns:
        The homography ``(3, 3)`` from (column, row, 1) of the one to that of the other, and the
        number of points; None and 0 where there is none.
    """
    theirs, known = _points(before)
    ours, found = _points(photo)
    near = _near(theirs, line, len(before))
    theirs, known = theirs[near], known[near]
    if len(theirs) < AGREEING or len(ours) < AGREEING:
        return None, 0
    pairs = cv2.BFMatcher(cv2.NORM_L2).knnMatch(known, found, k=2)
    sure = [one for one, other in pairs if one.distance < _BETTER * other.distance]
    if len(sure) < AGREEING:
        return None, 0
    motion, agree = cv2.findHomography(
        theirs[[one.queryIdx for one in sure]],
        ours[[one.trainIdx for one in sure]],
        cv2.USAC_MAGSAC,
        _BESIDE / _scale(photo),
    )
    return (None, 0) if motion is None else (motion, int(np.count_nonzero(agree)))


def _scale(photo: U8) -> float:
    return float(min(SIDE / max(photo.shape[:2]), 1.0))


def _points(photo: U8) -> tuple[F32, F32]:
    """Column and row ``(n, 2)`` of points that can be found again, and what they are known by."""
    scale = _scale(photo)
    size = [max(round(side * scale), 1) for side in photo.shape[1::-1]]
    grey = cv2.resize(cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY), size, interpolation=cv2.INTER_AREA)
    finder = cv2.SIFT.create(nfeatures=_MOST, contrastThreshold=_CONTRAST)
    found, known = finder.detectAndCompute(grey, None)
    if not found:
        return np.zeros((0, 2), np.float32), np.zeros((0, 128), np.float32)
    return np.array([one.pt for one in found], np.float32) / np.float32(scale), known


def _near(points: F32, line: Skyline, height: int) -> Bool:
    """``(n,)`` which points lie near a line where it is visible, and more below it than above."""
    columns = np.clip(np.rint(points[:, 0]).astype(np.intp), 0, line.width - 1)
    below = (points[:, 1] - line.rows[columns]) / height
    near: Bool = (below > -_ABOVE) & (below < _BELOW) & line.visible[columns]
    return near


def moved_line(line: Skyline, motion: F64, height: int) -> tuple[int, Int] | None:
    """The longest piece of a line that lies in the other photo, as it has moved.

    Args:
        line: The line, ``(W,)``; visible in some column.
        motion: Homography ``(3, 3)`` from (column, row, 1) to those of the other photo.
        height: Rows of each of the two photos, which are as wide.

    Returns:
        Its first column, and the row in each. None where too little is left of it, or the photo is
        so turned that the line runs back over itself.
    """
    width = line.width
    seen = max(runs(line.visible), key=lambda run: run[1] - run[0])
    at = np.arange(seen[0], seen[1] + 1)
    points = np.column_stack([at, line.rows[at]]).astype(np.float64)
    depth = points @ motion[2, :2] + motion[2, 2]
    columns, rows = cv2.perspectiveTransform(points[None], motion)[0].T
    onward = np.maximum.accumulate(columns)
    if depth.min() <= 0 or (onward - columns).max() > _BACK * width:
        return None
    first, last = max(int(np.ceil(onward[0])), 0), min(int(onward[-1]), width - 1)
    if last <= first:
        return None
    all_rows = np.interp(np.arange(first, last + 1), onward, rows)
    inside = runs((all_rows >= 0) & (all_rows <= height - 1))
    start, stop = max(inside, key=lambda run: run[1] - run[0], default=(0, -1))
    if stop - start + 1 < _LEAST * width:
        return None
    return first + start, np.rint(all_rows[start : stop + 1]).astype(np.int32)
