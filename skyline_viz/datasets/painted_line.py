"""The line that is painted on a photograph, in pure red or pure blue.

A river in a map of classes may have the same colour. What decides is what lies beneath: a
photograph has many colours. On a picture of few a strip is a line only if it is the border between
one colour above it and others below, or a drawing on a single colour.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import (
    F32,
    U8,
    Bool,
    Int,
    column_counts,
    column_ends,
    in_colours,
    in_numbers,
)
from skyline_viz.datasets.label_picture import LabelPicture
from skyline_viz.datasets.sky_region import Line, spans_of
from skyline_viz.skyline import PAINTS, Paint, Skyline, SkylineError

_FEW = 64
"""So many colours are those of a map, not of a photo, if they make up nearly all of a picture."""

_BARE = 0.9
"""That share is nearly all."""

_MIX = np.uint32(2654435769)
"""An odd number that spreads colours over 32 bits, the more evenly the higher the bit."""

_APART = 0.1
"""Paint so far from the rest of the line, as a share of the height, is odd."""

_AGREE = 2
"""Rows between two lines that mean the same."""


def painted_line(picture: LabelPicture) -> Line | None:
    """The line that is painted on a picture; None where there is none, or a region.

    The topmost paint of a column counts. Of a stray pixel in the paint's colour, or a red coat,
    no line is made.

    Raises:
        SkylineError: There are two lines, one in each colour.
    """
    if picture.values.ndim == 2 and picture.palette is None:
        return None
    colours = picture.colours
    lines: dict[Paint, tuple[Skyline, Bool]] = {}
    keys: npt.NDArray[np.int32] | None = None
    for paint, found in zip(PAINTS, in_colours(colours, PAINTS.values()), strict=True):
        hits = found if picture.opaque is None else found & picture.opaque
        if not _is_line(hits):
            continue
        if _may_be_bare(colours, hits):
            keys = _keys(colours) if keys is None else keys
            if _is_bare(keys, hits) and not _is_border(keys, hits):
                continue
        lines[paint] = Skyline.along_top(hits), hits
    if not lines:
        return None
    if len(lines) == 2 and not _agree(lines["red"][0], lines["blue"][0]):
        columns = {paint: int(line.visible.sum()) for paint, (line, _) in lines.items()}
        raise SkylineError(
            f"a line is painted in red, in {columns['red']} columns, and another in blue, in "
            f"{columns['blue']}, and which is the skyline is not said; leave one of them"
        )
    skyline, hits = max(lines.values(), key=lambda one: int(one[0].visible.sum()))
    return Line(skyline, _notes(skyline, hits))


def _is_line(hits: Bool) -> bool:
    """Whether paint is about a pixel a column, and in enough of them."""
    counts = column_counts(hits)
    thick = counts[counts > 0]
    if not len(thick):
        return False
    share = len(thick) / len(counts)
    line = np.median(thick) <= 4 and thick.mean() <= max(8, 0.03 * len(hits))
    return bool(line and share >= 0.02 and (share >= 0.25 or thick.max() == 1))


def _keys(colours: U8) -> npt.NDArray[np.int32]:
    """One number for each pixel's colour."""
    high = colours.astype(np.int32)
    return (high[:, :, 0] << 16) | (high[:, :, 1] << 8) | high[:, :, 2]


def _may_be_bare(colours: U8, hits: Bool) -> bool:
    """Whether `_is_bare` has to count; it takes long, and of a photo this tells that it is none.

    A quarter of the rows is looked at. Colours are put into 4,096 cells, so that few colours have
    at most the pixels of as many cells; and those that are not looked at may be of these colours.
    """
    cells = (in_numbers(colours[::4]) * _MIX) >> 20
    sums = np.bincount(cells.ravel(), minlength=4096)
    beneath = hits.size - np.count_nonzero(hits)
    most = np.sort(sums)[-_FEW:].sum() + hits.size - cells.size
    return bool(most >= _BARE * beneath)


def _is_bare(keys: npt.NDArray[np.int32], hits: Bool) -> bool:
    """Whether there is hardly a photo beneath the paint."""
    sums = np.sort(np.unique(keys[~hits], return_counts=True)[1])
    return bool(sums[-_FEW:].sum() >= _BARE * sums.sum())


def _is_border(keys: npt.NDArray[np.int32], hits: Bool) -> bool:
    """Whether paint in nearly all columns is the border below one colour, or all that is drawn."""
    height = len(hits)
    visible = np.flatnonzero(hits.any(axis=0))
    if len(visible) < 0.75 * hits.shape[1]:
        return False
    first, last = column_ends(hits)
    top, end = first[visible], last[visible] + 1
    if (top == 0).mean() > 0.5:  # sky at the top, however thin
        return False
    if len(np.unique(keys[~hits])) == 1:
        return bool((end - top == 1).all())
    rows = np.arange(height)[:, None]
    above, below = keys[:, visible][rows < top], keys[:, visible][rows >= end]
    found, sums = np.unique(above, return_counts=True)
    sky = found[sums.argmax()]
    inside = (top > 0) & (end < height)
    over, under = keys[top[inside] - 1, visible[inside]], keys[end[inside], visible[inside]]
    return bool(
        inside.any()
        and (above == sky).mean() >= 0.98
        and (below == sky).mean() <= 0.02
        and (over == sky).mean() >= 0.95
        and (under != sky).mean() >= 0.95
    )


def _agree(one: Skyline, other: Skyline) -> bool:
    both = one.visible & other.visible
    return bool(both.any() and np.abs(one.rows - other.rows)[both].max() <= _AGREE)


def _notes(skyline: Skyline, hits: Bool) -> tuple[str, ...]:
    """What is odd about the paint: some of it lies far from the rest of the line."""
    height, width = hits.shape
    loose = column_ends(hits)[1] - skyline.rows + 1 - column_counts(hits)
    odd = skyline.visible & (loose > max(8, _APART * height))
    shown = np.flatnonzero(skyline.visible)
    odd[shown[_far(skyline.rows[shown], max(2, width // 20), max(8, _APART * height))]] = True
    if not odd.any():
        return ()
    where = spans_of(np.flatnonzero(odd))
    return (f"paint far from the rest of the line, in {where}, counts as skyline",)


def _far(rows: F32, reach: int, limit: float) -> Int:
    """Columns in which a line is farther from its median around than so many rows."""
    if len(rows) <= 4 * reach:
        return np.zeros(0, np.int32)
    import cv2  # noqa: PLC0415  # not needed for help

    window = 2 * reach + 1
    line, wide = rows[None], np.ones((1, window), np.uint8)
    edge = {"borderType": cv2.BORDER_REPLICATE}
    span = np.maximum(cv2.dilate(line, wide, **edge) - line, line - cv2.erode(line, wide, **edge))
    some = np.flatnonzero(span[0] > limit).astype(np.int32)  # the others are far from no neighbour
    around = np.lib.stride_tricks.sliding_window_view(np.pad(rows, reach, mode="edge"), window)
    # far from the median is what half of the window lies far from, on one side
    apart = around[some] - rows[some, None]
    most = np.maximum((apart > limit).sum(axis=1), (apart < -limit).sum(axis=1))
    return np.asarray(some[most > reach])
