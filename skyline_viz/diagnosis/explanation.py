"""One pixel, all the way down: why it is an edge or none, its filter, and what it pays.

    explain_pixel(detection, row=210, column=640)

Whoever is asked about a pixel shows this: the viewer, the notebook, and the labelling server.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, U8, Int, read_only
from skyline_viz.detecting.filter_detection import FilterDetection
from skyline_viz.detection import Detection
from skyline_viz.edges import gradient_norms, to_grey
from skyline_viz.score import score_at
from skyline_viz.tensor import tensor_at

Places: TypeAlias = Sequence[int] | npt.NDArray[np.integer[Any]]
"""Rows or columns of pixels ``(k,)``."""

SIDE = 7
"""Pixels a side of what is shown around a pixel by methods that have no filters."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Filtered:
    """How our detector comes to the score of a pixel.

    Pixels that are no edge have one, too: that which they would have if they were.
    """

    strength: float
    """Gradient strength, in grey levels a pixel."""

    coherence: float
    """Coherence, in [0, 1]."""

    orientation: float
    """Orientation of the gradient, in degrees, in [0, 180)."""

    bin: int
    """The bin, which is the index of the filter."""

    why: tuple[str, str, str]
    """Why it is this bin: in which ranges coherence, strength and orientation lie."""

    samples: int
    """Training samples of the bin."""

    starved: bool
    """Whether these are too few."""

    patch: U8
    """``(n, n)`` grey levels around the pixel, the border repeated."""

    taps: F32
    """``(n, n)`` the filter of the bin."""

    product: F32
    """``(n, n)`` patch times filter, over 255. Its sum, clipped to [0, 1], is the score."""

    score: float
    """Score, in [0, 1]."""

    @property
    def axes(self) -> tuple[float, float]:
        r"""The half axes of the structure tensor as an ellipse, along and across the gradient.

        They are $\sqrt{\lambda_1}$ and $\sqrt{\lambda_2}$, in grey levels a pixel: a line where the
        coherence is 1, and a circle where it is 0.
        """
        return self.strength, self.strength * (1 - self.coherence) / (1 + self.coherence)


@dataclass(frozen=True, eq=False, kw_only=True)
class Explanation:
    """All that a detection knows of one pixel."""

    row: int
    """Its row."""

    column: int
    """Its column."""

    colours: U8
    """``(n, n, 3)`` uint8 RGB around the pixel, the border repeated."""

    edge: bool
    """Whether it is an edge pixel: one of the candidates of the path."""

    why_edge: str
    """Why it is one or not, in words, with the gradient that Canny saw and its thresholds; nothing
    of methods that look for no edges in this way."""

    gradient: float | None
    """The gradient that Canny saw: Sobel, L1 norm; None where there was none to see."""

    score: float | None
    """Score as a candidate, in [0, 1]; None of a pixel that is none."""

    filtered: Filtered | None
    """How its score comes about; None of methods without a filter bank."""

    terms: Mapping[str, float]
    """What it pays for each term of the nodal cost, by name."""

    cost: float
    """Its nodal cost: the sum of the terms."""


def explain_pixel(detection: Detection, row: int, column: int) -> Explanation:
    """Explain one pixel of a detection.

    Args:
        detection: The detection, by any method.
        row: Row of the pixel.
        column: Its column.

    Raises:
        ValueError: The photo has no such pixel.

    Examples:
        >>> from skyline_viz.detector import Detector
        >>> photo = np.full((40, 60, 3), 200, np.uint8)
        >>> photo[25:] = 60
        >>> found = explain_pixel(Detector().detect(photo), row=20, column=30)
        >>> found.edge, found.why_edge
        (False, 'no edge: its gradient of 0 is under 15')
    """
    return explain_pixels(detection, [row], [column])[0]


def explain_pixels(detection: Detection, rows: Places, columns: Places) -> list[Explanation]:
    """Explain several pixels at once, which takes hardly longer than one.

    Args:
        detection: The detection, by any method.
        rows: ``(k,)`` rows of the pixels.
        columns: ``(k,)`` their columns.

    Raises:
        ValueError: The photo has no such pixel.
    """
    rows, columns = (np.asarray(one, np.int32) for one in (rows, columns))
    height, width = detection.edges.shape
    for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
        if not (0 <= row < height and 0 <= column < width):
            raise ValueError(
                f"there is no pixel in row {row} and column {column}: "
                f"the photo has {height} rows and {width} columns."
            )
    if not len(rows):
        return []
    ours = detection if isinstance(detection, FilterDetection) else None
    size = ours.bank.size if ours else SIDE
    colours = _patches(detection.photo, rows, columns, size)
    model = detection.cost_model
    terms = {term.name: term.at(rows, columns).tolist() for term in model.nodal}
    costs = detection.cost[rows, columns].tolist()
    edges = detection.edges[rows, columns].tolist()
    scores = _scores(detection, rows, columns)
    filtered = _filtered(ours, rows, columns) if ours else [None] * len(rows)
    gradients = _gradients(ours, rows, columns) if ours else np.full(len(rows), np.nan)
    return [
        Explanation(
            row=row,
            column=column,
            colours=colours[at],
            edge=edges[at],
            why_edge=_why_edge(ours, edges[at], gradients[at]) if ours else "",
            gradient=None if np.isnan(gradients[at]) else float(gradients[at]),
            score=None if np.isnan(scores[at]) else float(scores[at]),
            filtered=filtered[at],
            terms=MappingProxyType({name: paid[at] for name, paid in terms.items()}),
            cost=costs[at],
        )
        for at, (row, column) in enumerate(zip(rows.tolist(), columns.tolist(), strict=True))
    ]


