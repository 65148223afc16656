"""Stage 2, structure tensor: how strong, how straight and which way each pixel's edge is.

The gradient of every colour channel is taken by diagonal 2x2 differences, which are centred
between four pixels; a separable 6-tap Gaussian, centred between two, brings the tensor back onto
the pixels (equations 12 to 15 of the paper)::

    T = sum over channels and window of  w [gx gx, gx gy; gx gy, gy gy]
"""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Int

WINDOW = np.array([0.0053, 0.0948, 0.3999, 0.3999, 0.0948, 0.0053], np.float32)
"""The window along one axis; the weight of a 6x6 neighbourhood is its outer product."""

_REACH = 3  # pixels that the 6-tap window of 2x2 differences needs to each side


@dataclass(frozen=True)
class Tensor:
    """Features of the structure tensor, each ``(n,)`` at chosen pixels or ``(H, W)`` dense."""

    strength: F32
    """Square root of the dominant eigenvalue, in grey levels a pixel, summed over channels."""

    coherence: F32
    """``(sqrt(l1) - sqrt(l2)) / (sqrt(l1) + sqrt(l2))``, in [0, 1]; 0 where nothing changes."""

    orientation: F32
    """Angle of the gradient in degrees, in [0, 180), from the column axis towards growing rows."""


def tensor_map(photo: U8) -> Tensor:
    """Structure tensor of every pixel of an RGB photo; `tensor_at` gives the same values."""
    height, width = photo.shape[:2]
    sums = [
        # an even kernel is anchored at its fourth tap: value p covers the differences p-3 to p+2
        cv2.sepFilter2D(plane, -1, WINDOW, WINDOW)[_REACH:, _REACH:][:height, :width].ravel()
        for plane in _products(*_padded_channels(photo))
    ]
    strength, coherence, orientation = _eigen(*sums).reshape(3, height, width)
    return Tensor(strength, coherence, orientation)


def tensor_at(photo: U8, rows: Int, columns: Int) -> Tensor:
    """Structure tensor at chosen pixels only.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        rows: ``(n,)`` int32, each in ``[0, H)``.
        columns: ``(n,)`` int32, each in ``[0, W)``.
    """
    products = _products(*_padded_channels(photo))
    return Tensor(*_eigen(*_window_sums(products, rows, columns, WINDOW)))


def _padded_channels(photo: U8) -> Sequence[U8]:
    channels: Sequence[U8] = cv2.split(
        cv2.copyMakeBorder(photo, _REACH, _REACH, _REACH, _REACH, cv2.BORDER_REPLICATE)
    )
    return channels


@numba.njit(cache=True, nogil=True)
def _products(red: U8, green: U8, blue: U8) -> F32:
    """``gx gx``, ``gx gy`` and ``gy gy`` between each four pixels, summed over the channels.

    ``(3, h, w)`` for channels ``(h, w)``; the last row and column are zero. Separate channels and
    whole-number sums let the compiler take 16 pixels at a time.
    """
    height, width = red.shape
    products = np.zeros((3, height, width), np.float32)
    quarter = np.float32(0.25)
    for row in range(height - 1):
        for column in range(width - 1):
            xx = 0
            xy = 0
            yy = 0
            for plane in (red, green, blue):
                falling = np.int32(plane[row + 1, column + 1]) - np.int32(plane[row, column])
                rising = np.int32(plane[row, column + 1]) - np.int32(plane[row + 1, column])
                gx = falling + rising  # twice the gradient: hence the quarter below
                gy = falling - rising
                xx += gx * gx
                xy += gx * gy
                yy += gy * gy
            products[0, row, column] = xx * quarter
            products[1, row, column] = xy * quarter
            products[2, row, column] = yy * quarter
    return products


@numba.njit(cache=True, nogil=True, fastmath=True)
def _window_sums(products: F32, rows: Int, columns: Int, window: F32) -> F32:
    """Sums of the products over the window around each chosen pixel, ``(3, n)``."""
    sums = np.empty((3, rows.size), np.float32)
    for pixel in range(rows.size):
        top = rows[pixel]
        left = columns[pixel]
        for product in range(3):
            total = np.float32(0)
            for down in range(6):
                line = np.float32(0)
                for right in range(6):
                    line += window[right] * products[product, top + down, left + right]
                total += window[down] * line
            sums[product, pixel] = total
    return sums


def _eigen(txx: F32, txy: F32, tyy: F32) -> F32:
    """Strength, coherence and orientation of ``(n,)`` tensors, ``(3, n)``."""
    half_trace = (txx + tyy) * np.float32(0.5)
    half_gap = np.hypot((txx - tyy) * np.float32(0.5), txy)
    large = np.sqrt(half_trace + half_gap)
    small = np.sqrt(np.maximum(half_trace - half_gap, 0))
    total = large + small
    coherence = np.divide(large - small, total, out=np.zeros_like(total), where=total > 0)
    angle = np.degrees(np.arctan2(2 * txy, txx - tyy)) * np.float32(0.5)
    return np.stack([large, coherence, np.mod(angle, np.float32(180))])
