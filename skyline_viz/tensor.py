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

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F32, U8, Int
from skyline_viz.kernels.eigen import to_degrees, without_angle
from skyline_viz.kernels.planes import padded_planes
from skyline_viz.kernels.tensor_sums import window_sums

WINDOW = np.array([0.0053, 0.0948, 0.3999, 0.3999, 0.0948, 0.0053], np.float32)
"""The window along one axis; the weight of a 6x6 neighbourhood is its outer product."""

_CHUNK = 1 << 13  # tensors at a time, so that what is worked out on the way stays in the cache


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
    channels = [plane.astype(np.float32) for plane in padded_planes(photo)]
    falling = [plane[1:, 1:] - plane[:-1, :-1] for plane in channels]
    rising = [plane[:-1, 1:] - plane[1:, :-1] for plane in channels]
    gx = [(a + b) / 2 for a, b in zip(falling, rising, strict=True)]
    gy = [(a - b) / 2 for a, b in zip(falling, rising, strict=True)]
    sums = []
    for left, right in ((gx, gx), (gx, gy), (gy, gy)):
        product = np.add.reduce([a * b for a, b in zip(left, right, strict=True)])
        # the very order of `window_sums`, so that both round alike
        across = np.zeros((height, width + 5), np.float32)
        for tap in range(6):
            across += WINDOW[tap] * product[tap : tap + height]
        total = np.zeros((height, width), np.float32)
        for tap in range(6):
            total += WINDOW[tap] * across[:, tap : tap + width]
        sums.append(total.ravel())
    strength, coherence, orientation = _eigen(*sums).reshape(3, height, width)
    return Tensor(strength, coherence, orientation)


def tensor_at(photo: U8, rows: Int, columns: Int, planes: U8 | None = None) -> Tensor:
    """Structure tensor at chosen pixels only.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        rows: ``(n,)`` int32, each in ``[0, H)``; fastest in ascending order.
        columns: ``(n,)`` int32, each in ``[0, W)``.
        planes: The photo's `padded_planes`, where they are there already.

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
    order = None if (rows[1:] >= rows[:-1]).all() else np.argsort(rows, kind="stable")
    if order is not None:
        rows, columns = rows[order], columns[order]
    first = np.searchsorted(rows, np.arange(photo.shape[0] + 1, dtype=np.int32))
    sums = np.empty((3, len(rows)), np.float32)
    planes = padded_planes(photo) if planes is None else planes
    window_sums(planes, columns, first, WINDOW, sums)
    features = _eigen(*sums)
    if order is not None:
        features[:, order] = features.copy()
    return Tensor(*features)


def _eigen(txx: F32, txy: F32, tyy: F32) -> F32:
    """Strength, coherence and orientation of ``(n,)`` tensors, ``(3, n)``."""
    features = np.empty((3, len(txx)), np.float32)
    for start in range(0, len(txx), _CHUNK):
        part = slice(start, start + _CHUNK)
        _eigen_part(txx[part], txy[part], tyy[part], features[:, part])
    return features


def _eigen_part(txx: F32, txy: F32, tyy: F32, features: F32) -> None:
    """Write `_eigen` of a few tensors to `features`."""
    sine, cosine = np.empty_like(txx), np.empty_like(txx)
    without_angle(txx, txy, tyy, features[0], features[1], sine, cosine)
    np.arctan2(sine, cosine, out=features[2])
    to_degrees(features[2])
