"""What a rendered scene is made of, and the choices from which that follows."""

from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from skyline_viz.rendering.air import Bank, Glow, Overcast, Stars
from skyline_viz.rendering.built import Houses, Wires
from skyline_viz.rendering.camera import PLAIN, Camera
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.people import People
from skyline_viz.rendering.plain import Plain
from skyline_viz.rendering.plants import Branches, Trees
from skyline_viz.rendering.sky import Sky
from skyline_viz.rendering.terrain import Colour, Frame, Light
from skyline_viz.rendering.water import Water

Ground: TypeAlias = Range | Plain
"""Solid ground."""

Layer: TypeAlias = (
    Range
    | Plain
    | Water
    | Trees
    | Branches
    | Bank
    | Overcast
    | Glow
    | Stars
    | Houses
    | Wires
    | People
)
"""Whatever is drawn over what is behind it."""


@dataclass(frozen=True)
class View:
    """Everything in a scene that is chosen before drawing."""

    sky: Sky
    light: Light
    layers: tuple[Layer, ...]
    """From far to near."""

    contrast: float = 0.25
    """How much darker than true the dark, and brighter the bright tones are, 0 to 1."""

    grain: float = 2.2
    """Standard deviation of the film grain, in levels of 255."""

    camera: Camera = PLAIN

    def through(self, camera: Camera) -> "View":
        """The same place, taken with another camera."""
        tops = [low for low in map(_top, self.layers) if low is not None]
        by = max(camera.pitch, 0.03 - min(tops))
        layers = [_lowered(layer, by) for layer in self.layers]
        seen = [layer for layer in layers if (_top(layer) or 0) < 0.96]
        camera = replace(
            camera,
            roll=camera.roll + self.camera.roll,
            grey=camera.grey or self.camera.grey,
        )
        sky = replace(self.sky, low=max(0.2, self.sky.low + by))
        return replace(self, sky=sky, layers=tuple(seen), camera=camera)


def shaded(colour: Colour, by: float) -> Colour:
    """A colour `by` times as bright."""
    red, green, blue = colour
    return (red * by, green * by, blue * by)


def _top(layer: Layer) -> float | None:
    """Row where ground begins."""
    if isinstance(layer, Range):
        return layer.top
    return layer.horizon if isinstance(layer, Plain | Water) else None


def _lowered(layer: Layer, by: float) -> Layer:
    for name in ("top", "horizon", "base", "low"):
        place = getattr(layer, name, None)
        # What is near stays when the camera looks down: the ground has to reach its feet.
        if place is not None and (by > 0 or place < 0.6):
            return replace(layer, **{name: place + by})
    return layer


class Choice:
    """Random choices for one scene."""

    def __init__(self, frame: Frame, rng: np.random.Generator) -> None:
        self._rng = rng
        self._size = min(frame.down, frame.across * 0.85)
        self._side = -1.0 if rng.random() < 0.5 else 1.0

    def between(self, low: float, high: float) -> float:
        """Any number between these."""
        return low + (high - low) * self._rng.random()

    def index(self, count: int) -> int:
        """0 to `count` - 1."""
        return int(self._rng.integers(count))

    def size(self, low: float, high: float) -> float:
        """Length in reference pixels, given as shares of the photo's height."""
        return self._size * self.between(low, high)

    def sun(self, up: float, behind: float = 0.38) -> tuple[float, float, float]:
        """Direction to a sun to the left or right, as far `up` and `behind` the viewer."""
        return (self._side * float(np.sqrt(1 - up * up - behind * behind)), -behind, up)


@dataclass(frozen=True)
class Mood:
    """Colours of an hour of the day."""

    zenith: Colour
    horizon: Colour
    sunlight: Colour
    skylight: Colour
    haze: Colour


NOON = Mood(
    zenith=(0.075, 0.20, 0.47),
    horizon=(0.48, 0.64, 0.82),
    sunlight=(1.45, 1.33, 1.14),
    skylight=(0.20, 0.25, 0.35),
    haze=(0.44, 0.56, 0.72),
)
MORNING = Mood(
    zenith=(0.17, 0.29, 0.50),
    horizon=(0.72, 0.70, 0.68),
    sunlight=(1.6, 1.22, 0.82),
    skylight=(0.19, 0.23, 0.33),
    haze=(0.56, 0.58, 0.64),
)
EVENING = Mood(
    zenith=(0.14, 0.23, 0.42),
    horizon=(0.84, 0.60, 0.42),
    sunlight=(1.6, 0.98, 0.56),
    skylight=(0.18, 0.21, 0.30),
    haze=(0.56, 0.50, 0.52),
)
MOODS = (NOON, NOON, MORNING, EVENING)


def forest(
    c: Choice, top: float, *, haze: float = 0.0, mist: float = 0.03, trees: float = 12
) -> Range:
    """A wooded hill that begins at about row `top`, a share of the height."""
    return Range(
        c.between(top, top + 0.06),
        c.size(0.22, 0.3),
        "forest",
        haze=haze,
        mist=mist,
        trees=trees * c.between(0.8, 1.25),
        steep=0.45,
        gullies=0.4,
    )


def hills(c: Choice, top: float, *, trees: float) -> Range:
    """Green hills that begin at about row `top`, a share of the height."""
    return Range(
        c.between(top, top + 0.06),
        c.size(0.24, 0.32),
        "heath",
        haze=0.04,
        mist=0.06,
        trees=trees,
        steep=0.4,
        gullies=0.55,
        rough=0.7,
    )


def near(c: Choice) -> tuple[Ground, ...]:
    """What lies before the mountains: wooded hills, a meadow or bare hills."""
    wooded = hills(c, 0.62, trees=c.between(3, 6))
    meadow = Plain(c.between(0.66, 0.74), "heath", rocks=c.between(0.2, 0.9), haze=0.1)
    bare = hills(c, 0.68, trees=0)
    wood = forest(c, 0.76)
    return ((wooded, wood), (wooded, meadow), (wooded, bare), (wood,))[c.index(4)]
