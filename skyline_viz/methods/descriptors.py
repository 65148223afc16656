"""SIFT and HOG descriptors around pixels: upright, of one size, read from maps of the whole photo.

Both are histograms of gradient orientation in cells, with votes shared linearly between neighbours
in orientation and in place. Sharing in place is a convolution with a triangle, so one map for each
orientation is smoothed once, and the descriptor of a pixel is what the maps hold at the centres of
its cells.

* SIFT (Lowe, 2004): 4x4 cells of 4 pixels, 8 orientations over the full circle, weighted with a
  Gaussian over the window (one weight a cell); normalised, clipped at 0.2 and normalised again.
  The keypoint is the pixel itself, with no scale or orientation of its own.
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

_SIFT_CELL, _SIFT_ORIENTATIONS = 4, 8
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
    maps = descriptor_maps(photo)
    found = np.empty((len(rows), SIFT_LENGTH + HOG_LENGTH), np.float32)
    _fill(*maps, rows.astype(np.int32), columns.astype(np.int32), found)
    return found


def descriptor_maps(photo: U8) -> tuple[F32, F32]:
    """Histograms of orientation around every pixel, of SIFT's and of HOG's cells.

    Returns:
        ``(H + 16, W + 16, 8)`` and ``(H + 32, W + 32, 9)`` float32: the photo with a rim in which
        its border is repeated, 8 and 16 pixels wide.
    """
    grey = to_grey(photo)
    maps = []
    for cell, count, circle in (
        (_SIFT_CELL, _SIFT_ORIENTATIONS, 2 * np.pi),
        (_HOG_CELL, _HOG_ORIENTATIONS, np.pi),
    ):
        rim = 2 * cell
        padded = cv2.copyMakeBorder(grey, rim, rim, rim, rim, cv2.BORDER_REPLICATE)
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
            x, y = across[row, column], down[row, column]
            strength = np.sqrt(x * x + y * y)
            if strength == 0:
                continue
            at = (np.arctan2(y, x) % circle) / circle * count
            low = int(at)
            share = np.float32(at - low)
            votes[row, column, low % count] += (1 - share) * strength
            votes[row, column, (low + 1) % count] += share * strength


@numba.njit(cache=True, nogil=True)
def _fill(sift: F32, hog: F32, rows: Int, columns: Int, found: F32) -> None:
    """Read the descriptors of pixels from the maps."""
    cell, big = _SIFT_CELL, _HOG_CELL
    weights = np.empty(4, np.float32)
    for step in range(4):  # Gaussian of half the window's width
        weights[step] = np.exp(-(((step - 1.5) / 2) ** 2) / 2)
    cells = np.empty((4, 4, _HOG_ORIENTATIONS), np.float32)
    for pixel in range(len(rows)):
        row, column = rows[pixel], columns[pixel]
        at = 0
        for i in range(4):  # centres at -6, -2, 2 and 6 pixels, in a map with a rim of 8
            for j in range(4):
                weight = weights[i] * weights[j]
                for bin_ in range(_SIFT_ORIENTATIONS):
                    value = sift[row + 2 + cell * i, column + 2 + cell * j, bin_]
                    found[pixel, at] = weight * value
                    at += 1
        _normalise(found[pixel, :at], cell * cell * _LEAST)
        for i in range(4):  # centres at -12, -4, 4 and 12 pixels, in a map with a rim of 16
            for j in range(4):
                cells[i, j] = hog[row + 4 + big * i, column + 4 + big * j]
        for i in range(3):
            for j in range(3):
                start = at
                for cell_row in range(i, i + 2):
                    for cell_column in range(j, j + 2):
                        for bin_ in range(_HOG_ORIENTATIONS):
                            found[pixel, at] = cells[cell_row, cell_column, bin_]
                            at += 1
                _normalise(found[pixel, start:at], big * big * _LEAST)


@numba.njit(cache=True, nogil=True)
def _normalise(values: F32, least: float) -> None:
    """To unit length, clipped at 0.2, to unit length again; next to nothing stays small."""
    for floor in (least, 0.0):
        total = np.float32(1e-12)
        for value in values:
            total += value * value
        length = max(np.sqrt(total), np.float32(floor))
        for index in range(len(values)):
            values[index] = values[index] / length
            if floor > 0:
                values[index] = min(values[index], np.float32(_CLIP))
