"""Mountain ranges of the renderer, seen from so far that near and far parts are equally large."""

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import box_blur, enlarge, mix, ramp, slopes
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

_SNOW = (0.86, 0.88, 0.91)
_TREES = ((0.030, 0.045, 0.018), (0.075, 0.090, 0.030))


@dataclass(frozen=True)
class Range:
    """A mountain range and how it stands in the photo."""

    top: float
    """Row of its highest point, as a share of the photo's height."""

    relief: float
    """Height of its highest peak above its foot, in reference pixels."""

    cover: Cover
    peaks: int = 9
    steep: float = 0.6
    """Slope of the peaks: height over distance."""

    ridges: float = 1.0
    """Strength of the ridges that run off the peaks."""

    gullies: float = 1.0
    """Depth of the gullies in the slopes."""

    rough: float = 1.0
    """Height of boulders and ledges, in reference pixels."""

    towers: float = 0.0
    """Height of walls and needles, in reference pixels."""

    trees: float = 0.0
    """Height of trees, in reference pixels."""

    tilt: float = 0.22
    """Rows by which a point moves up for each reference pixel that it lies farther away."""

    haze: float = 0.1
    """Share of air light, 0 to 1, at the height of the peaks."""

    mist: float = 0.1
    """What the foot has of it in addition."""

    fade: float = 0.0
    """How much the haze varies from place to place along the range."""

    lean: float = 0.0
    """Height lost from the left edge to the right, as a share of the relief."""

    mesa: float = 0.0
    """Share of the height that is gathered into one wall below a flat top."""

    snow: float = 0.62
    """Height of the snow line, as a share of the relief."""


@dataclass(frozen=True)
class _Site:
    """Where the samples of a range are."""

    spec: Range
    noise: Noise
    x: F32
    """``(1, W)`` to the right, in reference pixels."""

    y: F32
    """``(N, 1)`` away from the viewer."""

    steps: tuple[float, float]
    """How far apart they are, along x and y."""

    def thinned(self, stride: int) -> "_Site":
        """One of `stride` samples in each direction."""
        steps = (self.steps[0] * stride, self.steps[1] * stride)
        return _Site(self.spec, self.noise, self.x[:, ::stride], self.y[::stride], steps)

    @property
    def smallest(self) -> float:
        """Size of the smallest bump that the pixels resolve."""
        return 1.6 * self.steps[0]


def mountain_range(
    frame: Frame, noise: Noise, rng: np.random.Generator, spec: Range, light: Light
) -> Terrain:
    """Build, light and clothe a range of mountains."""
    unit = frame.unit
    steps = (1 / unit, 1 / (unit * 0.9))
    x = (np.arange(frame.width) * steps[0]).astype(np.float32)[None, :]
    depth = spec.relief / spec.steep * 1.45
    # Where the photo reaches far below the foot, there is a valley floor before it, down to what
    # hides it or, for a range close by, to the lower edge.
    bottom = 1.05 if spec.top > 0.6 else 0.72
    floor = (frame.down * (bottom - spec.top) - spec.relief) / spec.tilt
    floor = min(max(floor, 0.0), 2.5 * spec.relief)
    count = max(16, int((floor + depth) / steps[1]))
    y = (np.arange(count) * steps[1] - floor).astype(np.float32)[:, None]
    site = _Site(spec, noise, x, y, steps)
    site, height = _shape(frame, rng, site)
    altitude: F32 = height / spec.relief
    x_slope, y_slope = slopes(box_blur(height, max(1, round(unit))), steps)
    steepness = np.sqrt(x_slope * x_slope + y_slope * y_slope + 1)
    upright: F32 = (1 / steepness).astype(np.float32, copy=False)
    boulders = noise.fractal(x, site.y, 14, site.smallest, gain=0.45) * spec.rough
    height = height + boulders * (ramp(1.0, 0.6, upright) + 0.3)
    level: F32 = (height - box_blur(height, max(2, round(unit * 9)))) * np.float32(0.11)
    albedo = _cover(site, height, upright, level)
    if spec.trees:
        height = _plant(site, height, altitude, upright, albedo)
    colour: F32 = albedo * lighting(height, x, steps, light, level)
    share = ramp(0.75, 0.0, altitude) * spec.mist + spec.haze
    if spec.fade:
        share += noise.smooth(x, site.y * 0.1, 260) * spec.fade
    colour = mix(colour, tint(light.haze), np.clip(share, 0, 1)[..., None])
    rows: F32 = (height + site.y * spec.tilt) * np.float32(-unit)
    rows += spec.top * frame.height - rows.min()
    # Whatever lies below the near edge shows as mist.
    edge = [box_blur(colour[:1, :, channel], round(25 * unit))[0] for channel in range(3)]
    colour[0] = mix(np.stack(edge, axis=1), tint(light.haze), 0.4)
    return Terrain(rows, colour)


