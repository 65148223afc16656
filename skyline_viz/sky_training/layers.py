"""New photos out of old ones: another sky, and pale ridges behind a near one.

A model that saw each terrain under one sky only learns which photo it is. What it has to know is
that a ridge is a ridge under any sky, and that the far, pale one behind a near, strong one counts.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from skyline_viz.arrays import F32, U8
from skyline_viz.sky_training.examples import COLUMNS, ROWS, Example

Layers = tuple[F32, F32]
"""Photo ``(ROWS, COLUMNS, 3)`` and sky ``(ROWS, COLUMNS)``, both in [0, 1]."""

LEAST_SKY = 0.12
"""Share of a photo's height that is sky in all columns, for this sky to serve elsewhere."""


def layered(near: Example, others: Sequence[Example], rng: np.random.Generator) -> Layers:
    """The terrain of an example with the sky, or also with hazy terrain, of other ones.

    Args:
        near: An example with a skyline.
        others: Examples to take from; those with a skyline lend terrain too.
        rng: What is chosen.
    """
    photo, sky = whole(near)
    drop = 0.0
    if rng.random() < 0.6:  # room above it
        drop = float(rng.uniform(0, 0.35)) * max(ROWS - 1.15 * float(sky.sum(axis=0).max()), 0)
        photo, sky = _lowered(photo, drop), _lowered(sky, drop)
    background, behind = _far(others, rng)
    if rng.random() < 0.5:  # light of the same day
        gain = _mean(background) / np.maximum(_mean(photo), 0.05)
        gain = np.clip(gain, 0.4, 2.0) ** rng.uniform(0, 1)
        photo = np.clip(photo * gain, 0, 1).astype(np.float32)
    soft = sky if rng.random() < 0.5 else cv2.GaussianBlur(sky, (0, 0), rng.uniform(0.5, 1.2))
    mixed = photo * (1 - soft[..., None]) + background * soft[..., None]
    return mixed.astype(np.float32), (sky * behind).astype(np.float32)


def flat(sky: F32, rng: np.random.Generator) -> Layers:
    """Sky and terrain of one tone each, any two that differ: what is above is the sky."""
    above, below = rng.random((2, 3))
    while np.abs(above - below).max() < 0.1:
        below = rng.random(3)
    photo = sky[..., None] * above + (1 - sky[..., None]) * below
    return photo.astype(np.float32), sky


def whole(one: Example) -> Layers:
    """An example as it is."""
    return in_unit(one.photo), in_unit(one.sky)


def in_unit(image: U8) -> F32:
    """Levels of 255 as numbers in [0, 1]."""
    return np.asarray(image.astype(np.float32) / np.float32(255), np.float32)


def _far(others: Sequence[Example], rng: np.random.Generator) -> Layers:
    """What lies behind: a sky, and mostly one or two ranges, ever paler."""
    shuffled = [others[index] for index in rng.permutation(len(others))]
    background = next(
        (found for one in shuffled if (found := _sky_of(one)) is not None),
        np.full((ROWS, COLUMNS, 3), 0.7, np.float32),
    )
    share = np.ones((ROWS, COLUMNS), np.float32)
    ranges = (one for one in shuffled if one.line is not None)
    count = rng.choice([0, 1, 2], p=[0.35, 0.5, 0.15])
    haze = rng.uniform(0.85, 0.96)
    for one, _ in zip(ranges, range(count), strict=False):
        background, share = _with_range(background, share, one, haze, rng)
        haze *= rng.uniform(0.4, 0.9)
    return background, share


def _with_range(
    background: F32, share: F32, one: Example, haze: float, rng: np.random.Generator
) -> Layers:
    """A background with the terrain of an example in front, seen through haze."""
    terrain, sky = whole(one)
    if rng.random() < 0.5:
        terrain, sky = terrain[:, ::-1], sky[:, ::-1]
    drop = rng.uniform(-0.15, 0.25) * ROWS
    terrain, sky = _lowered(terrain, drop), _lowered(sky, drop)
    # haze has the colour of the sky low above the range, mostly a little darker or brighter
    at = np.clip(sky.sum(axis=0).mean() + np.array([-30, 0]), 0, ROWS).astype(int)
    air = background[at[0] : max(at[1], at[0] + 1)].mean(axis=(0, 1))
    tint = rng.normal(0, 0.02, 3) - rng.uniform(0.01, 0.08) * rng.choice([-0.5, 1, 1, 1])
    hazed = terrain * (1 - haze) + np.clip(air + tint, 0, 1).astype(np.float32) * haze
    mixed = hazed * (1 - sky[..., None]) + background * sky[..., None]
    return np.clip(mixed, 0, 1).astype(np.float32), (share * sky).astype(np.float32)


def _sky_of(one: Example) -> F32 | None:
    """The sky of an example stretched over all rows; None where there is too little."""
    rows = int((one.sky > 250).all(axis=1).argmin()) if (one.sky <= 250).any() else ROWS
    if rows < LEAST_SKY * ROWS:
        return None
    stretched = cv2.resize(one.photo[:rows], (COLUMNS, ROWS), interpolation=cv2.INTER_LINEAR)
    return in_unit(stretched)


def _lowered(image: F32, rows: float) -> F32:
    """An image moved down; what comes in repeats its rim."""
    matrix = np.array([[1, 0, 0], [0, 1, rows]], np.float32)
    moved: F32 = cv2.warpAffine(image, matrix, (COLUMNS, ROWS), borderMode=cv2.BORDER_REPLICATE)
    return moved


def _mean(photo: F32) -> float:
    return float(photo.mean())
