r"""Stage 2, structure tensor: how strong, how straight and which way each pixel's edge is.

The tensor sums products of gradients over three channels and a window (equation 23 of the paper):

$$
\mathbf{T}_i = \sum_{c} \sum_{j} w_j^i \, \mathbf{g}_j^c (\mathbf{g}_j^c)^T
\quad \text{with } \mathbf{g} = (g_x, g_y)^T
$$

The gradient of every colour channel is taken by diagonal 2x2 differences, which are centred
between four pixels. A separable 6-tap Gaussian, centred between two, brings the tensor back onto
the pixels. The eigenvalues $\lambda_1 \ge \lambda_2$ give strength and coherence (equation 24),
the dominant eigenvector gives the orientation:

$$
\text{strength} = \sqrt{\lambda_1}, \quad \text{coherence} =
\frac{\sqrt{\lambda_1} - \sqrt{\lambda_2}}{\sqrt{\lambda_1} + \sqrt{\lambda_2}}
$$
"""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Int

WINDOW = np.array([0.0053, 0.0948, 0.3999, 0.3999, 0.0948, 0.0053], np.float32)
"""The window along one axis; the weight of a 6x6 neighbourhood is its outer product."""

_CHUNK = 1 << 15  # tensors at a time, so that what is worked out on the way stays in the cache
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
    """Structure tensor of every pixel of an RGB photo; `tensor_at` gives the same values.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.

    Returns:
        Three maps ``(H, W)``.

    Examples:
        >>> photo = np.full((12, 10, 3), 200, np.uint8)
        >>> tensor_map(photo).strength.max()
        np.float32(0.0)
    """
    height, width = photo.shape[:2]
    channels = [plane.astype(np.float32) for plane in _padded_channels(photo)]
    falling = [plane[1:, 1:] - plane[:-1, :-1] for plane in channels]
    rising = [plane[:-1, 1:] - plane[1:, :-1] for plane in channels]
    gx = [(a + b) / 2 for a, b in zip(falling, rising, strict=True)]
    gy = [(a - b) / 2 for a, b in zip(falling, rising, strict=True)]
    sums = []
    for left, right in ((gx, gx), (gx, gy), (gy, gy)):
        product = np.add.reduce([a * b for a, b in zip(left, right, strict=True)])
        # the very order of `_window_sums`, so that both round alike
        across = np.zeros((height, width + 5), np.float32)
        for tap in range(6):
            across += WINDOW[tap] * product[tap : tap + height]
        total = np.zeros((height, width), np.float32)
        for tap in range(6):
            total += WINDOW[tap] * across[:, tap : tap + width]
        sums.append(total.ravel())
    strength, coherence, orientation = _eigen(*sums).reshape(3, height, width)
    return Tensor(strength, coherence, orientation)


def tensor_at(photo: U8, rows: Int, columns: Int) -> Tensor:
    """Structure tensor at chosen pixels only.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        rows: ``(n,)`` int32, each in ``[0, H)``; fastest in ascending order.
        columns: ``(n,)`` int32, each in ``[0, W)``.

    Returns:
        Three arrays ``(n,)``.

    Examples:
        A level edge is straight, and its gradient points down.

        >>> photo = np.full((12, 10, 3), 200, np.uint8)
        >>> photo[6:] = 60
        >>> tensor = tensor_at(photo, np.array([6], np.int32), np.array([4], np.int32))
        >>> tensor.coherence, tensor.orientation
        (array([1.], dtype=float32), array([90.], dtype=float32))
    """
    order = np.argsort(rows, kind="stable")
    first = np.searchsorted(rows[order], np.arange(photo.shape[0] + 1))
    sums = _window_sums(*_padded_channels(photo), columns, order, first, WINDOW)
    return Tensor(*_eigen(*sums))


def _padded_channels(photo: U8) -> Sequence[U8]:
    channels: Sequence[U8] = cv2.split(
        cv2.copyMakeBorder(photo, _REACH, _REACH, _REACH, _REACH, cv2.BORDER_REPLICATE)
    )
    return channels


