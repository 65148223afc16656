"""Where the map of a sky model has its boundary: in each column the row that suits it best."""

from __future__ import annotations

import numba
import numpy as np

from skyline_viz.arrays import F32, F64, Int


def improbable(sky: F32) -> F64:
    r"""How much of a column the map finds improbable, if the line runs at a border of regions.

    With $p$ the map and $h$ its rows,

    $$
    R(i, j) = \frac{1}{h} \Big( \sum_{k < i} (1 - p(k, j)) + \sum_{k \ge i} p(k, j) \Big)
    $$

    is the share of the column that would be sky that looks like terrain, or terrain that looks like
    sky. Between two borders it is linear.

    Args:
        sky: ``(h, w)`` probability of sky of each region, see `sky_model.SkyModel.sky`.

    Returns:
        ``(w, h + 1)``, in [0, 1].

    Examples:
        >>> improbable(np.array([[1], [0.5], [0], [0]], np.float32)).tolist()
        [[0.375, 0.125, 0.125, 0.375, 0.625]]
    """
    share = sky.T.astype(np.float64)
    borders = np.empty((share.shape[0], share.shape[1] + 1))
    borders[:, 0] = share.sum(axis=1)
    borders[:, 1:] = borders[:, :1] + np.cumsum(1 - 2 * share, axis=1)
    borders /= len(sky)
    return borders


def boundary(sky: F32, height: int, width: int) -> tuple[F32, F32]:
    """Where the line suits a map best in each column of a photo, and how well.

    Args:
        sky: ``(h, w)`` probability of sky of each region.
        height: Rows of the photo.
        width: Its columns, between whose regions the map is interpolated.

    Returns:
        ``(W,)`` the rows, to a border of regions; 0 or `height` where the map has no boundary. And
        ``(W,)`` the share of the column that is improbable even so: its doubt, in [0, 1].

    Examples:
        >>> sky = np.repeat([[1], [0.9], [0], [0]], 5, axis=1).astype(np.float32)
        >>> rows, doubt = boundary(sky, 200, 5)
        >>> rows.tolist(), round(float(doubt[0]), 3)
        ([100.0, 100.0, 100.0, 100.0, 100.0], 0.025)
    """
    borders = improbable(sky).astype(np.float32)
    best, doubt = np.zeros(width, np.int32), np.empty(width, np.float32)
    _least(borders, *between_centres(width, len(borders)), best, doubt)
    return (best * (height / len(sky))).astype(np.float32), doubt


def between_centres(length: int, regions: int) -> tuple[Int, Int, F32]:
    """For each pixel of an axis the regions before and after it, and how far it is on the way.

    Args:
        length: Pixels of the axis.
        regions: Regions that it has.

    Examples:
        >>> before, after, share = between_centres(4, 2)
        >>> before.tolist(), after.tolist(), share.tolist()
        ([0, 0, 0, 1], [1, 1, 1, 1], [0.0, 0.25, 0.75, 0.0])
    """
    places = np.clip((np.arange(length) + 0.5) * (regions / length) - 0.5, 0, regions - 1)
    before = places.astype(np.int32)
    after = np.minimum(before + 1, regions - 1).astype(np.int32)
    return before, after, (places - before).astype(np.float32)


@numba.njit(cache=True, nogil=True)
def _least(borders: F32, left: Int, right: Int, sideways: F32, best: Int, least: F32) -> None:
    """Find the first border of regions at which each column is the least improbable, and how much.

    Args:
        borders: ``(w, h + 1)`` see `improbable`.
        left: ``(W,)`` see `between_centres`, as are `right` and `sideways`.
        right: See `left`.
        sideways: See `left`.
        best: ``(W,)`` is filled with the borders.
        least: ``(W,)`` is filled with what is improbable there.
    """
    for column in range(len(best)):
        before, after, share = borders[left[column]], borders[right[column]], sideways[column]
        lowest = np.float32(np.inf)
        for border in range(borders.shape[1]):
            here = before[border] + share * (after[border] - before[border])
            if here < lowest:
                best[column], lowest = border, here
        least[column] = lowest
