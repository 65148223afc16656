"""Trees of the renderer that stand near: conifers, round crowns and bare trees."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import mix, ramp
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.picture import Picture, Window
from skyline_viz.rendering.terrain import Colour, Light, tint


@dataclass(frozen=True)
class Trees:
    """Single trees; each stands on the terrain that has been drawn."""

    shape: Literal["conifer", "crown", "bare"]
    count: int
    base: float
    """Row of their feet, as a share of the photo's height."""

    height: float
    """Height of the largest, as a share of the photo's height."""

    left: float = 0.0
    """Where they begin, as a share of the width."""

    right: float = 1.0
    haze: float = 0.0
    """Share of air light."""

    dark: Colour = (0.018, 0.030, 0.012)
    pale: Colour = (0.085, 0.105, 0.035)


@dataclass(frozen=True)
class Branches:
    """Leaves that hang into the photo from above; they do not move the line."""

    side: float
    """-1 for the left upper corner, 1 for the right one."""

    reach: float
    """How far they reach, as a share of the width and of the height."""

    dark: Colour = (0.015, 0.022, 0.010)


@dataclass(frozen=True)
class _Tree:
    x: float
    base: float
    height: float
    chance: float


def draw_trees(
    picture: Picture, noise: Noise, rng: np.random.Generator, spec: Trees, light: Light
) -> None:
    """Draw trees, the near and large ones last."""
    frame = picture.frame
    dice = rng.random((spec.count, 4)).tolist()
    trees = []
    for place, size, shift, chance in sorted(dice, key=lambda one: one[1]):
        x = (spec.left + (spec.right - spec.left) * place) * frame.across
        height = spec.height * frame.down * (0.45 + 0.55 * size)
        base = picture.root(x, (spec.base + 0.03 * (shift + size)) * frame.down)
        trees.append(_Tree(x, base, height, chance))
    for tree in trees:  # once all have their places: none stands on the top of another
        _draw(picture, noise, spec, light, tree)


def draw_branches(picture: Picture, noise: Noise, spec: Branches, light: Light) -> None:
    """Draw leaves that hang from above."""
    window, frame = picture.everywhere(), picture.frame
    edge = frame.across * (0.5 + 0.5 * spec.side)
    far: F32 = np.abs(window.x - np.float32(edge)) / np.float32(frame.across * spec.reach)
    low: F32 = window.y / np.float32(frame.down * spec.reach)
    twigs = noise.fractal(window.x, window.y, frame.down * 0.2, frame.down * 0.03)
    leaves = noise.fractal(window.x, window.y, frame.down * 0.035, 2 / window.unit, gain=0.8)
    share = ramp(0.0, 0.12, 0.75 - far - low * 0.8 + twigs * 0.9 + leaves * 1.1)
    share *= ramp(1.0, 0.9, np.maximum(far * 0.7, low * 0.8))
    lit = np.clip(0.4 + leaves, 0, 1.2)[..., None]
    colour = tint(spec.dark) * (1 + lit) * (tint(light.skylight) + lit * tint(light.sunlight))
    window.picture.paint(share, colour, "thing")


def _draw(picture: Picture, noise: Noise, spec: Trees, light: Light, tree: _Tree) -> None:
    reach = tree.height * (0.3 if spec.shape == "conifer" else 0.62)
    window = picture.window(
        tree.x - reach, tree.base - tree.height * 1.1, tree.x + reach, tree.base
    )
    if window.empty:
        return
    if spec.shape == "conifer":
        share, lit = _conifer(window, noise, tree)
    elif spec.shape == "crown":
        share, lit = _crown(window, noise, tree)
    else:
        share, lit = _bare(window, noise, tree)
    side = (window.x - tree.x) / np.float32(reach) * np.sign(light.sun[0])
    lit = np.clip(lit + side * 0.35, 0, 1.3)
    albedo = mix(tint(spec.dark), tint(spec.pale), lit[..., None])
    brightness = tint(light.skylight) + lit[..., None] * tint(light.sunlight)
    colour = mix(albedo * brightness, tint(light.haze), spec.haze)
    window.picture.paint(share, colour, "terrain")


def _conifer(window: Window, noise: Noise, tree: _Tree) -> tuple[F32, F32]:
    x, y = window.x - np.float32(tree.x), window.y
    down: F32 = (y - (tree.base - tree.height)) / np.float32(tree.height)
    smallest = 2 / window.unit
    tiers = down * (9 + 7 * tree.chance) + noise.smooth(window.x, y, tree.height * 0.09) * 0.8
    layer = tiers - np.floor(tiers)
    ragged = noise.fractal(window.x, y * 1.6, tree.height * 0.1, smallest, gain=0.7)
    wide = tree.height * (0.13 + 0.07 * tree.chance)
    half: F32 = np.clip(down * 1.1, 0, 1) * (0.62 + 0.38 * layer + ragged * 0.5) * wide
    half = half * ramp(1.0, 0.93, down) + np.float32(tree.height * 0.014)
    depth = np.minimum(half - np.abs(x), down * np.float32(tree.height))
    return window.share(depth), layer * 0.4 + ragged * 0.5


def _crown(window: Window, noise: Noise, tree: _Tree) -> tuple[F32, F32]:
    x, y = window.x - np.float32(tree.x), window.y
    size = tree.height
    smallest = 2 / window.unit
    middle = tree.base - size * 0.6
    off = x / np.float32(size * (0.32 + 0.14 * tree.chance))
    lift = (y - middle) / np.float32(size * 0.4)
    clumps = noise.billows(window.x, y, size * 0.3, size * 0.08)
    leaves = noise.fractal(window.x, y, size * 0.06, smallest, gain=0.8)
    density = 1 - off * off - lift * lift + (clumps - 0.45) * 0.9 + leaves * 0.7
    trunk = size * (0.02 + 0.02 * tree.chance)
    share = np.maximum(
        ramp(0.0, 0.12, density), window.box(tree.x - trunk, middle, tree.x + trunk, tree.base)
    )
    return share, np.clip(0.35 - lift * 0.3 + (clumps - 0.5) * 0.7 + leaves * 0.4, 0, 1)


def _bare(window: Window, noise: Noise, tree: _Tree) -> tuple[F32, F32]:
    x, y = window.x - np.float32(tree.x), window.y
    size = tree.height
    down: F32 = (y - (tree.base - size)) / np.float32(size)
    bend = noise.fractal(window.x, y, size * 0.3, size * 0.05) * (size * 0.05)
    trunk = np.float32(size * 0.028) * np.clip(down * 1.4, 0.1, 1)
    share = window.share(trunk - np.abs(x + bend * 0.6))
    for k in range(9):
        start = 0.12 + 0.07 * k
        lean = (0.8 + 0.06 * k) * (1 if k % 2 else -1)
        along = (np.float32(start) - down) * np.float32(size)  # upwards from where it leaves
        course = x - along * np.float32(lean) + bend * 1.4
        thick = np.float32(size * 0.009) * ramp(start - 0.22 - 0.02 * k, start, down)
        twig = window.share(thick - np.abs(course) * 0.7) * (along > 0) * (thick > 0)
        share = np.maximum(share, twig)
    return share, np.full_like(share, 0.3)
