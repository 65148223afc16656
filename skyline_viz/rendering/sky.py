"""Skies of the renderer: gradients, veils and heaped clouds."""

from dataclasses import dataclass, replace

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import mix, ramp
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.terrain import Colour, Frame, tint

_VEIL = (0.93, 0.93, 0.94)
_CLOUD_SHADE = (0.40, 0.43, 0.49)
_CLOUD_LIGHT = (1.0, 0.985, 0.96)


@dataclass(frozen=True)
class Sky:
    """Colours of a sky and its clouds."""

    zenith: Colour
    horizon: Colour
    veil: float = 0.0
    """Strength of thin high cloud, 0 to 1."""

    heaps: int = 0
    """Number of heaped clouds."""

    low: float = 0.55
    """Row of the horizon, as a share of the height."""


@dataclass(frozen=True)
class _Canvas:
    """A piece of the photo that is being painted."""

    sky: Sky
    noise: Noise
    photo: F32
    """``(H, W, 3)``."""

    x: F32
    """``(1, W)`` in reference pixels."""

    y: F32
    """``(H, 1)`` in reference pixels, downwards."""

    unit: float
    """Pixels in a reference pixel."""

    sunward: int
    """1 where the sun is on the right, -1 where it is on the left."""

    def cut(self, rows: slice, columns: slice) -> "_Canvas":
        """A smaller piece of it."""
        return replace(self, photo=self.photo[rows, columns], x=self.x[:, columns], y=self.y[rows])

    def cover(self, colour: F32, share: F32) -> None:
        """Paint ``(H, W)`` `share` of `colour` over it."""
        self.photo[:] = mix(self.photo, colour, share[..., None])


def paint_sky(
    frame: Frame, noise: Noise, rng: np.random.Generator, sky: Sky, *, sunward: int
) -> F32:
    """Sky over the whole photo, ``(H, W, 3)``, brighter on the side of the sun, 1 or -1."""
    x = (np.arange(frame.width) / frame.unit).astype(np.float32)[None, :]
    y = (np.arange(frame.height) / frame.unit).astype(np.float32)[:, None]
    fall: F32 = np.clip(y / (frame.down * sky.low), 0, 1)
    fall = fall * (fall * 0.55 + 0.45)
    glow = (x / frame.across - 0.5) * (0.22 * sunward)
    photo = mix(tint(sky.zenith), tint(sky.horizon), np.clip(fall + glow, 0, 1)[..., None])
    canvas = _Canvas(sky, noise, photo, x, y, frame.unit, sunward)
    if sky.veil:
        above = slice(0, round(frame.height * min(1.0, sky.low * 1.12)))
        _veil(canvas.cut(above, slice(None)), frame)
    for k in range(sky.heaps):
        _heap(canvas, frame, rng, (k + rng.random()) / sky.heaps)
    return photo


def _veil(canvas: _Canvas, frame: Frame) -> None:
    """Thin cloud in a flat sheet high above, so that it crowds towards the horizon."""
    below: F32 = np.maximum(frame.down * canvas.sky.low * 1.12 - canvas.y, 30)
    far: F32 = np.divide(np.float32(frame.down), below)
    x: F32 = (canvas.x - frame.across / 2) * far * 0.5 + canvas.y * 0.35
    y: F32 = far * 430
    bend = canvas.noise.fractal(x, y, 300, 40) * 90
    place = (x + bend, (y + bend) * 2.2)
    streaks = canvas.noise.fractal(*place, 260, 1.6 / canvas.unit, gain=0.58)
    canvas.cover(tint(_VEIL), ramp(-0.12, 0.55, streaks) * ramp(12, 3, far) * canvas.sky.veil)


def _heap(canvas: _Canvas, frame: Frame, rng: np.random.Generator, near: float) -> None:
    """One heaped cloud: flat grey base, round heads, bright towards the sun.

    `near` is 0 for a small one far away and 1 for a large one overhead.
    """
    noise, sunward, unit = canvas.noise, canvas.sunward, canvas.unit
    size = frame.down * (0.07 + 0.36 * near * near) * (0.7 + 0.6 * rng.random())
    base = frame.down * canvas.sky.low * (0.93 - 0.72 * near)
    middle = frame.across * (rng.random() * 1.2 - 0.1)
    wide = size * (1.0 + 1.2 * rng.random())
    high = size * (0.5 + 0.3 * rng.random())
    edges = (base - 1.7 * high, base + 0.5 * high, middle - 1.7 * wide, middle + 1.7 * wide)
    top, bottom, left, right = (max(0, round(edge * unit)) for edge in edges)
    canvas = canvas.cut(slice(top, bottom), slice(left, right))
    if 0 in canvas.photo.shape:
        return
    x, y = canvas.x, canvas.y
    x_bent: F32 = x + noise.fractal(x, y, high * 1.2, high * 0.2) * (high * 0.55)
    y_bent: F32 = y + noise.fractal(x, y, high, high * 0.2) * (high * 0.22)
    off: F32 = (x_bent - middle) / wide
    lift: F32 = (base - y_bent) / high
    round_lift = np.where(lift < 0, lift * 5, lift)
    heads = noise.billows(x, y, high * 0.75, 1.8 / unit)
    density: F32 = (1 - off * off - round_lift * round_lift) * 0.8 + (heads - 0.42) * 1.1
    light: F32 = ramp(-0.15, 0.9, lift) * 0.40 + 0.36
    thick: F32 = np.clip(density, -0.2, 1)
    for reach, weight in ((0.02, 0.13), (0.06, 0.21), (0.16, 0.34), (0.4, 0.40)):
        # A head is bright where the cloud gets thinner towards the sun.
        step = max(1, round(reach * high * unit))
        thinner = (density - _shifted(thick, -step, step * sunward)) * 1.5
        light += np.clip(thinner, -1, 1) * weight
    white = mix(tint(_CLOUD_SHADE), tint(_CLOUD_LIGHT), np.clip(light, 0, 1)[..., None])
    canvas.cover(mix(white, tint(canvas.sky.horizon), 0.55 * (1 - near)), ramp(0, 0.25, density))


def _shifted(values: F32, down: int, right: int) -> F32:
    """``values[i + down, j + right]``, edges repeated."""
    height, width = values.shape
    rows = np.clip(np.arange(height) + down, 0, height - 1)
    columns = np.clip(np.arange(width) + right, 0, width - 1)
    return values[rows[:, None], columns]