def _shape(frame: Frame, rng: np.random.Generator, site: _Site) -> tuple[_Site, F32]:
    """Heights without the finest detail, of the samples that can be seen."""
    spec, noise = site.spec, site.noise
    stride = max(1, int(spec.relief / 100 / site.steps[0]))  # there is nothing fine in it yet
    thin = site.thinned(stride)
    coarse = _massif(frame, rng, thin)
    first, last = _in_view(frame, spec, coarse, thin.y)
    site = _Site(spec, noise, site.x, site.y[first * stride : last * stride], site.steps)
    height = enlarge(coarse[first:last], (len(site.y), frame.width), stride)
    if spec.mesa:
        share: F32 = height / spec.relief
        table = ramp(0.02, 0.45, share) * 0.25
        table += ramp(0.38, 0.46, share) * (0.5 + 0.12 * rng.random())
        table += noise.smooth(site.x, site.y * 0.1, 330) * 0.07
        height = mix(height, table * spec.relief, spec.mesa)
    if spec.towers:
        height += _towers(site, height)
    return site, _gullies(site, height)


def _massif(frame: Frame, rng: np.random.Generator, site: _Site) -> F32:
    """Peaks in a loose row, bent by noise, with ridges running off them."""
    spec, noise, x, y = site.spec, site.noise, site.x, site.y
    size = spec.relief
    depth = float(y[-1, 0])
    x_bent: F32 = x + noise.fractal(x, y, size, size / 4) * (size * 0.3)
    y_bent: F32 = y + noise.fractal(x, y, size, size / 4) * (size * 0.3)
    height: F32 = noise.fractal(x, y, size, size / 8) * (size * 0.12)
    for k in range(spec.peaks):
        place = (k + rng.random()) / spec.peaks * 1.16 - 0.08
        peak = size * (0.5 + 0.5 * rng.random()) * (1 - spec.lean * place)
        x_off: F32 = x_bent - place * frame.across
        x_off = np.where(x_off > 0, np.float32(0.75 + 0.5 * rng.random()), np.float32(1)) * x_off
        y_off: F32 = y_bent - depth * (0.6 + 0.28 * rng.random())
        distance = np.sqrt(x_off * x_off + y_off * y_off + size * size / 900)
        height = _blend(height, peak - distance * np.float32(spec.steep), size / 14)
    ridges = noise.ridged(x_bent, y_bent, size * 0.8, size / 9, gain=0.42)
    height += (ridges - 0.4) * (size * 0.2 * spec.ridges)
    # The near edge dips, so that it is not seen where a valley lies before the range.
    return height - ramp(depth * 0.5, 0, y) * (size * 0.25)


def _blend(first: F32, second: F32, softness: float) -> F32:
    """Maximum of two, rounded where they meet."""
    t: F32 = np.clip((first - second) / softness * 0.5 + 0.5, 0, 1)
    return mix(second, first, t) + softness * t * (1 - t)


def _in_view(frame: Frame, spec: Range, height: F32, y: F32) -> tuple[int, int]:
    """First and last of the rows of samples that can appear in the photo; the rest is waste."""
    rise: F32 = height + y * spec.tilt
    rise -= rise.max()
    spare = spec.relief * 0.12
    above = np.flatnonzero(rise.max(axis=1) > (spec.top - 1) * frame.down - spare)
    covered = np.maximum.accumulate(rise, axis=0) - (spare + spec.towers)
    seen = np.flatnonzero((rise > covered).any(axis=1))
    first = max(0, min(int(above[0]), len(y) - 8))
    return first, max(int(seen[-1]) + 1, first + 8)


def _gullies(site: _Site, height: F32) -> F32:
    """Cut gullies down the slopes, large ones first, then small ones into their sides."""
    size, strength = site.spec.relief * 0.26, 0.09 * site.spec.gullies
    while size > max(7.0, 7 * site.steps[0]):
        stride = max(1, int(size / 8 / site.steps[0]))  # wide waves need few samples
        thin = site.thinned(stride)
        x_slope, y_slope = slopes(np.ascontiguousarray(height[::stride, ::stride]), thin.steps)
        slope = np.sqrt(x_slope * x_slope + y_slope * y_slope)
        waves = site.noise.gullies(thin.x, thin.y, (x_slope, y_slope), size)
        waves *= ramp(0.1, 0.7, slope) * (size * strength)
        height = height + enlarge(waves, height.shape, stride)
        size *= 0.5
        strength *= 0.88
    return height


