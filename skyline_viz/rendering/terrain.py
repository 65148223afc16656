"""What all terrain of the renderer shares: its frame, light and colours, and how it is drawn.

Terrain is a grid of samples ``(N, W)``: one column for each column of the photo, and N samples
along each line of sight, from the viewer on. Lengths are in reference pixels, of which a photo of
any size has about 720 by 720. Colours are linear, and 1 is white.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import mix, ramp, slopes

Cover: TypeAlias = Literal["alpine", "forest", "snow", "rock", "desert", "basalt", "heath"]
"""What clothes the ground."""

Colour: TypeAlias = tuple[float, float, float]
"""Linear red, green and blue."""


@dataclass(frozen=True)
class Frame:
    """Size of the photo in pixels."""

    width: int
    height: int

    @property
    def unit(self) -> float:
        """Pixels in a reference pixel."""
        return float(np.sqrt(self.width * self.height)) / 720

    @property
    def across(self) -> float:
        """Width in reference pixels."""
        return self.width / self.unit

    @property
    def down(self) -> float:
        """Height in reference pixels."""
        return self.height / self.unit


@dataclass(frozen=True)
class Light:
    """Where light comes from, and of what colour it is."""

    sun: tuple[float, float, float]
    """Direction to the sun, of length 1: to the right, away from the viewer, up."""

    sunlight: Colour
    skylight: Colour
    haze: Colour
    """What far terrain fades into."""


@dataclass(frozen=True)
class Terrain:
    """What is seen of a piece of terrain."""

    rows: F32
    """``(N, W)`` row at which each sample appears, in pixels."""

    colour: F32
    """``(N, W, 3)`` colour of each sample."""


ROCK: dict[Cover, tuple[Colour, Colour]] = {
    "alpine": ((0.25, 0.23, 0.205), (0.37, 0.35, 0.32)),
    "forest": ((0.13, 0.12, 0.10), (0.21, 0.195, 0.165)),
    "snow": ((0.16, 0.16, 0.165), (0.26, 0.26, 0.265)),
    "rock": ((0.30, 0.255, 0.20), (0.46, 0.41, 0.34)),
    "desert": ((0.36, 0.20, 0.12), (0.50, 0.31, 0.19)),
    "basalt": ((0.16, 0.16, 0.16), (0.30, 0.30, 0.30)),
    "heath": ((0.24, 0.21, 0.17), (0.34, 0.31, 0.26)),
}
"""Dark and pale stone of each cover."""

PLANTS: dict[Cover, tuple[Colour, Colour]] = {
    "alpine": ((0.115, 0.125, 0.045), (0.045, 0.065, 0.025)),
    "forest": ((0.040, 0.058, 0.022), (0.022, 0.036, 0.018)),
    "rock": ((0.13, 0.14, 0.055), (0.05, 0.07, 0.03)),
    "heath": ((0.17, 0.14, 0.055), (0.085, 0.085, 0.032)),
}
"""Grass and shrubs of the covers that have them."""


def tint(colour: Colour) -> F32:
    """Colour as an array ``(3,)``."""
    return np.array(colour, np.float32)


def lighting(
    height: F32, x: F32, steps: tuple[F32 | float, F32 | float], light: Light, level: F32
) -> F32:
    """Light that falls on each sample, ``(N, W, 3)``.

    Args:
        height: ``(N, W)`` height of the ground.
        x: Where the samples are, to the right.
        steps: How far apart they are, to the right and away from the viewer.
        light: Sun and sky.
        level: ``(N, W)`` below 0 in hollows, which see less of the sky, above 0 on ribs.
    """
    x_slope, y_slope = slopes(height, steps)
    east, north, up = light.sun
    facing = np.maximum(up - x_slope * east - y_slope * north, 0)
    facing /= np.sqrt(x_slope * x_slope + y_slope * y_slope + 1)
    # A sample lies in shadow when one towards the sun stands above the ray that reaches it.
    fall = up / abs(east) * 1.15
    ray = height + x * fall if east < 0 else (height - x * fall)[:, ::-1]
    depth = np.maximum.accumulate(ray, axis=1) - ray
    depth = depth if east < 0 else depth[:, ::-1]
    lit: F32 = facing * (1 - ramp(0.5, 7, depth))
    open_sky: F32 = np.clip(level * 0.55 + 0.8, 0.3, 1.25)
    brightness: F32 = lit[..., None] * tint(light.sunlight)
    brightness += open_sky[..., None] * tint(light.skylight)
    return brightness


def project(terrain: Terrain, photo: F32) -> F32:
    """Draw `terrain` over the linear `photo` ``(H, W, 3)``, in place.

    Returns:
        ``(W,)`` row of its outline in pixels, as a real number; pixel r covers r to r + 1.
    """
    height, width = photo.shape[:2]
    count = len(terrain.rows)
    hidden: F32 = np.minimum.accumulate(terrain.rows, axis=0)
    # A pixel shows the first sample that appears at or above its centre. Counting how many
    # samples of a column stay below each row gives the index of that sample in whole numbers.
    starts = np.clip(np.ceil(hidden - np.float32(0.5)), 0, height).astype(np.intp)
    columns = np.arange(width)
    counts = np.bincount((starts * width + columns).ravel(), minlength=(height + 1) * width)
    index = count - np.cumsum(counts.reshape(height + 1, width)[:height], axis=0)
    outline: F32 = hidden[-1]
    first = min(max(0, int(np.floor(outline.min()))), height)
    far = np.minimum(index[first:], count - 1)
    near = np.maximum(far - 1, 0)
    far_row = np.take_along_axis(terrain.rows, far, axis=0)
    near_row = np.take_along_axis(terrain.rows, near, axis=0)
    centre = (np.arange(first, height) + 0.5).astype(np.float32)[:, None]
    part: F32 = np.clip((near_row - centre) / np.maximum(near_row - far_row, 0.01), 0, 1)
    colour = mix(terrain.colour[near, columns], terrain.colour[far, columns], part[..., None])
    share: F32 = np.clip(centre + np.float32(0.5) - outline, 0, 1)  # of the pixel below the outline
    photo[first:] = mix(photo[first:], colour, share[..., None])
    return outline
