"""People before the renderer's landscapes."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.picture import Picture
from skyline_viz.rendering.terrain import Colour, Light, tint

_CLOTHES = (
    (0.03, 0.03, 0.035),
    (0.05, 0.07, 0.14),
    (0.17, 0.14, 0.10),
    (0.40, 0.05, 0.04),
    (0.05, 0.16, 0.30),
    (0.52, 0.50, 0.46),
)
_HAIR = ((0.02, 0.015, 0.012), (0.08, 0.05, 0.025), (0.35, 0.24, 0.10), (0.35, 0.05, 0.05))
_SKIN = (0.42, 0.25, 0.17)
_TABLES = (_CLOTHES, _CLOTHES[:3], _HAIR)
"""Colours of coats, trousers and hair."""

_Rod: TypeAlias = tuple[float, float, float, float, float, float]
"""``(x, y, x, y, radius, radius)`` of both ends, in shares of the height, y above the feet."""


@dataclass(frozen=True)
class People:
    """People in front of all; they hide the line, and do not move it."""

    count: int
    height: float
    """As a share of the photo's height."""

    base: float = 1.0


def draw_people(
    picture: Picture, noise: Noise, rng: np.random.Generator, spec: People, light: Light
) -> None:
    """Draw people, in no order."""
    for _ in range(spec.count):
        _person(picture, noise, rng, spec, light)


def _person(
    picture: Picture, noise: Noise, rng: np.random.Generator, spec: People, light: Light
) -> None:
    frame = picture.frame
    place, scale, lean, pose = rng.random(4).tolist()
    cloth, legs, hair = (table[int(rng.integers(len(table)))] for table in _TABLES)
    sack = _CLOTHES[int(rng.integers(len(_CLOTHES)))]
    high = spec.height * frame.down * (0.85 + 0.15 * scale)
    x, foot = place * frame.across, (spec.base + 0.03 * scale) * frame.down
    window = picture.window(x - high * 0.4, foot - high * 1.05, x + high * 0.4, foot + 4)
    if window.empty:
        return
    folds = noise.fractal(window.x, window.y, high * 0.09, 2 / window.unit)
    side = (window.x - np.float32(x)) / np.float32(high * 0.15) * np.sign(light.sun[0])
    lit = np.clip(0.35 + 0.3 * lean + side * 0.25 + folds * 0.3, 0.05, 1.2)[..., None]
    brightness = tint(light.skylight) * 1.1 + tint(light.sunlight) * lit

    def part(colour: Colour, *rods: _Rod) -> None:
        for x0, y0, x1, y1, thick, thin in rods:
            start, end = (x + x0 * high, foot - y0 * high), (x + x1 * high, foot - y1 * high)
            share = window.limb(start, end, (thick * high, thin * high))
            window.picture.paint(share, tint(colour) * brightness, "thing")

    bend, hand = 0.03 + 0.05 * pose, 0.74 if pose > 0.75 else 0.44
    part(legs, (-0.05, 0.48, -0.07 - bend / 2, 0.0, 0.055, 0.035))
    part(legs, (0.05, 0.48, 0.06 + bend / 2, 0.0, 0.055, 0.035))
    if lean > 0.5:  # a rucksack
        part(sack, (0.0, 0.76, 0.0, 0.58, 0.14, 0.14))
    for s in (-1, 1):
        elbow = (s * (0.16 + bend), 0.63)
        part(cloth, (s * 0.11, 0.78, *elbow, 0.042, 0.035))
        part(cloth, (*elbow, s * (0.13 + 2 * bend), hand, 0.035, 0.026))
    part(cloth, (-0.065, 0.77, 0.065, 0.77, 0.055, 0.055), (0.0, 0.74, 0.0, 0.5, 0.11, 0.095))
    part(_SKIN, (0.0, 0.87, 0.0, 0.82, 0.028, 0.03), (0.0, 0.93, 0.0, 0.905, 0.055, 0.048))
    part(hair, (-0.02, 0.955, 0.02, 0.955, 0.047, 0.047))
