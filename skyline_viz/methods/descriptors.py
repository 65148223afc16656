"""SIFT and HOG descriptors around pixels: upright, of one size, read from maps of the whole photo.

Both are histograms of gradient orientation in cells, with votes shared linearly between neighbours
in orientation and in place. Sharing in place is a convolution with a triangle, so one map for each
orientation is smoothed once, and the descriptor of a pixel is what the maps hold at the centres of
its cells.

* SIFT (Lowe, 2004): 4x4 cells of 4 pixels, 8 orientations over the full circle, weighted with a
  Gaussian over the window (one weight a cell); normalised, clipped at 0.2 and normalised again.
  The keypoint is the pixel itself, at the finest scale and without an orientation of its own:
  what `cv2.SIFT` computes there, but for the weights and at a fraction of the time.
* HOG (Dalal and Triggs, 2005): 4x4 cells of 8 pixels, 9 orientations over half a circle, 3x3
  overlapping blocks of 2x2 cells, each normalised like SIFT.
"""

from __future__ import annotations

import cv2
import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Int
from skyline_viz.edges import to_grey

SIFT_LENGTH = 128
"""Values of a SIFT descriptor: 4x4 cells, 8 orientations."""

HOG_LENGTH = 324
"""Values of a HOG descriptor: 3x3 blocks, 2x2 cells, 9 orientations."""

LENGTH = SIFT_LENGTH + HOG_LENGTH
"""Values of both."""

_SIFT_CELL, _SIFT_ORIENTATIONS = 4, 8
_SIFT_SIGMA = 1.5  # to SIFT's finest scale of 1.6 pixels from a photo, which has about 0.5
_HOG_CELL, _HOG_ORIENTATIONS = 8, 9
_CLIP = 0.2
_LEAST = 1.0  # grey values: gradients below are noise, and must not become a full descriptor


def describe(photo: U8, rows: Int, columns: Int) -> F32:
    """SIFT and HOG descriptors of pixels, side by side.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        rows: ``(n,)`` rows of the pixels.
        columns: ``(n,)`` their columns.

    Returns:
        ``(n, 452)`` float32, SIFT first, each value in [0, 1].
    """
    found = np.empty((len(rows), LENGTH), np.float32)
    _describe(*descriptor_maps(photo), rows, columns, found)
    return found


def project(photo: U8, rows: Int, columns: Int, weights: F32) -> F32:
    """``describe(photo, rows, columns) @ weights``, without keeping the descriptors.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        rows: ``(n,)`` rows of the pixels.
        columns: ``(n,)`` their columns.
        weights: ``(452,)``.

    Returns:
        ``(n,)`` float32.
    """
    found = np.empty(len(rows), np.float32)
    _project(*descriptor_maps(photo), rows, columns, weights.astype(np.float32), found)
    return found


def descriptor_maps(photo: U8) -> tuple[F32, F32]:
    """Histograms of orientation around every pixel, of SIFT's and of HOG's cells.

    Returns:
        ``(H + 16, W + 16, 8)`` and ``(H + 32, W + 32, 9)`` float32: the photo with a rim in which
        its border is repeated, 8 and 16 pixels wide.
    """
    grey = to_grey(photo).astype(np.float32)
    smooth = cv2.GaussianBlur(grey, (0, 0), _SIFT_SIGMA)
    maps = []
    for values, cell, count, circle in (
        (smooth, _SIFT_CELL, _SIFT_ORIENTATIONS, 2 * np.pi),
        (grey, _HOG_CELL, _HOG_ORIENTATIONS, np.pi),
    ):
        rim = 2 * cell
        padded = cv2.copyMakeBorder(values, rim, rim, rim, rim, cv2.BORDER_REPLICATE)
        across = cv2.Sobel(padded, cv2.CV_32F, 1, 0, ksize=1)
        down = cv2.Sobel(padded, cv2.CV_32F, 0, 1, ksize=1)
        votes = np.zeros((*padded.shape, count), np.float32)
        _vote(across, down, circle, votes)
        triangle = 1 - np.abs(np.arange(1 - cell, cell, dtype=np.float32)) / cell
        maps.append(cv2.sepFilter2D(votes, -1, triangle, triangle, borderType=cv2.BORDER_REPLICATE))
    return maps[0], maps[1]


