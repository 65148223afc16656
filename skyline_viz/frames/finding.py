"""Frames: borders, letterbox and pillarbox bars around a picture, in which no skyline lies.

The border of a frame is a stronger edge than any skyline, and a sky model takes black bars for
terrain. Stage 1 looks for edges inside the frame only.

A frame ends with a straight step along the whole rim. Outside of the step lies a **bar** of one
colour, which may hold text, or a **thin** border of a few pixels, which may hold anything. Sky,
snow and dark ground have one colour, too, and a sea ends them with a straight step. So bars at the
top and at the bottom must be beyond doubt, see `_Picture.is_bar`. At the sides nothing else looks
like a bar.

A picture whose only edge is straight and level could be read in two ways. The edge is its skyline
then: a frame leaves something inside that could be one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from skyline_viz.arrays import I16, U8
from skyline_viz.frames.frame import ACROSS, SIDES, Frame, Side
from skyline_viz.frames.lines import border, constant, end

TOLERANCE = 24
"""Grey levels by which a bar may differ from its colour, as compression leaves it."""

STEP = 12
"""Grey levels by which the picture differs from its frame, at least."""

BLACK = 32
"""Bars with no channel above this grey level are black."""

ALL_ALONG = 0.9
"""Share of a rim along which a step is when a bar is told by its step alone."""

MOST = 0.5
"""Share of a rim along which the step of a border is, and that of a bar at the top or bottom."""

SOME = 0.25
"""Share of a rim along which the step of a bar is that is at a side, or as wide as the one across:
along dark ground no step of a black bar is seen."""

STRAY = 0.02
"""Share of the pixels of a bar, next to the picture and at the rim, that may have other colours."""

TEXT = 0.1
"""Share of the pixels of a whole bar that may: text."""

BLUR = 3
"""Pixels over which the step of a resized bar may extend."""

SMALLEST = 8
"""A picture has at least this many pixels, and a twelfth of the photo, along each axis."""

_SAMPLES = 48  # pixels that are looked at along a rim, to find where a bar ends
_FINE = 384  # and to measure its step
_ROUNDS = 4  # borders within borders


@dataclass(frozen=True)
class _Bar:
    """What looks like a bar at a side."""

    width: int
    """Its width, in pixels."""

    colour: I16
    """``(3,)``: blue, green, red."""

    share: float
    """Share of the rim along which the picture begins with a step."""

    def partner(self, other: _Bar | None) -> bool:
        """Whether another one has its colour, and about its width: both are of one frame."""
        if other is None:
            return False
        alike = np.abs(self.colour - other.colour).max() <= STEP
        return bool(alike) and max(self.width, other.width) <= 4 * min(self.width, other.width)


def find_frame(photo: U8, thin: int = 4) -> Frame:
    """The frame around a picture; nothing at sides that have none.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        thin: Widest border that may hold anything, in pixels; bars of one colour have any width.
    """
    frame = Frame()
    for _ in range(_ROUNDS):
        picture = _Picture(photo, frame)
        wider = picture.behind_bars()
        wider = picture.behind_borders(thin) if wider == frame else wider
        if wider == frame:
            break
        frame = wider
    return frame


@dataclass(frozen=True)
class _Picture:
    """A photo inside a frame."""

    photo: U8
    frame: Frame

    def from_side(self, side: Side) -> U8:
        """The picture turned: from a side inwards, along that side, and colour.

        Colours are blue, green, red: backwards in memory, as a turned picture is, so that loops are
        compiled for one kind of picture.
        """
        inside = self.photo[self.frame.inside(self.photo)][..., ::-1]
        turned = inside.transpose(1, 0, 2) if side in ("left", "right") else inside
        return turned[::-1] if side in ("right", "bottom") else turned

    def room(self, side: Side) -> int:
        """How far a frame may reach into the picture from a side, in pixels."""
        whole = int(self.photo.shape[1 if side in ("left", "right") else 0])
        return len(self.from_side(side)) - max(SMALLEST, whole // 12)

    def behind_bars(self) -> Frame:
        """The frame with the bars inside it."""
        found = {side: self.bar(side) for side in SIDES}
        bars = {side: bar for side, bar in found.items() if bar and self.is_bar(side, found)}
        for side, across in ACROSS.items():
            bar = bars.get(across)
            if bar and side not in bars and self.measured(side, bar.width, bar.colour, SOME):
                bars[side] = bar
        frame = self.frame
        for side, bar in bars.items():
            other = bars.get(ACROSS[side])
            if bar.width + (other.width if other else 0) <= self.room(side):
                frame = frame.widened(side, bar.width)
        if frame == self.frame or self.changes_inside(frame):
            return frame
        return replace(frame, top=self.frame.top, bottom=self.frame.bottom)

    def bar(self, side: Side) -> _Bar | None:
        """What looks like a bar at a side: one colour, and a straight step at its end."""
        turned, room = self.from_side(side), self.room(side)
        if room <= 0:
            return None
        every = max(turned.shape[1] // _SAMPLES, 1)
        needed = SOME if side in ("left", "right") else MOST
        colour, width, stray = constant(turned[: room + 1], every, TOLERANCE, STRAY, needed)
        return self.measured(side, width, colour, needed) if stray <= TEXT else None

    def measured(self, side: Side, width: int, colour: I16, needed: float) -> _Bar | None:
        """A bar that seems to end after so many pixels; None if there is no straight step."""
        turned = self.from_side(side)
        if not 0 < width <= self.room(side):
            return None
        every = max(turned.shape[1] // _FINE, 1)
        last, first = turned[max(width - BLUR, 0)], turned[min(width + BLUR, len(turned)) - 1]
        share, other = end(last, first, every, STEP, colour, TOLERANCE)
        return _Bar(width, colour, share) if other <= STRAY and share > needed else None

    def is_bar(self, side: Side, bars: dict[Side, _Bar | None]) -> bool:
        """Whether what looks like a bar is one.

        At a side it is. At the top or bottom it is where another side has one of the same colour
        and about the same width. Alone it has to be a step all along its rim, and to leave edges
        of which one could be the skyline; and black at the top, where else it could be sky.
        """
        bar = bars[side]
        if bar is None:
            return False
        if side in ("left", "right") or any(
            bar.partner(bars[other]) for other in SIDES if other != side
        ):
            return True
        no_sky = side == "bottom" or int(bar.colour.max()) <= BLACK
        return no_sky and bar.share >= ALL_ALONG and self.crossed_without(side, bar.width)

    def behind_borders(self, thin: int) -> Frame:
        """The frame with the thin borders inside it."""
        frame = self.frame
        for side in SIDES:
            width = self.border(side, thin)
            if width and (side in ("left", "right") or self.crossed_without(side, width)):
                frame = frame.widened(side, width)
        return frame

    def border(self, side: Side, thin: int) -> int:
        """Width of the thin border at a side: where most of a rim gets lighter, or darker."""
        turned = self.from_side(side)
        every = max(turned.shape[1] // _FINE, 1)
        return int(border(turned, min(thin, len(turned) // 4), every, STEP, MOST))

    def changes_inside(self, frame: Frame) -> bool:
        """Whether there is more than one tone in most columns inside a frame."""
        inside = self.photo[frame.inside(self.photo)]
        columns = inside[:, :: max(inside.shape[1] // _SAMPLES, 1)]
        change = np.ptp(columns[BLUR:-BLUR], axis=0).max(axis=1) if len(columns) > 2 * BLUR else 0
        return bool((np.asarray(change) > TOLERANCE).mean() > MOST)

    def crossed_without(self, side: Side, width: int) -> bool:
        """Whether there could be a skyline without a bar.

        Edges are in most columns then, and not on one level: of straight lines each could be it.
        """
        inside = self.photo[self.frame.widened(side, width).inside(self.photo)]
        columns = inside[BLUR:-BLUR, :: max(inside.shape[1] // _SAMPLES, 1)].astype(np.int16)
        every = np.abs(columns[2:] - columns[:-2])
        # numpy takes several times as long for the largest of three neighbours
        change = np.maximum(np.maximum(every[..., 0], every[..., 1]), every[..., 2])
        crossed = change.max(axis=0, initial=0) > TOLERANCE
        if crossed.mean() <= MOST:
            return False
        levels = change.argmax(axis=0)[crossed]
        return bool((np.abs(levels - np.median(levels)) > 1).mean() > 1 - MOST)
