"""The line that is painted on a photograph, in pure red or pure blue.

A river in a map of classes may have the same colour. What decides is what lies beneath: a
photograph has many colours. On a picture of few a strip is a line only if it is the border between
one colour above it and others below, or a drawing on a single colour.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8, Bool, column_counts, in_colours
from skyline_viz.datasets.label_picture import LabelPicture
from skyline_viz.datasets.sky_region import Line, spans_of
from skyline_viz.skyline import PAINTS, Paint, Skyline, SkylineError

_FEW = 64
"""So many colours are those of a map, not of a photo, if they make up nearly all of a picture."""

_BARE = 0.9
"""That share is nearly all."""

_MIX = np.array([40503, 31161, 34283], np.uint16)
"""Odd numbers that spread colours over 16 bits."""

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
    part = colours[::4]
    mixed = [part[:, :, one] * _MIX[one] for one in range(3)]
    cells = (mixed[0] + mixed[1] + mixed[2]) >> 4
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
    top = hits.argmax(axis=0)[visible]
    end = height - hits[::-1].argmax(axis=0)[visible]
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
    last = height - 1 - hits[::-1].argmax(axis=0)
    loose = last - skyline.rows + 1 - column_counts(hits)
    odd = skyline.visible & (loose > max(8, _APART * height))
    shown = np.flatnonzero(skyline.visible)
    reach = max(2, width // 20)
    if len(shown) > 4 * reach:
        windows = np.lib.stride_tricks.sliding_window_view(
            np.pad(skyline.rows[shown], reach, mode="edge"), 2 * reach + 1
        )
        # far from the median is what half of the window lies far from, on one side
        apart = windows - skyline.rows[shown][:, None]
        limit = max(8, _APART * height)
        far = [beyond.sum(axis=1) > reach for beyond in (apart > limit, apart < -limit)]
        odd[shown[far[0] | far[1]]] = True
    if not odd.any():
        return ()
    where = spans_of(np.flatnonzero(odd))
    return (f"paint far from the rest of the line, in {where}, counts as skyline",)