@numba.njit(cache=True, nogil=True)
def _vote(across: F32, down: F32, circle: float, votes: F32) -> None:
    """Share the gradient magnitude of each pixel between its two nearest orientations."""
    count = votes.shape[2]
    for row in range(across.shape[0]):
        for column in range(across.shape[1]):
            x, y = across[row, column], -down[row, column]  # SIFT's angles run anticlockwise
            strength = np.sqrt(x * x + y * y)
            if strength == 0:
                continue
            at = (np.arctan2(y, x) % circle) / circle * count
            low = int(at)
            share = np.float32(at - low)
            votes[row, column, low % count] += (1 - share) * strength
            votes[row, column, (low + 1) % count] += share * strength


@numba.njit(cache=True, nogil=True)
def _describe(sift: F32, hog: F32, rows: Int, columns: Int, found: F32) -> None:
    """Fill ``(n, 452)`` with the descriptors of pixels."""
    weights = _window()
    for pixel in range(len(rows)):
        _one(sift, hog, rows[pixel], columns[pixel], weights, found[pixel])


@numba.njit(cache=True, nogil=True)
def _project(sift: F32, hog: F32, rows: Int, columns: Int, onto: F32, found: F32) -> None:
    """Fill ``(n,)`` with the products of descriptors and weights ``(452,)``."""
    weights = _window()
    descriptor = np.empty(LENGTH, np.float32)
    for pixel in range(len(rows)):
        _one(sift, hog, rows[pixel], columns[pixel], weights, descriptor)
        found[pixel] = _dot(descriptor, onto)


@numba.njit(cache=True, nogil=True)
def _window() -> F32:
    """Weights of SIFT's cells, ``(4, 4)``: a Gaussian of half the window's width."""
    weights = np.empty((4, 4), np.float32)
    for i in range(4):
        for j in range(4):
            weights[i, j] = np.exp(-(((i - 1.5) / 2) ** 2 + ((j - 1.5) / 2) ** 2) / 2)
    return weights


@numba.njit(cache=True, nogil=True)
def _one(sift: F32, hog: F32, row: int, column: int, weights: F32, found: F32) -> None:
    """Read the descriptor of a pixel from the maps."""
    at = 0
    for i in range(4):  # centres at -6, -2, 2 and 6 pixels, in a map with a rim of 8
        for j in range(4):
            down, right = row + 2 + _SIFT_CELL * i, column + 2 + _SIFT_CELL * j
            for orientation in range(_SIFT_ORIENTATIONS):
                found[at + orientation] = weights[i, j] * sift[down, right, orientation]
            at += _SIFT_ORIENTATIONS
    _normalise(found[:at], _SIFT_CELL * _SIFT_CELL * _LEAST)
    for i in range(3):
        for j in range(3):
            start = at
            for cell in range(4):  # centres at -12, -4, 4 and 12 pixels, in a rim of 16
                down = row + 4 + _HOG_CELL * (i + cell // 2)
                right = column + 4 + _HOG_CELL * (j + cell % 2)
                for orientation in range(_HOG_ORIENTATIONS):
                    found[at + orientation] = hog[down, right, orientation]
                at += _HOG_ORIENTATIONS
            _normalise(found[start:at], _HOG_CELL * _HOG_CELL * _LEAST)


@numba.njit(cache=True, nogil=True)
def _normalise(values: F32, least: float) -> None:
    """To unit length, clipped at 0.2, to unit length again; next to nothing stays small."""
    before = np.sqrt(_dot(values, values))
    scale = np.float32(1 / max(before, least))
    for index in range(len(values)):
        values[index] = min(values[index] * scale, np.float32(_CLIP))
    if before >= least:
        scale = np.float32(1 / np.sqrt(_dot(values, values)))
        for index in range(len(values)):
            values[index] *= scale


@numba.njit(cache=True, nogil=True, fastmath=True)
def _dot(some: F32, others: F32) -> np.float32:
    # fastmath lets the sum be taken in any order, and so by vector instructions
    total = np.float32(0)
    for index in range(len(some)):
        total += some[index] * others[index]
    return total
