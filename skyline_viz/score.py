"""Stage 4, score: the filter of each pixel's bin, applied to its grey patch (equation 4)."""

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
    """
    reach = filters.shape[1] // 2
    padded = cv2.copyMakeBorder(grey, reach, reach, reach, reach, cv2.BORDER_REPLICATE)
    return _apply(padded, rows, columns, bins, filters)


@numba.njit(cache=True, nogil=True, fastmath=True)
def _apply(padded: U8, rows: Int, columns: Int, bins: Int, filters: F32) -> F32:
    size = filters.shape[1]
    scores = np.empty(rows.size, np.float32)
    for pixel in range(rows.size):
        top = rows[pixel]
        left = columns[pixel]
        taps = filters[bins[pixel]]
        total = np.float32(0)
        for down in range(size):
            for right in range(size):
                total += taps[down, right] * np.float32(padded[top + down, left + right])
        scores[pixel] = min(max(total * np.float32(1 / 255), np.float32(0)), np.float32(1))
    return scores