def _towers(site: _Site, height: F32) -> F32:
    """Walls and needles on the upper slopes."""
    size, noise, x = site.spec.towers, site.noise, site.x
    y: F32 = site.y * 0.7
    high = ramp(0.3, 0.62, height / site.spec.relief)
    total = ramp(0.38, 0.47, noise.ridged(x, y, size * 1.7, size / 6, gain=0.35)) * 0.5
    total += ramp(0.50, 0.60, noise.ridged(x, y, size * 0.8, size / 8, gain=0.35)) * 0.4
    total += ramp(0.1, 0.3, noise.fractal(x, y, size * 0.22, size / 12)) * 0.12
    return high * total * np.float32(size)


def _cover(site: _Site, height: F32, upright: F32, level: F32) -> F32:
    """Albedo ``(N, W, 3)``: rock, with plants below and snow above where it is not too steep.

    `upright` is 1 on level ground and 0 on walls; `level` is below 0 in hollows.
    """
    spec, noise, x, smallest = site.spec, site.noise, site.x, site.smallest
    patches = noise.fractal(x, site.y, 90, smallest, gain=0.62)
    # The grain of rock is seen on the face of a wall, where depth alone would draw it out.
    face: F32 = site.y * 0.5 + height
    grain = noise.fractal(x, face, 11, smallest, gain=0.75)
    altitude: F32 = height / spec.relief
    dark, pale = (tint(colour) for colour in ROCK[spec.cover])
    albedo = mix(dark, pale, np.clip(0.45 + patches * 0.8 + grain * 0.8, 0, 1.3)[..., None])
    size = 13.0
    while size > 3 * smallest:
        crack = np.abs(noise.smooth(x + grain * 2, face * 0.4 + patches * 3, size))
        albedo *= (1 - ramp(0.16, 0.0, crack) * 0.38)[..., None]
        size *= 0.47
    bands = noise.smooth(x * 0.08, height + patches * 9, 6)
    albedo *= (1 + bands * 0.2)[..., None]
    if spec.cover in PLANTS:
        grass, shrub = (tint(colour) for colour in PLANTS[spec.cover])
        green = mix(grass, shrub, ramp(-0.15, 0.25, patches + grain * 0.4 - level * 0.4)[..., None])
        limit = 0.62 if spec.cover in ("alpine", "rock") else 1.3
        where = ramp(0.56, 0.72, upright + patches * 0.22)
        where *= ramp(limit, limit - 0.22, altitude + patches * 0.3)
        albedo = mix(albedo, green, where[..., None])
    if spec.cover in ("alpine", "snow"):
        steepest = 0.44 if spec.cover == "snow" else 0.56
        hold = upright + patches * 0.14 - level * 0.3 + grain * 0.14
        where = ramp(steepest, steepest + 0.08, hold)
        where *= ramp(spec.snow - 0.08, spec.snow + 0.1, altitude + patches * 0.2)
        albedo = mix(albedo, tint(_SNOW), where[..., None])
    return albedo


def _plant(site: _Site, height: F32, altitude: F32, upright: F32, albedo: F32) -> F32:
    """Height with trees, whose colour goes into `albedo`: pointed crowns, none on steep rock."""
    spec, noise = site.spec, site.noise
    inside, chance = noise.mounds(site.x, site.y, spec.trees * 0.62, 0.9)
    clumps = noise.fractal(site.x, site.y, spec.trees * 12, spec.trees)
    limit = 0.5 if spec.cover == "alpine" else 1.6
    wooded = ramp(limit, limit - 0.25, altitude + clumps * 0.3)
    wooded *= ramp(0.40, 0.52, upright + clumps * 0.1)
    shade: F32 = np.clip(chance * 0.7 + clumps + 0.1, 0, 1)
    green = mix(tint(_TREES[0]), tint(_TREES[1]), shade[..., None])
    crown: F32 = np.minimum(ramp(0.0, 0.25, inside) * wooded * 1.5, 1)
    albedo[:] = mix(albedo, green, crown[..., None])
    crowns: F32 = np.sqrt(inside) * (chance * 0.75 + 0.45) * wooded
    return height + crowns * np.float32(spec.trees)
