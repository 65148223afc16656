"""From a region of sky to its skyline: sky lies above terrain, and that decides much.

A picture of two values says by its shape which of them is sky: the one that is above. What is
left is to see through what people's masks have besides: a frame that a plot or a screen shot
added, birds, specks, lakes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import Bool, column_counts, runs
from skyline_viz.skyline import Skyline, SkylineError, fill

_FRAME = 0.01
"""Frames are at most this share of the height or width, or 2 pixels."""

_SPECK = 0.005
"""A piece of terrain that floats in the sky and has at most this share of all pixels is none."""

_MISFIT = 0.2
"""Share of pixels that may lie on the wrong side of the line, as lakes do."""


@dataclass(frozen=True)
class Line:
    """The skyline of a region, and what was done to get it."""

    skyline: Skyline

    notes: tuple[str, ...] = ()
    """What was left out or is odd, each without a name and without a full stop."""


@dataclass(frozen=True)
class Shape:
    """What the first and last rows of a region of sky say about it."""

    above: int
    """Columns that begin as sky and end as terrain."""

    below: int
    """Columns that begin as terrain and end as sky."""

    thin: bool
    """Whether there is hardly more than a frame of either."""

    @property
    def possible(self) -> bool:
        """Whether it can be sky: it is above in nearly all columns that tell."""
        return self.above > 10 * self.below


def shape_of(sky: Bool) -> Shape:
    """Look at a region ``(H, W)`` that may be sky, a frame left out."""
    inner = sky[_frame(sky)]
    first, last = inner[0], inner[-1]
    telling = first & ~last
    share = column_counts(inner)[telling].mean() / len(inner) if telling.any() else 0.5
    limit = _frame_limit(len(sky)) / len(sky)
    return Shape(int(telling.sum()), int((last & ~first).sum()), not limit < share < 1 - limit)


def line_of(sky: Bool) -> Line:
    """The skyline of a region of sky ``(H, W)``.

    Raises:
        SkylineError: The region is not above the rest.
    """
    frame = _frame(sky)
    inner = sky[frame]
    notes: list[str] = []
    skyline = Skyline.from_mask(inner)
    if (column_counts(inner) != skyline.rows).any():  # there is sky below terrain, too
        cleaned, kept = _without_specks(inner)
        clean = Skyline.from_mask(cleaned)
        changed = np.flatnonzero(clean.rows != skyline.rows)
        if len(changed):
            notes.append(f"specks above the line were left out in {spans_of(changed)}")
        if len(kept):
            notes.append(f"what floats in the sky in {spans_of(kept)} counts as terrain")
        skyline = clean
        if (clean.to_mask(len(inner)) != cleaned).mean() > _MISFIT:
            raise SkylineError("it is neither painted nor a mask with sky above terrain")
    rows, visible = skyline.rows + np.float32(frame.start), skyline.visible
    if thick := max(frame.start, len(sky) - frame.stop):
        visible = visible & ~_sides(inner, _frame_limit(sky.shape[1]))
        pixels = "1 pixel" if thick == 1 else f"{thick} pixels"
        notes.append(f"a frame of {pixels} was left out")
    if not visible.any():
        raise SkylineError("no column holds both sky and terrain")
    return Line(Skyline(fill(rows, visible) if not visible.all() else rows, visible), tuple(notes))


def spans_of(columns: np.typing.NDArray[np.intp], most: int = 4) -> str:
    """Columns in words.

    >>> spans_of(np.array([3, 4, 5, 9]))
    'columns 3 to 5 and 9'
    """
    mask = np.zeros(columns[-1] + 1, np.bool_)
    mask[columns] = True
    spans = [f"{a}" if a == b else f"{a} to {b}" for a, b in runs(mask)]
    if len(spans) > most:
        return f"{len(columns)} columns"
    noun = "column" if len(columns) == 1 else "columns"
    return f"{noun} {', '.join(spans[:-1])}{' and ' if len(spans) > 1 else ''}{spans[-1]}"


def _frame_limit(side: int) -> int:
    return max(2, round(_FRAME * side))


def _frame(sky: Bool) -> slice:
    """The rows of a region between the strips of a frame.

    A strip is of one value, and that value comes again beyond the other one: it lies above the
    sky or below the terrain, where there is nothing.
    """
    limit = _frame_limit(len(sky))
    return slice(_strip(sky, limit), len(sky) - _strip(sky[::-1], limit))


def _strip(region: Bool, limit: int) -> int:
    """Rows of the strip at the first rows of a region; 0 where there is none."""
    value = region[0].mean() > 0.5
    share = (region[: limit + 1] == value).mean(axis=1)
    rows = int(np.argmin(np.append(share >= 0.995, False)))
    if not 0 < rows <= limit or share[rows] > 0.5:
        return 0
    far = region[-1 - limit :] == value  # the other side may have a strip, too
    return rows if far.mean() > 0.5 and (region[rows:] != value).mean() > 0.02 else 0


def _sides(inner: Bool, limit: int) -> Bool:
    """Columns at the left and right that are of one value from top to bottom, as of a frame."""
    full: Bool = np.asarray(inner.all(axis=0) | ~inner.any(axis=0))
    sides = np.zeros(len(full), np.bool_)
    for columns in (slice(None), slice(None, None, -1)):
        width = int(np.argmin(np.append(full[columns], False)))
        if width <= limit:
            sides[columns][:width] = True
    return sides


def _without_specks(sky: Bool) -> tuple[Bool, np.typing.NDArray[np.intp]]:
    """A region of sky without the specks in it, and the columns of larger pieces that float."""
    from skimage.measure import label  # noqa: PLC0415

    ground = np.ones((1, sky.shape[1]), np.bool_)  # all that stands on the last row is one piece
    pieces = label(np.concatenate([~sky, ground]), connectivity=2)
    areas = np.bincount(pieces.ravel())
    areas[[0, pieces[-1, 0]]] = 0
    small = (areas > 0) & (areas <= max(_SPECK * sky.size, 1))
    cleaned = sky | small[pieces[:-1]]
    floating = (areas > 0) & ~small
    return cleaned, np.flatnonzero(floating[pieces[:-1]].any(axis=0))
