r"""Stage 4, score: the filter of each pixel's bin, applied to its grey patch (equation 15).

$$
\hat{u}_i = (\mathbf{h}^{s(i)})^T \mathbf{R}_i \mathbf{z}
$$

$\mathbf{h}^{s(i)}$ is the filter of the bin $s(i)$, $\mathbf{R}_i \mathbf{z}$ the grey patch around
the pixel.
"""

import cv2
import numba
import numpy as np

from skyline_viz.arrays import F32, U8, Int
from skyline_viz.kernels.vectors import LANES, dot_lanes

_BAND = 32
"""Rows that are made floats together: what of them is read stays in the cache."""


def score_at(grey: U8, rows: Int, columns: Int, bins: Int, filters: F32) -> F32:
    """Confidence that each chosen pixel belongs to the skyline.

    Args:
        grey: ``(H, W)`` uint8.
        rows: ``(n,)`` int32; fastest by far in ascending order.
        columns: ``(n,)`` int32.
        bins: ``(n,)`` int32, the filter to use.
        filters: ``(K, m, m)`` float32.

    Returns:
        ``(n,)`` in [0, 1]: the filter's output, clipped to [0, 255], over 255. Patches reach over
        the border into repeated border pixels.

    Examples:
        A filter that takes the mean of nine pixels:

        >>> grey = np.full((9, 9), 51, np.uint8)
        >>> filters = np.full((1, 3, 3), 1 / 9, np.float32)
        >>> pixel = np.array([4], np.int32)
        >>> score_at(grey, pixel, pixel, np.array([0], np.int32), filters).round(4)
        array([0.2], dtype=float32)
    """
    size = filters.shape[1]
    reach = size // 2
    lanes = -(-size // LANES) * LANES
    padded = cv2.copyMakeBorder(grey, reach, reach, reach, lanes - reach, cv2.BORDER_REPLICATE)
    taps = np.zeros((*filters.shape[:2], lanes), np.float32)
    taps[:, :, :size] = filters
    scores = np.empty(len(rows), np.float32)
    band = np.empty((_BAND + size - 1) * padded.shape[1], np.float32)
    chosen = rows, columns, bins
    _apply(padded.ravel(), padded.shape[1], band, *chosen, taps.ravel(), (0,) * size, scores)
    return scores


@numba.njit(cache=True, nogil=True)
def _apply(
    picture: U8,
    stride: int,
    band: F32,
    rows: Int,
    columns: Int,
    bins: Int,
    taps: F32,
    height: tuple[int, ...],
    scores: F32,
) -> None:
    """Fill in the filter outputs.

    Rows of taps are filled up with zeros to whole vectors. A filter is read from one place on, and
    a patch row by row: no output but the last is written.

    Args:
        picture: The padded grey photo, flat.
        stride: Its width.
        band: Room for the rows around `_BAND` of them.
        rows: ``(n,)``, as are `columns` and `bins`.
        columns: See `rows`.
        bins: See `rows`.
        taps: The filters, flat.
        height: As many entries as a filter has rows, see `dot_lanes`.
        scores: ``(n,)`` are filled.
    """
    size = len(height)
    lanes = np.uintp((size + LANES - 1) // LANES * LANES)
    step = np.uintp(stride)
    top = end = 0
    for pixel in range(len(rows)):
        if not top <= rows[pixel] < end:
            top = rows[pixel]
            end = min(top + _BAND, len(picture) // stride - size + 1)
            _to_floats(picture[top * stride : (end + size - 1) * stride], band)
        own = np.uintp(bins[pixel]) * np.uintp(size) * lanes
        place = np.uintp(rows[pixel] - top) * step + np.uintp(columns[pixel])
        total = np.float32(0)
        for lane in range(np.uintp(0), lanes, np.uintp(LANES)):
            total += dot_lanes(taps, own + lane, lanes, band, place + lane, step, height)
        scores[pixel] = min(max(total * np.float32(1 / 255), np.float32(0)), np.float32(1))


@numba.njit(cache=True, nogil=True)
def _to_floats(picture: U8, band: F32) -> None:
    for place in range(len(picture)):
        band[place] = picture[place]