def _filtered(found: FilterDetection, rows: Int, columns: Int) -> list[Filtered]:
    """What the filters do at each pixel, by the very stages of the detector."""
    bank, grey = found.bank, to_grey(found.photo)
    tensor = tensor_at(found.photo, rows, columns)
    bins = bank.bins.of(tensor)
    scores = score_at(grey, rows, columns, bins, bank.filters)
    patches = _patches(grey, rows, columns, bank.size)
    products = patches * bank.filters[bins] * np.float32(1 / 255)
    read_only(products)
    features = zip(
        tensor.strength.tolist(),
        tensor.coherence.tolist(),
        tensor.orientation.tolist(),
        strict=True,
    )
    return [
        Filtered(
            strength=strength,
            coherence=coherence,
            orientation=orientation,
            bin=index,
            why=bank.bins.why(index, coherence, strength, orientation),
            samples=int(bank.samples[index]),
            starved=bool(bank.starved[index]),
            patch=patches[at],
            taps=bank.filters[index],
            product=products[at],
            score=float(scores[at]),
        )
        for at, (index, (strength, coherence, orientation)) in enumerate(
            zip(bins.tolist(), features, strict=True)
        )
    ]


def _patches(picture: U8, rows: Int, columns: Int, size: int) -> U8:
    """``(k, size, size, ...)`` what lies around each pixel, the border repeated."""
    reach = size // 2
    around = np.arange(-reach, reach + 1)
    height, width = picture.shape[:2]
    down = (rows[:, None] + around).clip(0, height - 1)
    across = (columns[:, None] + around).clip(0, width - 1)
    patches: U8 = picture[down[:, :, None], across[:, None, :]]
    read_only(patches)
    return patches


def _scores(detection: Detection, rows: Int, columns: Int) -> F64:
    """Scores of pixels as candidates; NaN of those that are none."""
    scores = np.full(len(rows), np.nan)
    on_edge = detection.edges[rows, columns]
    width = detection.edges.shape[1]
    every = detection.edge_rows.astype(np.int64) * width + detection.edge_columns  # ascending
    wanted = rows.astype(np.int64) * width + columns
    scores[on_edge] = detection.scores[np.searchsorted(every, wanted[on_edge])]
    return scores


def _gradients(found: FilterDetection, rows: Int, columns: Int) -> F64:
    """The gradients that Canny saw; NaN inside the frame, where it does not look."""
    down, across = found.frame.inside(found.photo)
    inside = ((rows >= down.start) & (rows < down.stop) & (columns >= across.start)) & (
        columns < across.stop
    )
    gradients = np.full(len(rows), np.nan)
    if not inside.any():
        return gradients
    rows, columns = rows[inside], columns[inside]
    top, left = max(rows.min() - 1, down.start), max(columns.min() - 1, across.start)
    end, right = min(rows.max() + 2, down.stop), min(columns.max() + 2, across.stop)
    norms = gradient_norms(found.photo[top:end, left:right], found.config.edge_source)
    gradients[inside] = norms[rows - top, columns - left]
    return gradients


def _why_edge(found: FilterDetection, edge: bool, gradient: float) -> str:
    """Why a pixel is an edge, or is none."""
    low, high = found.thresholds
    if np.isnan(gradient):
        return "no edge: it lies in the frame of the picture"
    if edge:
        reasons = (
            f"under {low:.0f}, but the sky model has its boundary here",
            f"over {low:.0f}, and leads to one over {high:.0f}",
            f"over {high:.0f}",
        )
    else:
        reasons = (
            f"under {low:.0f}",
            f"over {low:.0f}, but a neighbour's is larger, or it leads to none over {high:.0f}",
            f"over {high:.0f}, but a neighbour's is larger",
        )
    over = int(gradient >= low) + int(gradient >= high)
    return f"{'an' if edge else 'no'} edge: its gradient of {gradient:.0f} is {reasons[over]}"
