"""What dense classification score images (DCSI) have in common: samples, fusions and the path.

A classifier looks at the 16x16 grey pixels around every pixel of a photo and says how much it
looks like skyline: the dense score ``S(i, j)`` in [0, 1], 1 for skyline. The paper's nodal cost
``Psi = S`` (equation 14) takes the lowest score for the best; here it is ``1 - S``.

=============  =========================================================================
ending         nodal cost
=============  =========================================================================
``dcsi``       ``1 - S`` of every pixel
``mdcsi``      ``1 - S`` of the best m pixels of each column; the others are ruled out
``gradient``   ``w2 (1 - S) + (1 - w2) G_r`` of every pixel (equation 13 with the dense score)
``msee``       ``w3 (1 - S) + (1 - w3) (1 - E)``, with ``E`` = 1 on MSEE edges
``canny``      the same with ``E`` = 1 on Canny edges of the grey photo
=============  =========================================================================

The paper says only that edges were combined with the score images. A weighted sum, as it has for
the gradient, crosses gaps between edges along the scores. To rule out what is no edge, as the
earlier methods do, is no better: with Canny edges, a mean error of 0.97 against 0.83 px.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from typing import Literal, TypeAlias

import cv2
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, F64, U8, Bool, Int, check_photo
from skyline_viz.detection import Detection, solve_detection, timed
from skyline_viz.edges import edge_pixels, find_edges
from skyline_viz.method import LearnedMethod, near_truth
from skyline_viz.methods.gradient import gradient_cost
from skyline_viz.methods.stable_edges import stable_edges
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.settings import within

PATCH = 16
"""Pixels a side of a patch."""

BEFORE = PATCH // 2
"""Rows of a patch above its pixel, and columns to the left of it; one fewer are on the far side."""

LEAST_DEVIATION = 4.0
"""Grey levels that are added, in squares, to the deviation of a patch: less is grain, not form."""

CANNY = (50.0, 220.0)
"""The published Canny thresholds, on the grey photo."""

BAND = 10.0
"""Negatives are drawn more than this many rows off the truth."""

Fusion: TypeAlias = Literal["none", "best", "gradient", "msee", "canny"]
"""What the dense score is combined with."""

_ENDINGS: dict[str, Fusion] = {
    "dcsi": "none",
    "mdcsi": "best",
    "dcsi-gradient": "gradient",
    "dcsi-msee": "msee",
    "dcsi-canny": "canny",
}


def fusions(classifier: str) -> dict[str, dict[str, object]]:
    """Names of a classifier's methods, and what each sets: `Configured.PRESETS`."""
    return {f"{classifier}-{ending}": {"fusion": fusion} for ending, fusion in _ENDINGS.items()}


@dataclass(frozen=True)
class DenseScores(LearnedMethod):
    """A method with a dense score.

    The settings were chosen by two-fold cross-validation over the 40 photos of the Web set.
    """

    fusion: Fusion = "none"
    """What the score is combined with."""

    delta: int = 1
    """Largest change of row between neighbouring columns, in pixels."""

    link_weight: float = 0.02
    """Link cost of one pixel of row change."""

    best: int = within(50, 1)
    """``m``: how many pixels of a column ``mdcsi`` keeps."""

    ruled_out: float = 3.0
    """Nodal cost of the others, for which the paper has an infinite one."""

    w2: float = within(0.9, 0, 1)
    """Weight of the score against ``G_r``, in [0, 1]; at 0.8 and below a support vector machine
    misses a whole photo, mean error 4.4 against 0.8 px."""

    w3: float = within(0.3, 0, 1)
    """Weight of the score against edges, in [0, 1]; from 0.3 to 0.9 it makes little difference."""

    def dense_score(self, photo: U8) -> F32:
        """``S``: how much each pixel looks like skyline, ``(H, W)`` in [0, 1].

        Args:
            photo: ``(H, W, 3)`` uint8 RGB.

        Raises:
            MethodError: The method has not been trained.
        """
        raise NotImplementedError

    def detect(self, photo: U8) -> Detection:
        """See `method.Method.detect`."""
        check_photo(photo)
        seconds: dict[str, float] = {}
        with timed(seconds, "scores"):
            dense = self.dense_score(photo)
        with timed(seconds, "cost"):
            edges = self.candidates(photo, dense)
            cost, weight, non_edge_cost = self._cost(photo, dense, edges)
        everywhere = self.fusion in ("none", "gradient")
        return solve_detection(
            self.name,
            photo,
            edges,
            dense[edges],
            cost,
            seconds,
            delta=self.delta,
            link_weight=self.link_weight,
            non_edge_cost=non_edge_cost,
            score_weight=weight,
            maps={} if everywhere else {"dense score": dense},
        )

    def candidates(self, photo: U8, dense: F32) -> Bool:
        """``(H, W)`` pixels that the path should prefer: all, the best ones, or edges."""
        match self.fusion:
            case "best":
                return best_of_columns(dense, self.best)
            case "msee":
                return stable_edges(photo)
            case "canny":
                return find_edges(photo, "grey", *CANNY)
        return np.ones(dense.shape, np.bool_)

    def _cost(self, photo: U8, dense: F32, edges: Bool) -> tuple[F32, float, float]:
        """Nodal cost ``(H, W)``, the weight of the score, and what a pixel pays for no edge."""
        low = 1 - dense
        match self.fusion:
            case "best":
                cost = np.where(edges, low, np.float32(self.ruled_out))
                return cost, 1.0, self.ruled_out
            case "gradient":
                cost = self.w2 * low + (1 - self.w2) * gradient_cost(photo)
                return cost.astype(np.float32), self.w2, 1.0
            case "msee" | "canny":
                cost = self.w3 * low + (1 - self.w3) * ~edges
                return cost.astype(np.float32), self.w3, 1.0
        return low, 1.0, 1.0


