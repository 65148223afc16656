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


def score_at(grey: U8, rows: Int, columns: Int, bins: Int, filters: F32) -> F32:
    """Confidence that each chosen pixel belongs to the skyline.

    Args:
        grey: ``(H, W)`` uint8.
        rows: ``(n,)`` int32.
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
    lanes = -(-size // 8) * 8
    padded = cv2.copyMakeBorder(grey, reach, reach, reach, lanes - reach, cv2.BORDER_REPLICATE)
    taps = np.zeros((*filters.shape[:2], lanes), np.float32)
    taps[:, :, :size] = filters
    scores: F32 = _apply(padded.astype(np.float32), rows, columns, bins, taps, (0,) * lanes)
    return scores


@numba.njit(cache=True, nogil=True, fastmath=True)
def _apply(
    padded: F32, rows: Int, columns: Int, bins: Int, taps: F32, lanes: tuple[int, ...]
) -> F32:
    """Filter outputs; rows of taps are filled up with zeros to whole vectors of eight.

    The compiler knows the length of the tuple `lanes`, not that of an array, and so unrolls the
    inner loop.
    """
    scores = np.empty(rows.size, np.float32)
    sums = np.empty(len(lanes), np.float32)
    for pixel in range(rows.size):
        top = rows[pixel]
        left = columns[pixel]
        own = bins[pixel]
        sums[:] = 0
        for down in range(taps.shape[1]):
            for lane in range(len(lanes)):
                sums[lane] += taps[own, down, lane] * padded[top + down, left + lane]
        score = sums.sum() * np.float32(1 / 255)
        scores[pixel] = min(max(score, np.float32(0)), np.float32(1))
    return scores
