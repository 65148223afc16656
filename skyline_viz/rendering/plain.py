"""Open ground of the renderer, in perspective from the viewer's feet to the horizon."""

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import box_blur, mix, ramp
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.terrain import (
    PLANTS,
    ROCK,
    Cover,
    Frame,
    Light,
    Terrain,
    lighting,
    tint,
)

_FOCUS = 720.0  # focal length in reference pixels
_EYE = 60.0  # height of the eye above the ground, in the unit of lengths on the ground
_BUSH = (0.13, 0.12, 0.065)
_CROPS = ((0.10, 0.17, 0.04), (0.30, 0.26, 0.11), (0.24, 0.17, 0.11), (0.15, 0.17, 0.07))
_WOOD = (0.035, 0.055, 0.022)


@dataclass(frozen=True)
class Plain:
    """Open ground."""

    horizon: float
    """Row of the horizon, as a share of the photo's height."""

    cover: Cover
    rocks: float = 0.3
    """How stony it is, 0 to 1."""

    ripples: float = 0.0
    """Height of sand ripples."""

    shrubs: float = 0.0
    """How much of it low bushes cover, 0 to 1."""

    haze: float = 0.5
    """Share of air light at the horizon."""

    fields: float = 0.0
    """Width of its fields, as seen from the air, in the unit of lengths on the ground; 0: none."""


@dataclass(frozen=True)
class _Site:
    """Where the samples are, ``(N, W)`` or ``(N, 1)``, and how finely they are seen."""

    spec: Plain
    noise: Noise
    x: F32
    y: F32
    pixel: F32
    """Width on the ground of a pixel, ``(N, 1)``."""

    blur: F32
    """Size of the smallest thing that is seen, ``(N, 1)``."""

    def fractal(self, size: float, smallest: float, gain: float) -> F32:
        """Fractal noise without what is finer than the pixels that look at it."""
        total: F32 = np.zeros(self.x.shape, np.float32)
        weight = 1.0
        while size >= smallest and self.blur.min() < 0.8 * size:
            seen = ramp(0.8, 0.3, self.blur / size) * weight
            near = slice(0, int((seen > 0).sum()))
            total[near] += self.noise.smooth(self.x[near], self.y[near], size) * seen[near]
            weight *= gain
            size *= 0.5
        return total


def plain(frame: Frame, noise: Noise, spec: Plain, light: Light) -> Terrain:
    """Build, light and clothe open ground."""
    unit = frame.unit
    below = (1 - spec.horizon) * frame.down * 1.15  # beyond the lower edge, for what stands there
    count = max(16, round(below * unit * 1.5))
    drop = (below * (1 - np.arange(count) / count) + 0.4).astype(np.float32)[:, None]
    y: F32 = np.divide(np.float32(_FOCUS * _EYE), drop)
    middle = (np.arange(frame.width) / unit - frame.across / 2).astype(np.float32)[None, :]
    pixel = y / np.float32(_FOCUS * unit)
    length = y * y / np.float32(_FOCUS * _EYE * unit)  # of ground that one row of pixels covers
    x: F32 = middle * y / np.float32(_FOCUS)
    site = _Site(spec, noise, x, y, pixel, np.sqrt(pixel * length))
    height = site.fractal(900, 60, 0.45) * 9 + site.fractal(50, 1, 0.55) * 2.2
    if spec.ripples:
        height += _ripples(site)
    stones = _stones(site, height)
    level = np.clip((height - box_blur(height, max(1, round(3 * unit)))) / (pixel * 6), -1, 1)
    albedo = _cover(site, height, stones)
    y_step = np.gradient(y[:, 0])[:, None].astype(np.float32)
    colour: F32 = albedo * lighting(height, site.x, (pixel, y_step), light, level)
    colour = mix(colour, tint(light.haze), (ramp(0, 9000, y) * spec.haze)[..., None])
    fall: F32 = np.divide((_EYE - height) * _FOCUS, y)  # below the horizon
    rows: F32 = fall + np.float32(spec.horizon * frame.down)
    return Terrain(rows * np.float32(unit), colour)


def _ripples(site: _Site) -> F32:
    """Waves of sand across the line of sight."""
    bent: F32 = site.y + site.fractal(240, 20, 0.5) * 70
    total: F32 = np.zeros_like(bent)
    for size, height in ((75, 2.2), (19, 0.8)):
        waves = site.noise.smooth(site.x * 0.3, bent, size) * ramp(
            0.9, 0.3, site.blur / np.float32(size)
        )
        total += waves * (height * site.spec.ripples)
    return total


