"""How errors are distributed over photos: the histogram of A_err, and the cumulative curve."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from skyline_viz.arrays import F64

TOP = 10
"""A_err in pixels from which on photos share the histogram's last bin."""


def shares(errors: Sequence[float]) -> F64:
    """Share of photos ``(TOP + 1,)`` in bins one pixel of A_err wide; the last is open.

    >>> shares([0.2, 0.4, 1.5, 300.0])[[0, 1, 2, TOP]]
    array([0.5 , 0.25, 0.  , 0.25])

    Args:
        errors: A_err of each photo, in pixels.
    """
    bins = [min(int(error), TOP) for error in errors]
    counts = np.bincount(bins, minlength=TOP + 1).astype(np.float64)
    return counts / max(len(errors), 1)


def cumulative(errors: Sequence[float], tolerances: Sequence[float] | F64) -> F64:
    """Share of photos ``(k,)`` whose A_err is at most each of some tolerances, in pixels.

    >>> cumulative([0.2, 0.4, 1.5, 300.0], [0, 1, 20])
    array([0.  , 0.5 , 0.75])
    """
    ordered = np.sort(np.asarray(errors, np.float64))
    counts = np.searchsorted(ordered, np.asarray(tolerances, np.float64), side="right")
    found: F64 = counts / max(len(ordered), 1)
    return found
