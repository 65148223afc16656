"""Eigenvalues and angles: those of numpy, to the bit."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.kernels.eigen import to_degrees, without_angle
from testing.examples import examples


def some_tensors(seed, count, scale):
    gx, gy = np.random.default_rng(seed).normal(0, scale, (2, 3, count)).astype(np.float32)
    return [(one * other).sum(axis=0) for one, other in ((gx, gx), (gx, gy), (gy, gy))]


@examples(60)
@given(st.integers(0, 2**32 - 1), st.integers(0, 50), st.sampled_from([0.0, 1e-3, 1.0, 300.0]))
def test_features_are_those_of_numpy(seed, count, scale):
    txx, txy, tyy = some_tensors(seed, count, scale)
    half = np.float32(0.5)
    half_trace = (txx + tyy) * half
    half_gap = np.sqrt(np.square((txx - tyy) * half) + np.square(txy))
    large = np.sqrt(half_trace + half_gap)
    small = np.sqrt(np.maximum(half_trace - half_gap, 0))
    strength, coherence, sine, cosine = found = np.empty((4, count), np.float32)
    without_angle(txx, txy, tyy, *found)
    assert np.array_equal(strength, large)
    assert np.array_equal(coherence, (large - small) / np.maximum(large + small, np.float32(1e-12)))
    assert np.array_equal(sine, 2 * txy)
    assert np.array_equal(cosine, txx - tyy)


def test_angles_come_to_lie_in_half_a_turn():
    angles = np.float32([0, np.pi / 2, np.pi, -np.pi / 2, -1e-9, -np.pi])
    to_degrees(angles)
    assert np.allclose(angles, [0, 45, 90, 135, 0, 90])
    assert ((angles >= 0) & (angles < 180)).all()