def best_of_columns(dense: F32, count: int) -> Bool:
    """Pixels ``(H, W)`` of the `count` best scores of each column, and those that equal the last.

    >>> best_of_columns(np.array([[0.2], [0.9], [0.4]], np.float32), 2).ravel()
    array([False,  True,  True])
    """
    place = max(len(dense) - count, 0)
    best: Bool = dense >= np.partition(dense, place, axis=0)[place]
    return best


def normalised_parts(grey: U8) -> tuple[F64, F64]:
    """Mean and deviation of the patch around each pixel, two arrays ``(H, W)``.

    The deviation is ``sqrt(variance + LEAST_DEVIATION ** 2)``; beyond the border the outermost
    pixels go on.
    """
    mean, mean_square = (
        blur(
            grey,
            cv2.CV_64F,
            (PATCH, PATCH),
            anchor=(BEFORE, BEFORE),
            borderType=cv2.BORDER_REPLICATE,
        )
        for blur in (cv2.boxFilter, cv2.sqrBoxFilter)
    )
    variance = np.maximum(mean_square - mean * mean, 0.0)
    return mean, np.sqrt(variance + LEAST_DEVIATION**2)


def patches(image: npt.NDArray[np.generic], rows: Int, columns: Int) -> F32:
    """Patches of an image ``(H, W)`` around pixels, ``(n, PATCH, PATCH)`` float32."""
    padded = np.pad(image, (BEFORE, PATCH - 1 - BEFORE), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (PATCH, PATCH))
    return windows[rows, columns].astype(np.float32)


def draw_samples(photo: U8, truth: Skyline, seed: int) -> tuple[Int, Int, Bool]:
    """Pixels to learn from: all of the true line, and twice as many off it.

    Half of the negatives are drawn from Canny edges, which are hard to tell from a skyline, and
    half from anywhere; both more than `BAND` rows off. Negatives nearer to the line make the score
    sharper, but the line cheaper to leave: one whole photo in forty is missed for it.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        truth: Its skyline.
        seed: Seed of the draw, which also depends on the photo.

    Returns:
        Rows ``(n,)``, columns ``(n,)``, and which of them are on the line ``(n,)``.

    Raises:
        SkylineError: The photo and the truth differ in width.
    """
    height, width = photo.shape[:2]
    if truth.width != width:
        raise SkylineError(f"the truth has {truth.width} columns, the photo {width}")
    line = truth.pixel_rows(height).astype(np.int32)
    on_line = np.flatnonzero(truth.visible & (line < height)).astype(np.int32)
    rng = np.random.default_rng([seed, zlib.crc32(photo.tobytes())])
    off_line = ~near_truth((height, width), truth, BAND)
    edges = find_edges(photo, "grey", *CANNY)
    rows, columns = [line[on_line]], [on_line]
    for where in (edges & off_line, off_line):
        found = np.flatnonzero(where)
        drawn = np.zeros_like(where)
        drawn.flat[rng.choice(found, min(len(on_line), len(found)), replace=False)] = True
        some_rows, some_columns = edge_pixels(drawn)
        rows.append(some_rows)
        columns.append(some_columns)
    every = np.concatenate(rows)
    return every, np.concatenate(columns), np.arange(len(every)) < len(on_line)


def logistic(values: F32) -> F32:
    """``1 / (1 + exp(-values))``, without overflow."""
    chance: F32 = 0.5 + 0.5 * np.tanh(0.5 * values)
    return chance
