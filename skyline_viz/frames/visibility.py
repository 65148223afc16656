r"""Where the skyline can be seen, and whether the photo has one.

A path search finds a line in every photo, in one of nothing but rock, too. Whether the line is a
skyline is asked afterwards, of the map of the sky model and of the edges. With $p$ the map, a line
at row $i$ of column $j$ is the border between sky and terrain as far as

$$
e_j = \bar p(0 \dots i) \; (1 - \bar p(i \dots H))
$$

is near 1: all above it is sky, all below it terrain. This is what the model's term of the cost
leaves unsaid. The term is less its minimum in the column, so it tells a better row from a worse
one, and not whether the best one is any good. A model can be wrong about a photo that leaves no
doubt, though: where the line runs on nearly the only edges that there are, these speak for it, too.
The larger of both is the evidence of a column, as far as the edges bear it out: times the share of
columns around in which the line runs on an edge, and less where what should be sky is as full of
edges as what should be terrain.

The thresholds were chosen with whole sources left out, see ``docs/method.md``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numba
import numpy as np

from skyline_viz.arrays import F32, F64, Bool, Int, read_only, runs
from skyline_viz.frames.frame import Frame

NO_FRAME = Frame()
"""That of most photos."""

Case: TypeAlias = Literal["skyline", "does not cross", "no sky", "no terrain"]
"""What a photo shows: a skyline from side to side, one that is not visible everywhere, or none for
want of sky or of terrain."""

PHOTO_THRESHOLD = 0.5
"""A photo of less evidence has no skyline."""

COLUMN_THRESHOLD = 0.3
"""In a column of less evidence the line is not visible."""

AROUND = 1 / 16
"""Columns over which evidence is averaged, as a share of the width."""

FEW_EDGES = 0.1
"""Share of pixels with an edge that says little, above the line or below it: grain and clouds have
as many."""

NEAR = 3
"""Edges within so many rows of the line are its own, and lie neither above nor below it."""

SHORTEST = 1 / 32
"""Gaps of fewer columns, as a share of the width, are a doubt and no absence: the line is visible
there, too."""

RIM = 0.01
"""A line nearer than that to the upper or lower rim, as a share of the height, is on its way out:
what there is of sky or terrain counts in proportion."""

SUREST = 0.25
"""The evidence of a photo is what this share of its columns reaches."""


@dataclass(frozen=True, eq=False)
class Visibility:
    """Where a line can be seen, and whether it is a skyline at all.

    Examples:
        >>> sky = np.repeat([[1.0], [1.0], [0.0], [0.0]], 3, axis=1).astype(np.float32)
        >>> edge_rows, edge_columns = np.divmod(np.arange(600, dtype=np.int32), 6)
        >>> low = edge_rows >= 50  # the lower half is all edges
        >>> edges = edge_rows[low], edge_columns[low]
        >>> rows = np.full(6, 50, np.float32)
        >>> visibility(sky, rows, *edges, height=100).case
        'skyline'
        >>> visibility(0 * sky, rows, *edges, height=100).case
        'no sky'
    """

    evidence: F32
    """``(W,)`` how surely the line is the border between sky and terrain, in [0, 1]."""

    visible: Bool
    """``(W,)`` False where the line cannot be seen."""

    surest: float
    """How surely the photo has a skyline, in [0, 1]: the evidence that the surest quarter of its
    columns reaches."""

    case: Case
    """What the photo shows."""

    share: float
    """Share of the picture's columns in which the line can be seen."""

    def __post_init__(self) -> None:
        """Freeze the arrays."""
        read_only(self.evidence)
        read_only(self.visible)

    @property
    def doubt(self) -> str:
        """What the photo shows, in one sentence; nothing where that is a skyline."""
        return "" if self.case == "skyline" else self.said

    @property
    def said(self) -> str:
        """What the photo shows, in one sentence."""
        sure = f"evidence {self.surest:.2f}"
        if self.case == "skyline":
            return f"The skyline crosses the photo ({sure})."
        if self.case == "does not cross":
            share = f"{np.floor(100 * self.share):.0f} %"
            return f"The skyline does not cross the photo: {share} of its columns show it ({sure})."
        return f"No skyline is visible: there seems to be {self.case} ({sure})."


