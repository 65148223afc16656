"""What hangs in the air of the renderer: banks of cloud, overcast, the glow of a low sun, stars."""

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import mix, ramp
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.picture import Picture
from skyline_viz.rendering.terrain import Colour, tint


@dataclass(frozen=True)
class Bank:
    """A bank of cloud or mist with an upper edge like that of a range."""

    top: float
    """Row of its upper edge, as a share of the photo's height."""

    depth: float
    """How far it reaches down, as a share of the height."""

    light: Colour
    shade: Colour
    strength: float = 1.0
    """How much of what is behind it hides, 0 to 1."""

    relief: float = 0.08
    """Height of its heads, as a share of the height."""

    soft: float = 0.02
    """How far its upper edge is spread, as a share of the height."""

    broken: float = 0.0
    """How much of it is gaps, 0 to 1."""


@dataclass(frozen=True)
class Overcast:
    """A sheet of grey cloud over the whole sky."""

    low: float
    """Row of the horizon, as a share of the height."""

    light: Colour
    shade: Colour
    strength: float = 0.9
    """How much of the sky behind it hides, 0 to 1."""

    contrast: float = 1.0
    """How much its light and dark parts differ."""


@dataclass(frozen=True)
class Glow:
    """Light spread around a low sun or moon, which may be in the photo itself."""

    across: float
    """Where it is, as a share of the width."""

    low: float
    """Its row, as a share of the height."""

    colour: Colour
    wide: float = 0.8
    """Half its width, as a share of the photo's width."""

    high: float = 0.2
    """Half its height, as a share of the photo's height."""

    disc: float = 0.0
    """Radius of the sun or moon, in reference pixels."""


@dataclass(frozen=True)
class Stars:
    """Stars in all of the sky."""

    count: int
    bright: float = 0.5


Air = Bank | Overcast | Glow | Stars


def draw_air(picture: Picture, noise: Noise, rng: np.random.Generator, spec: Air) -> None:
    """Draw something that hangs in the air."""
    match spec:
        case Bank():
            _bank(picture, noise, spec)
        case Overcast():
            _overcast(picture, noise, spec)
        case Glow():
            _glow(picture, spec)
        case Stars():
            _stars(picture, rng, spec)


def _bank(picture: Picture, noise: Noise, spec: Bank) -> None:
    down = picture.frame.down
    window = picture.window(
        0,
        (spec.top - spec.relief * 1.6 - spec.soft) * down,
        picture.frame.across + 1,
        (spec.top + spec.depth * 1.6 + spec.relief) * down,
    )
    if window.empty:
        return
    x, y = window.x, window.y
    size = spec.relief * down
    smallest = 2.5 / window.unit
    bend = noise.fractal(x, y, size, smallest) * (size * 0.3)
    heads = noise.billows(x + bend, y, size * 1.4, smallest)
    crest = noise.fractal(x * 0.5, y * 0.2, size * 3, size * 0.5) * size
    lift: F32 = spec.top * down + crest + bend * 0.4 - y  # above 0 outside of the bank
    rise = (heads - 0.45) * (size * 0.7) - lift
    soft = max(spec.soft * down, 0.8 / window.unit)
    lower = ramp(spec.depth * 1.5, spec.depth * 0.4, -lift / np.float32(down))
    share = ramp(-soft, soft, rise) * lower * np.float32(spec.strength)
    if spec.broken:
        gaps = noise.fractal(x * 0.6, y, size * 3, smallest)
        share *= ramp(-0.5, 0.1, gaps + (0.5 - spec.broken))
    lit = ramp(size * 1.4, -size * 0.4, rise) * 0.6 + heads * 0.5
    colour = mix(tint(spec.shade), tint(spec.light), np.clip(lit, 0, 1)[..., None])
    window.picture.paint(share, colour, "air")


def _overcast(picture: Picture, noise: Noise, spec: Overcast) -> None:
    window, down = picture.everywhere(), picture.frame.down
    below: F32 = np.maximum(down * spec.low * 1.15 - window.y, down * 0.05)
    far: F32 = np.divide(np.float32(down), below)
    x: F32 = (window.x - picture.frame.across / 2) * far * 0.4 + window.y * 0.3
    y: F32 = far * 300
    bend = noise.fractal(x, y, 260, 30) * 60
    rolls = noise.billows(x + bend, (y + bend) * 1.6, 330, 2.5 / window.unit)
    broad = noise.fractal(x, y * 1.5, 700, 150)
    lit: F32 = np.clip(0.5 + (rolls - 0.45 + broad * 0.7) * spec.contrast, 0, 1)
    colour = mix(tint(spec.shade), tint(spec.light), lit[..., None])
    share = ramp(-0.4, 0.3, broad + rolls - 0.4 + (spec.strength - 0.5) * 2) * spec.strength
    window.picture.paint(share, colour, "air")


def _glow(picture: Picture, spec: Glow) -> None:
    window, frame = picture.everywhere(), picture.frame
    x, y = spec.across * frame.across, spec.low * frame.down
    off = (window.x - x) / np.float32(spec.wide * frame.across)
    lift = (window.y - y) / np.float32(spec.high * frame.down)
    light: F32 = np.divide(np.float32(1), 1 + off * off + lift * lift)
    photo = picture.photo
    photo += (light * light)[..., None] * tint(spec.colour)
    if spec.disc:
        share = window.disc(x, y, spec.disc)
        photo[:] = mix(photo, np.clip(tint(spec.colour) * 3, 0.8, None), share[..., None])


def _stars(picture: Picture, rng: np.random.Generator, spec: Stars) -> None:
    frame = picture.frame
    places = rng.random((spec.count, 3))
    for across, along, size in places.tolist():
        row, column = int(along * frame.height), int(across * frame.width)
        picture.photo[row, column] += np.float32(spec.bright * size * size * size)
