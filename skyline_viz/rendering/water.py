"""Water of the renderer: a sea or a lake that mirrors what has been drawn above it."""

from dataclasses import dataclass

import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.rendering.filters import box_blur, mix, ramp
from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.picture import Picture
from skyline_viz.rendering.terrain import Colour, Light, tint


@dataclass(frozen=True)
class Water:
    """Water from a level shore or horizon down to the lower edge of the photo."""

    horizon: float
    """Row of its far edge, as a share of the photo's height."""

    waves: float = 0.5
    """0 for a mirror, 1 for a rough sea."""

    colour: Colour = (0.03, 0.08, 0.11)
    """What comes out of the water itself."""

    haze: float = 0.0
    """Share of air light at its far edge."""


def draw_water(picture: Picture, noise: Noise, spec: Water, light: Light) -> None:
    """Draw water over the lower part of a picture."""
    frame = picture.frame
    edge = np.float32(spec.horizon * frame.height)
    first = min(max(0, int(edge)), frame.height)
    if first == frame.height:
        return
    below = ((np.arange(first, frame.height) + 1 - edge) / frame.unit).astype(np.float32)[:, None]
    below = np.maximum(below, np.float32(0.3 / frame.unit))
    x = (np.arange(frame.width) / frame.unit - frame.across / 2).astype(np.float32)[None, :]
    far: F32 = np.divide(np.float32(frame.down * 0.4), below)
    place = (x * far, far * 420)
    fine = ramp(0.3, 1.0, below * below * np.float32(frame.unit / 60))  # waves that are resolved
    swell = noise.fractal(*place, 150, 30) + noise.fractal(x, below * 5, 26, 5) * 0.5
    chop = noise.fractal(*place, 28, 5, gain=0.7) * fine
    tilt: F32 = (swell * 0.5 + chop) * np.float32(spec.waves)
    # A wave that leans towards the viewer mirrors what is higher up in the sky.
    lift = below * (1 + np.abs(tilt) * 1.6) + np.abs(tilt) * np.float32(60 * spec.waves)
    lift += np.float32(110 * spec.waves * spec.waves) * ramp(0, 40, below)
    # What would be mirrored from above the photo is like the sky in its upper part.
    source = np.abs(np.rint(edge - lift * np.float32(frame.unit)))
    rows = np.clip(source, 0, max(first - 1, 0)).astype(np.intp)
    shift = np.rint(chop * np.float32(spec.waves * 60 * frame.unit)).astype(np.intp)
    columns = np.clip(np.arange(frame.width)[None, :] + shift, 0, frame.width - 1)
    above = picture.photo[: max(first, 1)]
    radius = round(90 * spec.waves * spec.waves * frame.unit)
    if radius:  # many waves in a pixel mirror many places
        blurred = [box_blur(above[..., k] * 64, radius) / np.float32(64) for k in range(3)]
        above = mix(above, np.stack(blurred, axis=2), min(1.0, spec.waves * 1.2))
    mirrored = above[rows, columns]
    depth = ramp(0, frame.down * 0.5, below)
    mirror = np.clip(0.86 - depth * (0.12 + 0.4 * spec.waves) - tilt * 0.5, 0.1, 0.95)
    colour = mix(tint(spec.colour), mirrored, mirror[..., None])
    foam = ramp(0.34, 0.6, tilt) * np.float32(spec.waves * 0.5)
    colour = mix(colour, tint(light.sunlight) * 0.5 + tint(light.skylight), foam[..., None])
    air = ramp(frame.down * 0.25, 0, below) * np.float32(spec.haze)
    colour = mix(colour, tint(light.haze), np.broadcast_to(air, rows.shape)[..., None])
    share: F32 = np.zeros((frame.height, frame.width), np.float32)
    share[first:] = np.clip(np.arange(first, frame.height)[:, None] + 1 - edge, 0, 1)
    whole = np.zeros_like(picture.photo)
    whole[first:] = colour
    picture.paint(share, whole, "terrain")
