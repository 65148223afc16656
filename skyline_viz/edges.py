r"""Stage 1, edges: the candidate pixels of the skyline (equation 1 of the paper).

$$
E(i, j) = 1 \text{ at edge pixels, } 0 \text{ elsewhere}
$$
"""

import math

import cv2
import numba
import numpy as np

from skyline_viz.arrays import F32, I16, U8, Bool, Int, runs
from skyline_viz.config import DetectorConfig, EdgeSource
from skyline_viz.frames.boundary import boundary
from skyline_viz.frames.finding import find_frame
from skyline_viz.frames.frame import Frame
from skyline_viz.kernels.canny import canny
from skyline_viz.kernels.percentiles import percentiles_of_counts
from skyline_viz.kernels.planes import REACH, padded_planes
from skyline_viz.kernels.sobel import sampled_strengths

STRONG_PERCENTILE = 95
"""Percentile of a photo's gradients that stands for its strong ones."""

STRONG_SHARE = 0.6
"""Upper threshold, as a share of the strong gradients."""

NOISE_PERCENTILE = 20
"""Percentile of a photo's gradients that stands for its noise."""

NOISE_MULTIPLE = 4.0
"""The upper threshold stays above this multiple of the noise."""

LOWEST_FACTOR = 0.3
"""The thresholds are lowered to this share at the most."""

GRADIENT_STEP = 6
"""Gradients are sampled this many pixels apart."""

SURE = 0.05
"""The sky model is sure of its boundary where no more than this share of the column is improbable,
see `boundary.improbable`."""

REGIONS = 100
"""An edge is near the boundary within the height of a region: of one of the map, or of one of so
many if the map has more."""

SHORTEST_GAP = 1 / 64
"""Edges are sought where they are missing in this share of the columns, one after the other."""

EDGE_SETTINGS = ("edge_source", "low_threshold", "high_threshold", "fit_thresholds", "frame")
"""Settings on which edges depend where there is no map of the sky."""


def to_grey(photo: U8) -> U8:
    """Grey photo ``(H, W)`` uint8 of an RGB photo ``(H, W, 3)``, with the weights of ITU-R 601.

    Examples:
        >>> to_grey(np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255]]], np.uint8))
        array([[ 76, 150,  29]], dtype=uint8)
    """
    grey: U8 = cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)
    return grey


def frame_of(photo: U8, config: DetectorConfig) -> Frame:
    """The frame of a photo, inside which edges are looked for; none if it is not asked for."""
    return find_frame(photo, config.frame) if config.frame else Frame()


def candidate_edges(
    photo: U8,
    config: DetectorConfig,
    frame: Frame | None = None,
    sky: F32 | None = None,
    planes: U8 | None = None,
) -> tuple[Bool, tuple[float, float]]:
    """Edge map ``(H, W)`` of a photo without its frame, and the Canny thresholds that made it.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        config: The settings.
        frame: That of `frame_of`, where it is known already.
        sky: ``(h, w)`` the map of a sky model, at whose boundary further edges are sought, see
            `seek`; none without one.
        planes: The photo's own `padded_planes`, where they are there already.
    """
    height, width = photo.shape[:2]
    frame = frame_of(photo, config) if frame is None else frame
    rows, columns = frame.inside(photo)
    if planes is None or frame != Frame() or config.edge_source == "grey":
        planes = _planes_of(photo[rows, columns], config.edge_source)
    thresholds = config.low_threshold, config.high_threshold
    if config.fit_thresholds:
        thresholds = fitted_thresholds(sampled_strengths(planes, GRADIENT_STEP), *thresholds)
    found = canny(planes, *thresholds)
    if sky is not None and config.sky_edges < 1:
        where, doubt = boundary(sky, height, width)
        lower = thresholds[0] * config.sky_edges, thresholds[1] * config.sky_edges
        near = np.where(doubt > SURE, -1, np.rint(where) - rows.start)[columns].astype(np.int32)
        seek(found, planes, lower, near, math.ceil(height / min(len(sky), REGIONS)))
    if found.shape == (height, width):
        return found, thresholds
    edges = np.zeros((height, width), np.bool_)
    edges[rows, columns] = found
    return edges, thresholds


def find_edges(photo: U8, source: EdgeSource, low: float, high: float) -> Bool:
    """Canny edges of an RGB photo.

    In colour, the gradient of each pixel is that of the channel in which it is strongest: a blue
    ridge under a blue sky of the same grey is found all the same.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        source: Whether to look at the grey or the colour photo.
        low: Lower hysteresis threshold, on the 3x3 Sobel gradient of 8-bit values (L1 norm).
        high: Upper hysteresis threshold, same unit.

    Returns:
        ``(H, W)`` bool, True on edge pixels.

    Examples:
        The edge lies in the first row of the darker half.

        >>> photo = np.full((9, 8, 3), 200, np.uint8)
        >>> photo[5:] = 60
        >>> edges = find_edges(photo, "colour", 50.0, 220.0)
        >>> np.flatnonzero(edges.all(axis=1))
        array([5])
    """
    return canny(_planes_of(photo, source), low, high)


def gradient_norms(photo: U8, source: EdgeSource) -> I16:
    """What the thresholds of `find_edges` are compared with: L1 norms of gradients, ``(H, W)``.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        source: Whether to look at the grey or the colour photo.

    Examples:
        >>> photo = np.full((4, 3, 3), 200, np.uint8)
        >>> photo[2:] = 60
        >>> gradient_norms(photo, "grey")[:, 1].tolist()
        [0, 560, 560, 0]
    """
    norms = sampled_strengths(_planes_of(photo, source), 1)
    return norms.reshape(photo.shape[:2])[::-1]  # which begins at the last row


