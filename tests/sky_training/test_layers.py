"""New photos out of old ones."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.sky_training.examples import COLUMNS, ROWS, Example
from skyline_viz.sky_training.layers import flat, layered
from testing.examples import examples


def example(row: int, terrain: int, sky: int) -> Example:
    share = np.zeros((ROWS, COLUMNS), np.uint8)
    share[:row] = 255
    photo = np.where(share[..., None] > 0, sky, terrain).repeat(3, axis=2).astype(np.uint8)
    return Example(photo, share, "made")


@examples(20)
@given(seed=st.integers(0, 10**6), row=st.integers(30, 340), others=st.integers(0, 4))
def test_a_layered_photo_is_a_photo_whose_sky_lies_above(seed, row, others):
    rng = np.random.default_rng(seed)
    near = example(row, 40, 200)
    photo, sky = layered(near, [example(60 + 40 * k, 90, 180) for k in range(others)], rng)
    assert photo.shape == (ROWS, COLUMNS, 3)
    assert photo.min() >= 0
    assert photo.max() <= 1
    assert (np.diff(sky, axis=0) <= 1e-6).all()  # nowhere sky below terrain


def test_terrain_stays_and_the_sky_is_another():
    rng = np.random.default_rng(3)
    near, other = example(200, 40, 200), example(380, 90, 10)
    for _ in range(20):
        photo, sky = layered(near, [other], rng)
        assert sky[-1].max() == 0
        assert photo[sky > 0.99].max() < 0.35  # the other one's sky is dark


def test_ridges_behind_are_terrain_too():
    rng = np.random.default_rng(1)
    near, far = example(300, 40, 200), example(120, 20, 200)
    rows = [layered(near, [far], rng)[1].sum(axis=0).mean() for _ in range(30)]
    assert min(rows) < 200
    assert max(rows) == pytest.approx(ROWS * 300 / 384, abs=80)


def test_two_flat_tones_differ_and_keep_the_line():
    rng = np.random.default_rng(0)
    sky = example(150, 40, 200).sky.astype(np.float32) / 255
    for _ in range(30):
        photo, same = flat(sky, rng)
        assert same is sky
        assert np.ptp(photo[:150], axis=(0, 1)).max() == 0
        assert np.ptp(photo[150:], axis=(0, 1)).max() == 0
        assert np.abs(photo[149] - photo[150]).max() > 0.09