def visibility(
    sky: F32,
    rows: F32,
    edge_rows: Int,
    edge_columns: Int,
    height: int,
    frame: Frame = NO_FRAME,
) -> Visibility:
    """Ask the map of a sky model where a line is a skyline.

    Only the picture counts: no line is visible in the columns of a frame, and these say nothing of
    the others.

    Args:
        sky: ``(h, w)`` probability of sky of each region, see `sky_model.SkyModel.sky`.
        rows: ``(W,)`` the line: the row of the first terrain pixel of each column.
        edge_rows: ``(n,)`` int32 row of each edge pixel.
        edge_columns: ``(n,)`` int32 column of each edge pixel.
        height: Rows of the photo.
        frame: Its frame, in which there are no edges.
    """
    shown = frame.shows(len(rows))
    on_edge, above, below = _edges_about(rows, edge_rows, edge_columns, NEAR)
    alone = np.count_nonzero(on_edge) / max(len(edge_rows), 1)
    on_edge[~shown] = 2 * on_edge.sum() > shown.sum()  # neither better nor worse than the rest
    over = np.maximum(rows - frame.top, 0) * shown
    under = np.maximum(height - frame.bottom - rows, 0) * shown
    # full of edges here, and as a whole: leaves in a corner are no reason to doubt the sky
    counts = np.array([above, over, below, under], np.float64)
    around = np.empty_like(counts)
    _sum_around(counts, int(len(rows) * AROUND / 2), around)
    clear = np.maximum(_clear(*around), _clear(*counts.sum(axis=1, keepdims=True)))
    evidence = _evidence(sky, rows, on_edge, alone, height, RIM, AROUND)
    evidence *= clear.astype(np.float32)
    picture = evidence[shown]
    place = len(picture) - 1 - int(SUREST * (len(picture) - 1))
    surest = float(np.partition(picture, place)[place])
    if surest < PHOTO_THRESHOLD:
        nowhere = np.zeros(len(evidence), np.bool_)
        return Visibility(evidence, nowhere, surest, _missing(sky), 0.0)
    visible = shown & (evidence >= COLUMN_THRESHOLD)
    for first, last in runs(shown & ~visible):
        if last - first + 1 < SHORTEST * len(picture):
            visible[first : last + 1] = True
    share = float(visible.sum() / shown.sum())
    return Visibility(
        evidence, visible, surest, "skyline" if share == 1 else "does not cross", share
    )


def _missing(sky: F32) -> Case:
    """What a photo without a skyline has least of."""
    return "no terrain" if sky.mean() > 0.5 else "no sky"


def _clear(above: F64, over: F64, below: F64, under: F64) -> F64:
    """How clear the sky is, in [0, 1], from edge pixels and all pixels, above and below a line."""
    above_share, below_share = above / np.maximum(over, 1), below / np.maximum(under, 1)
    return np.asarray(1 - above_share / (above_share + below_share + FEW_EDGES), np.float64)


@numba.njit(cache=True, nogil=True)
def _sum_around(values: F64, half: int, sums: F64) -> None:
    """Fill in the sums of rows of values over so many columns to each side, as far as there are."""
    width = values.shape[1]
    up_to = np.zeros(width + 1)
    for row in range(len(values)):
        for column in range(width):
            up_to[column + 1] = up_to[column] + values[row, column]
        for column in range(width):
            first, end = max(column - half, 0), min(column + half + 1, width)
            sums[row, column] = up_to[end] - up_to[first]


@numba.njit(cache=True, nogil=True)
def _edges_about(rows: F32, edge_rows: Int, edge_columns: Int, near: int) -> tuple[Bool, Int, Int]:
    """Where the line runs on an edge ``(W,)``, and how many edge pixels lie above and below it."""
    on_edge = np.zeros(rows.size, np.bool_)
    above = np.zeros(rows.size, np.int32)
    below = np.zeros(rows.size, np.int32)
    for edge in range(edge_rows.size):
        column = edge_columns[edge]
        lower = edge_rows[edge] - rows[column]
        if lower == 0:
            on_edge[column] = True
        above[column] += lower < -near
        below[column] += lower > near
    return on_edge, above, below


@numba.njit(cache=True, nogil=True)
def _evidence(
    sky: F32, rows: F32, on_edge: Bool, alone: float, height: int, rim: float, around: float
) -> F32:
    """See `Visibility.evidence`: exact inside regions, interpolated between their columns."""
    count, regions = sky.shape
    width = rows.size
    above = np.zeros((regions, count + 1), np.float32)  # sky above each border of regions
    for column in range(regions):
        for row in range(count):
            above[column, row + 1] = above[column, row] + sky[row, column]
    border = np.zeros(width + 1)
    edges = np.zeros(width + 1)
    for column in range(width):
        centre = min(max((column + 0.5) * regions / width - 0.5, 0.0), regions - 1.0)
        left = int(centre)
        right = min(left + 1, regions - 1)
        aside = centre - left
        place = min(max(rows[column] * count / height, 0.0), float(count))
        row = min(int(place), count - 1)
        inside = place - row
        here = above[left, row] + inside * sky[row, left]
        there = above[right, row] + inside * sky[row, right]
        over = here + aside * (there - here)
        whole = above[left, count] + aside * (above[right, count] - above[left, count])
        # of a thin strip at a rim there is little, however sure
        up = over / max(place, rim * count)
        down = (count - place - (whole - over)) / max(count - place, rim * count)
        border[column + 1] = border[column] + min(max(up * down, 0.0), 1.0)
        edges[column + 1] = edges[column] + on_edge[column]
    evidence = np.empty(width, np.float32)
    half = int(width * around / 2)
    for column in range(width):
        first = max(column - half, 0)
        end = min(column + half + 1, width)
        share = 1.0 / (end - first)
        mean = (border[end] - border[first]) * share
        evidence[column] = max(mean, alone) * (edges[end] - edges[first]) * share
    return evidence
