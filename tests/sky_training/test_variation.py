"""Variations of an example."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.sky_training.examples import COLUMNS, ROWS
from skyline_viz.sky_training.variation import varied
from testing.examples import examples


@examples(40)
@given(seed=st.integers(0, 10**6))
def test_a_variation_keeps_to_its_size_and_range(seed):
    rng = np.random.default_rng(seed)
    photo = rng.random((ROWS, COLUMNS, 3)).astype(np.float32)
    sky = np.repeat((np.arange(ROWS) < 150)[:, None], COLUMNS, axis=1).astype(np.float32)
    seen, share = varied((photo, sky), (192, 128), rng)
    assert seen.shape == (192, 128, 3)
    assert share.shape == (192, 128)
    assert seen.dtype == share.dtype == np.float32
    assert seen.min() >= 0
    assert seen.max() <= 1
    assert share.min() >= -1e-6
    assert share.max() <= 1 + 1e-6


def test_the_sky_moves_with_the_photo():
    """White sky over black terrain: whatever the view, bright is sky."""
    agree = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        sky = np.repeat((np.arange(ROWS) < 190)[:, None], COLUMNS, axis=1).astype(np.float32)
        photo = np.repeat(sky[..., None], 3, axis=2)
        seen, share = varied((photo, sky), (192, 128), rng)
        grey = seen.mean(axis=2)
        middle = slice(64, 128)  # bars lie at the rims
        agree.append(((grey > (grey.min() + grey.max()) / 2) == (share > 0.5))[middle].mean())
    assert np.median(agree) > 0.97
