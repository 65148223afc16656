"""Where a path leaves the truth: what the photo shows along both lines, measured.

================  ================================================================================
place             what is measured
================  ================================================================================
haze              next to no contrast across the truth, or one that is soft
frame             the path is level, near the rim, and beyond it the photo has one colour that is
                  not the sky's
wire              above the truth, the photo is alike on both sides of the path, which is thin
cloud above       above the truth, anything else
snow              below the truth, at which something white begins that is lighter than the sky
foreground ridge  below the truth, anything else
================  ================================================================================

Each column says what it shows. The columns in which the truth is the dearer line count, by how much
dearer it is there.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, U8, Bool, Int
from skyline_viz.diagnosis.causes import PLACES, Place
from skyline_viz.diagnosis.counterfactual import Case
from skyline_viz.evaluation.metrics import scaled

FAR = 10.0
"""Distance from which on a path is at another place than the truth, in pixels at 519 rows; nearer
there are trees and rocks."""

HAZY = 12.0
"""Contrast across the truth up to which it is in haze, in grey levels of the channel that has most:
between rows 2 px apart at 519 rows, where it is steepest."""

ALIKE = 0.4
"""Contrast across a wire, as a share of that of the wire itself, at the most."""

SIDES = ((3, 5), (6, 10))
"""How far from the path its two sides are compared, in pixels at 519 rows: of thin wires, and of
wide ones."""

WHITE, COLOURLESS = 140.0, 40.0
"""Grey level of snow in its darkest channel, at least, and by how much its channels differ."""

RIM = 0.2
"""Share of the height within which the line of a frame is from the rim."""

ONE_COLOUR = 10.0
"""Deviation of the colour of a bar, in grey levels."""

_LEVEL = 1  # rows by which a level line changes within
_ALONG = 15  # so many columns on either side
_SMOOTH = 9  # columns over which what is measured is averaged


@dataclass(frozen=True)
class Found:
    """Where a path leaves the truth."""

    place: Place
    """What is there."""

    begins: int
    """First column that shows it."""

    evidence: str
    """What was measured, in a sentence."""


def place_of(case: Case, dearer: F64, first: int, last: int) -> Found | None:
    """What the photo shows where the path leaves the truth; None where it stays near.

    Args:
        case: Detection and truth.
        dearer: ``(W,)`` how much more the truth pays than the path in each column.
        first: First column in which it is off.
        last: Last one.
    """
    columns = np.arange(first, last + 1)
    far = np.abs(case.path_rows - case.rows) > scaled(FAR, len(case.detection.photo))
    columns = columns[far[columns] & case.truth.visible[columns]]
    if not len(columns):
        return None
    weights = np.maximum(dearer[columns], 0)
    if not weights.any():
        weights = np.ones(len(columns))
    shown = _Shown(case, columns)
    kinds = shown.kinds()
    place = max(PLACES, key=lambda one: float(weights[kinds[one]].sum()))
    there = kinds[place]
    share = float(weights[there].sum() / weights.sum())
    begins = int(columns[there & (weights > 0)][0])
    return Found(place, begins, shown.said(place, there, begins, share))


class _Shown:
    """What a photo shows along truth and path in some columns."""

    def __init__(self, case: Case, columns: npt.NDArray[np.intp]) -> None:
        self.case, self.columns = case, columns
        self.photo = case.detection.photo
        self.height = len(self.photo)
        self.unit = scaled(1.0, self.height)
        self.truth, self.path = case.drawn_rows[columns], case.path_rows[columns]
        self.over, self.under = self.beside(self.truth, -7, -3), self.beside(self.truth, 2, 6)
        self.contrast = np.max([self.step(self.truth, off) for off in range(-4, 4)], axis=0)

    def kinds(self) -> dict[Place, Bool]:
        """``(k,)`` for each place the columns that show it: each column shows one."""
        above = self.path < self.truth
        frame, hazy = self.framed(), self.contrast <= HAZY
        wire, snow = self.thin(), self.snowy()
        free = ~frame & ~hazy
        return {
            "cloud above": free & above & ~wire,
            "haze": hazy & ~frame,
            "wire": free & above & wire,
            "snow": free & ~above & snow,
            "frame": frame,
            "foreground ridge": free & ~above & ~snow,
        }

    def beside(self, rows: Int, top: int, bottom: int) -> F32:
        """``(k, 3)`` mean colour of the rows from `top` to `bottom` beside a line ``(k,)``."""
        offsets = range(round(top * self.unit), round(bottom * self.unit) + 1)
        colours = [
            self.photo[np.clip(rows + off, 0, self.height - 1), self.columns].astype(np.float32)
            for off in offsets
        ]
        mean = np.mean(colours, axis=0)
        smooth: F32 = cv2.blur(mean[None], (_SMOOTH, 1))[0]
        return smooth

    def step(self, rows: Int, off: int) -> F32:
        """``(k,)`` contrast between two rows beside a line ``(k,)``, 2 px apart."""
        upper, lower = self.beside(rows, off, off), self.beside(rows, off + 2, off + 2)
        contrast: F32 = np.abs(upper - lower).max(axis=1)
        return contrast

    def thin(self) -> Bool:
        """``(k,)`` whether the photo is alike on both sides of the path, which is another.

        Near it or farther off: clouds change within the width of a wide wire.
        """
        thin: Bool = np.zeros(len(self.columns), np.bool_)
        on = [self.beside(self.path, off, off) for off in range(-3, 5)]
        for near, far in SIDES:
            over, under = self.beside(self.path, -far, -near), self.beside(self.path, near, far)
            middle = (over + under) / 2
            wire = np.max([np.abs(one - middle).max(axis=1) for one in on], axis=0)
            thin |= np.abs(over - under).max(axis=1) <= ALIKE * wire
        return thin

    def snowy(self) -> Bool:
        """``(k,)`` whether something white and lighter than the sky begins at the truth."""
        spread = self.under.max(axis=1) - self.under.min(axis=1)
        lighter = self.under[:, 0] >= self.over[:, 0]  # a pale sky is white, too, but for its red
        snowy: Bool = lighter & (self.under.min(axis=1) >= WHITE) & (spread <= COLOURLESS)
        return snowy

    def framed(self) -> Bool:
        """``(k,)`` whether the path is level, with a bar from there to a rim that is near."""
        level = self.case.path_rows.astype(np.float32)[None]
        kernel = np.ones((1, 2 * _ALONG + 1), np.uint8)
        change = (cv2.dilate(level, kernel) - cv2.erode(level, kernel))[0]
        contrast = np.abs(self.beside(self.path, -5, -3) - self.beside(self.path, 3, 5)).max(axis=1)
        framed: Bool = (change[self.columns] <= _LEVEL) & (contrast > HAZY)
        rim = RIM * self.height
        for at in np.flatnonzero(framed):
            row = int(self.path[at])
            near = min(row, self.height - 1 - row) <= rim
            beyond = slice(0, row - 2) if row < self.height / 2 else slice(row + 3, None)
            framed[at] = near and self.bar(self.photo[beyond, self.columns[at]], self.over[at])
        return framed

    def bar(self, pixels: U8, sky: F32) -> bool:
        """Whether pixels ``(k, 3)`` are of one colour, and another than that above the truth."""
        if not len(pixels):
            return False
        apart = float(np.abs(pixels.mean(axis=0) - sky).max())
        return float(pixels.std(axis=0).max()) <= ONE_COLOUR and apart > HAZY

    def said(self, place: Place, there: Bool, begins: int, share: float) -> str:
        """What was measured where a place is shown."""
        away = float(np.median(np.abs(self.path - self.truth)[there]))
        side = "above" if np.median((self.path - self.truth)[there]) < 0 else "below"
        contrast = float(np.median(self.contrast[there]))
        return (
            f"It begins at column {begins}, {_AT[place]}: in {share:.0%} of the difference "
            f"{_MEASURED[place]}. The path runs {away:.0f} px {side} the truth, across which the "
            f"contrast is {contrast:.0f} grey levels."
        )


_AT: dict[Place, str] = {
    "cloud above": "at a cloud above",
    "haze": "in haze",
    "wire": "at a wire",
    "snow": "at snow",
    "frame": "at a frame",
    "foreground ridge": "at a foreground ridge",
}

_MEASURED: dict[Place, str] = {
    "cloud above": "the path divides two colours above the truth",
    "haze": f"the contrast across the truth is at most {HAZY:.0f} grey levels",
    "wire": "the photo is alike on both sides of the path",
    "snow": "something white and lighter than the sky begins at the truth",
    "frame": "the path is level and has one colour beyond it",
    "foreground ridge": "the path runs below a truth with contrast",
}
