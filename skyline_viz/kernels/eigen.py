"""Eigenvalues of structure tensors: all that is not an angle, and the angle before and after."""

import math

import numba
import numpy as np

from skyline_viz.arrays import F32


@numba.njit(cache=True, nogil=True)
def without_angle(
    txx: F32, txy: F32, tyy: F32, strength: F32, coherence: F32, sine: F32, cosine: F32
) -> None:
    """Fill in what `_strengths` and `_doubled` do, one after the other: each touches few arrays."""
    _strengths(txx, txy, tyy, strength, coherence)
    _doubled(txx, txy, tyy, sine, cosine)


@numba.njit(cache=True, nogil=True)
def _strengths(txx: F32, txy: F32, tyy: F32, strength: F32, coherence: F32) -> None:
    """Square root of the dominant eigenvalue, and coherence; see `skyline_viz.tensor`.

    Args:
        txx: ``(n,)``, as are all others.
        txy: See `txx`.
        tyy: See `txx`.
        strength: Is filled.
        coherence: Is filled; 0 where nothing changes: there both eigenvalues are.
    """
    half, zero, least = np.float32(0.5), np.float32(0), np.float32(1e-12)
    for pixel in range(len(txx)):
        half_trace = (txx[pixel] + tyy[pixel]) * half
        difference = (txx[pixel] - tyy[pixel]) * half
        half_gap = math.sqrt(difference * difference + txy[pixel] * txy[pixel])
        large = math.sqrt(half_trace + half_gap)
        small = math.sqrt(max(half_trace - half_gap, zero))
        strength[pixel] = large
        both = np.float32(large + small)
        coherence[pixel] = (large - small) / max(least, both)


@numba.njit(cache=True, nogil=True)
def _doubled(txx: F32, txy: F32, tyy: F32, sine: F32, cosine: F32) -> None:
    """Sine and cosine of the doubled angle of the gradient, up to a common factor."""
    for pixel in range(len(txx)):
        sine[pixel] = np.float32(2) * txy[pixel]
        cosine[pixel] = txx[pixel] - tyy[pixel]


@numba.njit(cache=True, nogil=True)
def to_degrees(doubled: F32) -> None:
    """Halve angles in [-pi, pi], and bring them to degrees in [0, 180), in place."""
    for pixel in range(len(doubled)):
        angle = doubled[pixel] * np.float32(90 / np.pi)
        angle = angle + np.float32(180) if angle < 0 else angle
        # a tiny negative angle plus 180 rounds to 180
        doubled[pixel] = np.float32(0) if angle >= np.float32(180) else angle