@numba.njit(cache=True, nogil=True)
def _window_sums(
    red: U8, green: U8, blue: U8, columns: Int, order: Int, first: Int, window: F32
) -> F32:
    """Sums of gx gx, gx gy and gy gy over the window around each chosen pixel, ``(3, n)``.

    Walks down the photo with the products of the last six rows at hand: whole rows are summed
    downwards, 16 pixels at a time, and only chosen pixels sideways.

    Args:
        red: Channel ``(H + 6, W + 6)``, as are `green` and `blue`.
        green: See `red`.
        blue: See `red`.
        columns: ``(n,)`` columns of the chosen pixels.
        order: ``(n,)`` pixels in ascending order of rows.
        first: ``(H + 1,)`` place in `order` of each row's first pixel.
        window: ``(6,)`` weights.
    """
    height = red.shape[0] - 6
    width = red.shape[1] - 1
    sums = np.empty((3, columns.size), np.float32)
    recent = np.zeros((6, 3, width), np.float32)
    across = np.zeros((3, width), np.float32)
    for row in range(height + 5):
        _products(red, green, blue, row, recent[row % 6])
        target = row - 5
        if target < 0 or first[target] == first[target + 1]:
            continue
        across[:] = 0
        for tap in range(6):
            line = recent[(target + tap) % 6]
            for product in range(3):
                for column in range(width):
                    across[product, column] += window[tap] * line[product, column]
        for place in range(first[target], first[target + 1]):
            pixel = order[place]
            left = columns[pixel]
            for product in range(3):
                total = np.float32(0)
                for tap in range(6):
                    total += window[tap] * across[product, left + tap]
                sums[product, pixel] = total
    return sums


@numba.njit(cache=True, nogil=True)
def _products(red: U8, green: U8, blue: U8, row: int, products: F32) -> None:
    """Write gx gx, gx gy and gy gy below one row, summed over channels, to ``(3, w - 1)``."""
    quarter = np.float32(0.25)
    for column in range(products.shape[1]):
        xx = np.int32(0)
        xy = np.int32(0)
        yy = np.int32(0)
        for plane in (red, green, blue):
            falling = np.int32(plane[row + 1, column + 1]) - np.int32(plane[row, column])
            rising = np.int32(plane[row, column + 1]) - np.int32(plane[row + 1, column])
            gx = falling + rising  # twice the gradient: hence the quarter below
            gy = falling - rising
            xx += gx * gx
            xy += gx * gy
            yy += gy * gy
        products[0, column] = xx * quarter
        products[1, column] = xy * quarter
        products[2, column] = yy * quarter


def _eigen(txx: F32, txy: F32, tyy: F32) -> F32:
    """Strength, coherence and orientation of ``(n,)`` tensors, ``(3, n)``."""
    features = np.empty((3, len(txx)), np.float32)
    for start in range(0, len(txx), _CHUNK):
        part = slice(start, start + _CHUNK)
        _eigen_part(txx[part], txy[part], tyy[part], features[:, part])
    return features


def _eigen_part(txx: F32, txy: F32, tyy: F32, features: F32) -> None:
    """Write `_eigen` of a few tensors to `features`."""
    half_trace = (txx + tyy) * np.float32(0.5)
    half_gap = np.sqrt(np.square((txx - tyy) * np.float32(0.5)) + np.square(txy))
    large = np.sqrt(half_trace + half_gap, out=features[0])
    small = np.sqrt(np.maximum(half_trace - half_gap, 0))
    # where nothing changes both are zero, and so is the coherence
    np.divide(large - small, np.maximum(large + small, np.float32(1e-12)), out=features[1])
    angle = np.arctan2(2 * txy, txx - tyy) * np.float32(90 / np.pi)
    angle[angle < 0] += np.float32(180)
    angle[angle >= 180] = 0  # a tiny negative angle plus 180 rounds to 180
    features[2] = angle
