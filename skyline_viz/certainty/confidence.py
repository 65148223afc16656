r"""How surely a line is the skyline, as a whole: two measurements that tell a wrong ridge.

A path that follows a wrong ridge from side to side is sure of every column of it: the margins tell
nothing. Two other things do:

- $w$, the share of the photo on the **wrong side** of the line: sky that the sky model takes for
  terrain, and terrain that it takes for sky. The photo is asked, whatever found the line.
- $e$, how far **elsewhere** lie the other ridges that are nearly as cheap. With $d_k$ the mean
  distance of the other line $k$ as a share of the height, and $c_k$ how much dearer it is a column,

$$
e = \sum_k d_k \exp(-c_k / \tau), \quad
\text{confidence} = \frac{1}{1 + \exp(a + b \log(w + \epsilon) + c \log(e + \epsilon))}
$$

A photo of any size is as quick: ridges are far apart, and other lines are searched among costs that
have been reduced to `ROWS` rows. The coefficients are those of a logistic regression on photographs
of several cameras, by detectors that had not seen them: ``python -m benchmarks`` makes them anew,
and measures how well they tell gross misses of a camera that was left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import F32, Bool
from skyline_viz.certainty.other_lines import other_lines
from skyline_viz.frames.boundary import improbable
from skyline_viz.path import shortest_path

ROWS = 260
"""Costs are reduced to about so many rows."""

PRICE = 0.05
"""What another line costs more, in nodal costs a column, from which on it hardly counts."""

LEAST = 0.01
"""Shares of less than that tell no more."""

GROSS = 13.09, 1.99, 2.60
"""Log odds of a gross miss: constant, for the wrong side, and for elsewhere."""


@dataclass(frozen=True)
class Confidence:
    """How surely a line is the skyline, and what speaks against it."""

    value: float
    """Probability that the line is no gross miss, in [0, 1]."""

    wrong_side: float
    """Share of the photo on the wrong side of the line, as a sky model sees it."""

    elsewhere: float
    """How far away other ridges are that are nearly as cheap, as a share of the height."""

    @property
    def said(self) -> str:
        """What it rests on, in one sentence."""
        return (
            f"Confidence {self.value:.2f}: {self.wrong_side:.0%} of the photo is on the wrong side "
            f"of the line, and other ridges nearly as cheap are {self.elsewhere:.1%} of the height "
            "away."
        )


def confidence(
    sky: F32,
    rows: npt.NDArray[np.floating],
    shown: Bool,
    cost: npt.NDArray[np.floating],
    delta: int,
    link_weight: float,
) -> Confidence:
    """How surely a line is the skyline.

    Args:
        sky: ``(h, w)`` probability of sky of each region, see `sky_model.SkyModel.sky`.
        rows: ``(W,)`` the line: the row of the first terrain pixel of each column.
        shown: ``(W,)`` columns of the picture, without those of a frame around it.
        cost: ``(H, W)`` nodal costs that the line was found with.
        delta: Largest change of row between neighbouring columns, in pixels.
        link_weight: Cost of one pixel of row change.

    Examples:
        A line where the map has its boundary is surer than one in the sky.

        >>> sky = np.repeat([[1.0], [1.0], [0.0], [0.0]], 3, axis=1).astype(np.float32)
        >>> cost = np.full((40, 30), 2.0, np.float32)
        >>> cost[10] = cost[20] = 1.0
        >>> shown = np.ones(30, np.bool_)
        >>> right, wrong = (
        ...     confidence(sky, np.full(30, row), shown, cost, 2, 0.1) for row in (20, 10)
        ... )
        >>> right.value > wrong.value
        True
        >>> round(right.wrong_side, 2), round(wrong.wrong_side, 2)
        (0.0, 0.25)
    """
    wrong = wrong_side(sky, rows, shown, len(cost))
    away = elsewhere(cost, delta, link_weight)
    constant, of_wrong, of_away = GROSS
    odds = constant + of_wrong * np.log(wrong + LEAST) + of_away * np.log(away + LEAST)
    return Confidence(float(1 / (1 + np.exp(odds))), wrong, away)


def wrong_side(sky: F32, rows: npt.NDArray[np.floating], shown: Bool, height: int) -> float:
    """Share of a picture on the wrong side of a line, as a sky model sees it.

    Args:
        sky: ``(h, w)`` probability of sky of each region.
        rows: ``(W,)`` the line.
        shown: ``(W,)`` columns of the picture.
        height: Rows of the photo.
    """
    borders = improbable(sky)
    regions, count = len(borders), borders.shape[1] - 1
    columns = np.flatnonzero(shown)
    region = columns * regions // len(rows)
    place = np.clip(np.asarray(rows, np.float64)[columns] * count / height, 0, count)
    upper = np.minimum(place.astype(np.intp), count - 1)
    below = place - upper
    share = borders[region, upper] * (1 - below) + borders[region, upper + 1] * below
    return float(share.mean())


def elsewhere(cost: npt.NDArray[np.floating], delta: int, link_weight: float) -> float:
    """How far away other ridges are that are nearly as cheap, as a share of the height.

    Args:
        cost: ``(H, W)`` nodal costs; ``inf`` forbids a pixel.
        delta: Largest change of row between neighbouring columns, in pixels.
        link_weight: Cost of one pixel of row change.
    """
    small = reduced(cost)
    height, width = small.shape
    rows = shortest_path(small, delta, link_weight).rows
    total = 0.0
    for other in other_lines(small, delta, link_weight, rows):
        away = float(np.abs(other.rows - rows).mean()) / height
        total += away * float(np.exp(-other.detour / width / PRICE))
    return total


def reduced(cost: npt.NDArray[np.floating]) -> F32:
    """Costs of squares of pixels: in each of their columns the least counts, of these the mean.

    A line through the squares costs a column what it costs through the pixels, links included.

    Args:
        cost: ``(H, W)`` nodal costs.

    Examples:
        >>> reduced(np.ones((4 * ROWS, 82), np.float32)).shape
        (260, 20)
    """
    height, width = cost.shape
    by = max(round(height / ROWS), 1)
    across = max(width // by, 1)
    by_columns = min(by, width)
    used = cost[:, : across * by_columns]
    parts = np.array(used[::by], np.float32)
    for below in range(1, by):  # whole rows at a time: a tenth of the time of `reduceat`
        row = used[below::by]
        np.minimum(parts[: len(row)], row, out=parts[: len(row)])
    mean = parts.reshape(len(parts), across, by_columns).mean(axis=2, dtype=np.float32)
    return np.asarray(mean, np.float32)