def _stones(site: _Site, height: F32) -> F32:
    """Put stones onto the ground, in place, and tell where they are, 0 to 1."""
    stones: F32 = np.zeros_like(height)
    if not site.spec.rocks:
        return stones
    for size, share in ((19, 0.04), (9, 0.1), (4.5, 0.18), (2.2, 0.25)):
        bend = site.fractal(size * 0.6, size * 0.12, 0.6) * (size * 0.13)
        place = (site.x + bend, site.y - bend)
        inside, chance = site.noise.mounds(*place, size, share * site.spec.rocks)
        inside *= ramp(0.6, 0.25, site.blur / np.float32(size))
        height += np.minimum(inside * (1.2 + chance * 2), 0.4 + chance * 0.5) * (size * 0.36)
        stones = np.maximum(stones, ramp(0.0, 0.1, inside))
    height += site.fractal(6, 0.7, 0.6) * stones * 0.7
    return stones


def _cover(site: _Site, height: F32, stones: F32) -> F32:
    """Albedo ``(N, W, 3)`` of sand, grass, stones and bushes; plants add to `height`, in place."""
    spec = site.spec
    dark, pale = (tint(colour) for colour in ROCK[spec.cover])
    patches = site.fractal(500, 20, 0.6)
    grain = site.fractal(16, 0.5, 0.8)
    albedo = mix(dark, pale, np.clip(0.62 + patches * 0.8 + grain * 0.5, 0, 1)[..., None])
    if spec.cover in PLANTS:
        grass, shrub = (tint(colour) for colour in PLANTS[spec.cover])
        tufts = site.fractal(5, 0.25, 0.9)
        height += tufts * 0.5
        green = mix(grass, shrub, np.clip(0.4 + patches * 0.9 + tufts * 0.6, 0, 1.2)[..., None])
        albedo = mix(albedo, green, ramp(-0.35, -0.05, patches + grain * 0.3)[..., None])
    if spec.fields:
        albedo = _fields(site, patches, grain)
    albedo = mix(albedo, dark * 0.9, (stones * 0.75)[..., None])
    if spec.shrubs:
        for size in (9, 16):
            inside, chance = site.noise.mounds(site.x, site.y, size, 0.8)
            room = patches + chance * 0.5 - site.noise.smooth(site.x, site.y, 30)
            dome = np.sqrt(np.minimum(inside * 2, 1)) * ramp(0.9, 0.3, site.blur / np.float32(size))
            dome *= ramp(0.85, 1.1, room + spec.shrubs)
            height += dome * (1 + grain) * (size * 0.085)
            bush: F32 = tint(_BUSH) * (1 + grain[..., None])
            albedo = mix(albedo, bush, (ramp(0.2, 0.6, dome) * 0.9)[..., None])
    return albedo


def _fields(site: _Site, patches: F32, grain: F32) -> F32:
    """Albedo of fields, hedges and woods."""
    size = site.spec.fields
    bend = patches * size * 0.2
    u: F32 = site.x * 0.8 + site.y * 0.6 + bend
    v: F32 = (site.y * 0.8 - site.x * 0.6 - bend) * 0.55
    crop, wood = site.noise.cells(u, v, size), site.noise.cells(u, v, size * 1.7)
    seen = ramp(1.2, 0.4, site.blur / np.float32(size))
    ripe = mix(tint(_CROPS[0]), tint(_CROPS[1]), crop[..., None])
    ripe = mix(ripe, tint(_CROPS[2]), (ramp(0.6, 0.75, crop) * ramp(1, 0.9, crop))[..., None])
    albedo = mix(tint(_CROPS[3]), ripe, seen[..., None]) * (1 + grain * 0.25)[..., None]
    trees = np.maximum(ramp(0.5, 0.6, wood + patches * 0.6 + grain * 0.1), 0)
    hedge = np.abs(site.noise.smooth(u, v, size * 1.3))
    trees = np.maximum(trees, ramp(0.07, 0.03, hedge + grain * 0.02) * seen)
    return mix(albedo, tint(_WOOD) * (1 + grain * 0.8)[..., None], trees[..., None])
