"""What people put into the renderer's landscapes: houses, masts and wires."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import mix
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.picture import Picture, Window
from skyline_viz.rendering.terrain import Colour, Light, tint

_WALLS = ((0.62, 0.58, 0.50), (0.30, 0.19, 0.11), (0.48, 0.24, 0.16), (0.70, 0.70, 0.68))
_ROOFS = ((0.30, 0.10, 0.06), (0.13, 0.13, 0.14), (0.22, 0.16, 0.12), (0.72, 0.73, 0.75))
_METAL = (0.16, 0.16, 0.17)


@dataclass(frozen=True)
class Houses:
    """Houses that stand on the terrain that has been drawn, and count as terrain."""

    count: int
    base: float
    """Row of their feet, as a share of the photo's height."""

    size: float
    """Width of the largest, as a share of the photo's height."""

    towers: int = 0
    """How many of them are churches with a pointed tower."""

    flat: bool = False
    """Blocks with flat roofs, as in towns."""

    lamps: float = 0.0
    """Share of the windows that are lit."""

    haze: float = 0.0


@dataclass(frozen=True)
class Wires:
    """Wires across the photo, in front of all, with the masts that carry them."""

    top: float
    """Row where the highest is hung up, as a share of the height."""

    count: int = 3
    gap: float = 0.03
    """From one to the next, as a share of the height."""

    sag: float = 0.05
    slope: float = 0.0
    """Rows by which they fall from the left to the right, as a share of the height."""

    thick: float = 1.1
    """In reference pixels."""

    masts: int = 0
    """How many masts are in the photo; they hide the line, and do not move it."""


Built: TypeAlias = Houses | Wires


def draw_built(
    picture: Picture, noise: Noise, rng: np.random.Generator, spec: Built, light: Light
) -> None:
    """Draw something that people have put there."""
    match spec:
        case Houses():
            _houses(picture, noise, rng, spec, light)
        case Wires():
            _wires(picture, rng, spec, light)


def _houses(
    picture: Picture, noise: Noise, rng: np.random.Generator, spec: Houses, light: Light
) -> None:
    frame = picture.frame
    for k in range(spec.count):
        place, scale, shift, tall = rng.random(4).tolist()
        wall, roof = _WALLS[int(rng.integers(4))], _ROOFS[int(rng.integers(4))]
        x = (k + place) / spec.count * frame.across
        wide = spec.size * frame.down * (0.5 + 0.5 * scale)
        high = wide * (0.9 + 2.2 * tall * tall if spec.flat else 0.45 + 0.3 * tall)
        base = picture.root(x, (spec.base + 0.04 * shift) * frame.down)
        tower = k < spec.towers
        if tower:
            wide, high = wide * 0.45, wide * 1.6
        peak = base - high * (1 if spec.flat else 2.2)
        window = picture.window(x - wide, peak - 4, x + wide, base)
        if window.empty:
            continue
        left, right, eaves = x - wide / 2, x + wide / 2, base - high
        stain = noise.fractal(window.x, window.y, 12, 2 / window.unit)
        sunny = 0.75 if (light.sun[0] > 0) == (shift > 0.5) else 0.2
        _surface(window, window.box(left, eaves, right, base), wall, sunny, stain, light, spec.haze)
        _windows(window, rng, spec, (left, eaves, right, base))
        if not spec.flat:
            over = wide * 0.06
            if tower:
                corners = ((x, eaves - wide * 1.8), (right + over, eaves), (left - over, eaves))
                roofed = window.polygon(*corners)
            else:
                inset = wide * (0.5 if tall > 0.5 else 0.12)
                ridge = eaves - high * (0.7 + 0.4 * scale)
                roofed = window.polygon(
                    (left - over + inset, ridge),
                    (right + over - inset, ridge),
                    (right + over, eaves + 1),
                    (left - over, eaves + 1),
                )
            _surface(window, roofed, roof, 1 - sunny, stain, light, spec.haze)


def _surface(
    window: Window,
    share: F32,
    albedo: Colour,
    sunny: float,
    stain: F32,
    light: Light,
    haze: float,
) -> None:
    """Paint a flat side of something that counts as terrain."""
    brightness = tint(light.skylight) + tint(light.sunlight) * np.float32(sunny)
    colour = tint(albedo) * brightness * (1 + stain * 0.25)[..., None]
    window.picture.paint(share, mix(colour, tint(light.haze), haze), "terrain")


def _windows(
    window: Window,
    rng: np.random.Generator,
    spec: Houses,
    wall: tuple[float, float, float, float],
) -> None:
    left, top, right, bottom = wall
    columns = 3 + int(rng.integers(3))
    floors = max(1, int((bottom - top) / ((right - left) * 0.32)))
    lamps = (rng.random((columns, floors)) < spec.lamps).tolist()
    step, storey = (right - left) / columns, (bottom - top) / floors
    for i in range(columns):
        for j in range(floors):
            x, y = left + (i + 0.3) * step, top + (j + 0.25) * storey
            pane = window.box(x, y, x + step * 0.4, y + storey * 0.45)
            colour = tint((1.0, 0.68, 0.25)) if lamps[i][j] else tint((0.03, 0.035, 0.045))
            window.picture.paint(pane * np.float32(1 - spec.haze), colour, "terrain")


def _wires(picture: Picture, rng: np.random.Generator, spec: Wires, light: Light) -> None:
    frame, window = picture.frame, picture.everywhere()
    metal = tint(_METAL) * (tint(light.skylight) + tint(light.sunlight) * 0.3)
    span = frame.across / max(spec.masts, 0.8)
    start = (rng.random() - 0.5) * span
    part = (window.x - np.float32(start)) / np.float32(span)
    part = part - np.floor(part)
    fall = spec.slope * frame.down * window.x / np.float32(frame.across)
    for k in range(spec.count):
        top = (spec.top + spec.gap * k) * frame.down
        course = top + fall + part * (1 - part) * np.float32(4 * spec.sag * frame.down)
        steep = np.float32(spec.sag * 4 * frame.down / span) * (1 - 2 * part)
        slant = np.sqrt(1 + steep * steep)
        half = np.float32(max(spec.thick, 0.7 / frame.unit) / 2)
        share = window.share(half - np.abs(window.y - course) / slant)
        # So thin a thing is not noted as hiding anything: the line goes on behind it.
        picture.photo[:] = mix(picture.photo, metal, (share * 0.9)[..., None])
    for k in range(spec.masts):
        x = start + (k + (start < 0)) * span
        top = spec.top * frame.down + spec.slope * frame.down * x / frame.across
        wide = frame.down * 0.007
        arm = frame.down * 0.03
        share = window.box(x - wide, top - arm * 0.4, x + wide, frame.down + 1)
        for j in range(spec.count):
            y = top + spec.gap * j * frame.down
            share = np.maximum(share, window.box(x - arm, y - 1.4, x + arm, y + 1.4))
        picture.paint(share, metal, "thing")