def _planes_of(photo: U8, source: EdgeSource) -> U8:
    """What `find_edges` looks at."""
    return padded_planes(to_grey(photo) if source == "grey" else photo)


def seek(edges: Bool, planes: U8, thresholds: tuple[float, float], near: Int, half: int) -> None:
    """Add edges, in place, where the sky model has a sure boundary and no edge lies near it.

    Lower thresholds everywhere would make edges of clouds and grain. Here it is known where the
    skyline must be, and no edge of the photo is outbid.

    Args:
        edges: ``(H, W)`` edge map.
        planes: ``(C, H + 6, W + 6)`` channels of the same photo, see `padded_planes`.
        thresholds: Lower and upper Canny threshold to seek with.
        near: ``(W,)`` row of the boundary; at the upper or lower rim or beyond where there is none.
        half: So many rows above and below it edges are near.
    """
    width = edges.shape[1]
    wanted = _without_edge(edges, near, half)
    for first, last in runs(wanted):
        if last - first + 1 < SHORTEST_GAP * width:
            wanted[first : last + 1] = False
    columns = np.flatnonzero(wanted)
    if not len(columns):
        return
    # a pixel more at each side: Canny compares neighbours
    left, right = max(columns[0] - 1, 0), columns[-1] + 2
    top, end = max(near[columns].min() - half - 1, 0), near[columns].max() + half + 2
    rim = 2 * REACH
    more = canny(planes[:, top : end + rim, left : right + rim].copy(), *thresholds)
    apart = np.abs(np.arange(top, top + len(more))[:, None] - near[left:right])
    edges[top : top + len(more), left:right] |= more & (apart <= half) & wanted[left:right]


def fitted_thresholds(strengths: I16, low: float, high: float) -> tuple[float, float]:
    """Canny thresholds lowered for a soft or hazy photo, as far as its noise allows.

    Fixed thresholds miss the skyline of a photo that is a little out of focus. The strong
    gradients of the photo say how far to go down, the weak ones (usually sky) where its grain
    begins. The thresholds keep their ratio and are never raised.

    Args:
        strengths: ``(n,)`` L1 norms of Sobel gradients, of pixels that stand for the photo.
        low: Lower threshold for a crisp photo.
        high: Upper threshold for a crisp photo.

    Examples:
        In a photo without any gradient they are lowered as far as they may be.

        >>> fitted_thresholds(np.zeros(100, np.int16), 50.0, 220.0)
        (15.0, 66.0)
    """
    both = NOISE_PERCENTILE, STRONG_PERCENTILE
    weak, strong = percentiles_of_counts(strengths, both)
    wanted = max(STRONG_SHARE * strong, NOISE_MULTIPLE * weak) / (high or 1.0)
    factor = float(min(max(wanted, LOWEST_FACTOR), 1.0))
    return low * factor, high * factor


def edge_pixels(edges: Bool) -> tuple[Int, Int]:
    """Rows and columns of the edge pixels, two ``(n,)`` int32 arrays, row by row.

    Examples:
        >>> edge_pixels(np.array([[False, True], [True, False]]))
        (array([0, 1], dtype=int32), array([1, 0], dtype=int32))
    """
    edges = np.ascontiguousarray(edges)
    # a place more than there are: the pixel after an edge pixel is written, edge or not
    count = np.count_nonzero(edges)
    rows, columns = np.empty(count, np.int32), np.empty(count + 1, np.int32)
    _list_edges(edges.view(np.uint8), rows, columns)
    return rows, columns[:-1]


def edge_index(edges: Bool) -> Int:
    """Place of each pixel among the edge pixels, ``(H, W)``; -1 where there is no edge.

    >>> edge_index(np.array([[False, True], [True, False]])).tolist()
    [[-1, 0], [1, -1]]
    """
    flat = np.flatnonzero(edges)
    index = np.full(edges.shape, -1, np.int32)
    index.ravel()[flat] = np.arange(len(flat), dtype=np.int32)
    return index


@numba.njit(cache=True, nogil=True)
def _without_edge(edges: Bool, near: Int, half: int) -> Bool:
    """Columns ``(W,)`` that have a row to look near, and no edge there."""
    height, width = edges.shape
    without = np.zeros(width, np.bool_)
    for column in range(width):
        row = near[column]
        if row <= 0 or row >= height:
            continue
        without[column] = True
        for at in range(max(row - half, 0), min(row + half + 1, height)):
            if edges[at, column]:
                without[column] = False
                break
    return without


def edge_settings(config: DetectorConfig) -> tuple[object, ...]:
    """What `candidate_edges` depends on where there is no map of the sky."""
    return tuple(getattr(config, name) for name in EDGE_SETTINGS)


@numba.njit(cache=True, nogil=True)
def _list_edges(edges: U8, rows: Int, columns: Int) -> None:
    """Fill in where the edge pixels are; eight pixels without any are one question."""
    height, width = edges.shape
    count = np.uintp(0)
    whole = width - width % 8
    for row in range(height):
        line, first = edges[row], count
        eights = line[:whole].view(np.uint64)
        for at in range(len(eights)):
            if eights[at] == 0:
                continue
            for column in range(8 * at, 8 * at + 8):
                columns[count] = column
                count += np.uintp(line[column])
        for column in range(whole, width):
            columns[count] = column
            count += np.uintp(line[column])
        rows[first:count] = row
