"""What the kinds of rendered scenes are made of."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

import numpy as np

from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.plain import Plain
from skyline_viz.rendering.sky import Sky
from skyline_viz.rendering.terrain import Colour, Frame, Light

Kind: TypeAlias = Literal[
    "clear", "hazy", "cloudy", "snow", "foreground", "spires", "desert", "rover"
]
"""Name of a kind of scenes."""

KINDS: tuple[Kind, ...] = get_args(Kind)
"""The kinds of scenes."""

Ground: TypeAlias = Range | Plain


@dataclass(frozen=True)
class View:
    """Everything in a scene that is chosen before drawing."""

    sky: Sky
    light: Light
    terrain: tuple[Ground, ...]
    """From far to near."""

    contrast: float = 0.25
    """How much darker than true the dark, and brighter the bright tones are, 0 to 1."""

    grain: float = 2.2
    """Standard deviation of the film grain, in levels of 255."""


def compose(kind: Kind, frame: Frame, rng: np.random.Generator) -> View:
    """Choose sky, light and terrain of a scene."""
    return _RECIPES[kind](_Choice(frame, rng))


class _Choice:
    """Random choices for one scene."""

    def __init__(self, frame: Frame, rng: np.random.Generator) -> None:
        self._rng = rng
        self._size = min(frame.down, frame.across * 0.85)
        self._side = -1.0 if rng.random() < 0.5 else 1.0

    def between(self, low: float, high: float) -> float:
        return low + (high - low) * self._rng.random()

    def index(self, count: int) -> int:
        return int(self._rng.integers(count))

    def size(self, low: float, high: float) -> float:
        """Length in reference pixels, given as shares of the photo's height."""
        return self._size * self.between(low, high)

    def sun(self, up: float, behind: float = 0.38) -> tuple[float, float, float]:
        """Direction to a sun to the left or right, as far `up` and `behind` the viewer."""
        return (self._side * float(np.sqrt(1 - up * up - behind * behind)), -behind, up)


@dataclass(frozen=True)
class _Mood:
    zenith: Colour
    horizon: Colour
    sunlight: Colour
    skylight: Colour
    haze: Colour


_NOON = _Mood(
    zenith=(0.075, 0.20, 0.47),
    horizon=(0.48, 0.64, 0.82),
    sunlight=(1.45, 1.33, 1.14),
    skylight=(0.20, 0.25, 0.35),
    haze=(0.44, 0.56, 0.72),
)
_MORNING = _Mood(
    zenith=(0.17, 0.29, 0.50),
    horizon=(0.72, 0.70, 0.68),
    sunlight=(1.6, 1.22, 0.82),
    skylight=(0.19, 0.23, 0.33),
    haze=(0.56, 0.58, 0.64),
)
_EVENING = _Mood(
    zenith=(0.14, 0.23, 0.42),
    horizon=(0.84, 0.60, 0.42),
    sunlight=(1.6, 0.98, 0.56),
    skylight=(0.18, 0.21, 0.30),
    haze=(0.56, 0.50, 0.52),
)
_MOODS = (_NOON, _NOON, _MORNING, _EVENING)

_HAZES: tuple[tuple[Colour, Colour, Colour], ...] = (
    ((0.36, 0.47, 0.62), (0.66, 0.70, 0.74), (0.60, 0.66, 0.72)),
    ((0.30, 0.46, 0.70), (0.62, 0.72, 0.82), (0.52, 0.65, 0.80)),
    ((0.40, 0.42, 0.50), (0.85, 0.66, 0.48), (0.72, 0.60, 0.50)),
)
"""Zenith, horizon and haze of hazy days."""


def _forest(
    c: _Choice, top: float, *, haze: float = 0.0, mist: float = 0.03, trees: float = 12
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


def _hills(c: _Choice, top: float, *, trees: float) -> Range:
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


def _near(c: _Choice) -> tuple[Ground, ...]:
    """What lies before the mountains: wooded hills, a meadow or bare hills."""
    wooded = _hills(c, 0.62, trees=c.between(3, 6))
    meadow = Plain(c.between(0.66, 0.74), "heath", rocks=c.between(0.2, 0.9), haze=0.1)
    bare = _hills(c, 0.68, trees=0)
    forest = _forest(c, 0.76)
    return ((wooded, forest), (wooded, meadow), (wooded, bare), (forest,))[c.index(4)]


def _clear(c: _Choice) -> View:
    mood = _MOODS[c.index(4)]
    sky = Sky(mood.zenith, mood.horizon, veil=max(0.0, c.between(-0.2, 0.5)))
    light = Light(c.sun(c.between(0.42, 0.66)), mood.sunlight, mood.skylight, mood.haze)
    far = Range(c.between(0.26, 0.32), c.size(0.2, 0.3), "alpine", haze=0.55, mist=0.25, snow=0.35)
    main = Range(
        c.between(0.14, 0.2),
        c.size(0.46, 0.55),
        "alpine",
        peaks=7,
        haze=0.08,
        mist=0.22,
        snow=c.between(0.3, 1.1),
        trees=3,
    )
    return View(sky, light, (far, main, *_near(c)))


def _hazy(c: _Choice) -> View:
    zenith, horizon, haze = _HAZES[c.index(len(_HAZES))]
    sky = Sky(zenith, horizon, low=0.5)
    light = Light(c.sun(0.5), (1.1, 1.0, 0.86), (0.22, 0.26, 0.32), haze)
    faint = Range(
        c.between(0.22, 0.28),
        c.size(0.3, 0.4),
        "heath",
        haze=0.82,
        mist=0.16,
        fade=0.10,
        steep=0.45,
    )
    terrain = (
        faint,
        _forest(c, 0.36, haze=0.64, mist=0.36, trees=3),
        _forest(c, 0.50, haze=0.40, mist=0.5, trees=5),
        _forest(c, 0.68, haze=0.12, mist=0.3),
    )
    return View(sky, light, terrain, contrast=0.1)


def _cloudy(c: _Choice) -> View:
    sky = Sky(_NOON.zenith, _NOON.horizon, veil=c.between(0, 0.4), heaps=8 + c.index(8), low=0.6)
    light = Light(c.sun(0.6), _NOON.sunlight, (0.24, 0.28, 0.35), _NOON.haze)
    main = Range(
        c.between(0.36, 0.42), c.size(0.34, 0.42), "heath", haze=0.16, mist=0.2, steep=0.5, peaks=7
    )
    return View(sky, light, (main, *_near(c)))


def _snow(c: _Choice) -> View:
    white = (0.86, 0.875, 0.89)
    sky = Sky((0.80, 0.83, 0.87), white)
    light = Light(c.sun(0.62, 0.3), (0.42, 0.41, 0.39), (0.56, 0.60, 0.67), white)
    main = Range(
        c.between(0.18, 0.24),
        c.size(0.42, 0.5),
        "snow",
        haze=0.36,
        mist=0.25,
        fade=0.12,
        peaks=7,
        snow=-1.0,
    )
    spur = Range(
        c.between(0.55, 0.62),
        c.size(0.3, 0.36),
        "snow",
        haze=0.12,
        mist=0.2,
        snow=-1.0,
        steep=0.45,
        gullies=0.6,
    )
    field = Range(
        c.between(0.8, 0.84),
        c.size(0.2, 0.24),
        "snow",
        haze=0.0,
        mist=0.1,
        snow=-1.0,
        steep=0.3,
        gullies=0.4,
        ridges=0.6,
    )
    return View(sky, light, (main, spur, field), contrast=0.1, grain=1.8)


def _foreground(c: _Choice) -> View:
    sky = Sky((0.34, 0.47, 0.66), (0.72, 0.75, 0.76), veil=0.2)
    light = Light(c.sun(0.42, 0.1), (1.0, 0.88, 0.70), (0.15, 0.18, 0.23), (0.64, 0.69, 0.74))
    faint = Range(
        c.between(0.16, 0.2), c.size(0.42, 0.5), "alpine", haze=0.74, mist=0.2, peaks=7, snow=0.5
    )
    strong = Range(
        c.between(0.36, 0.42),
        c.size(0.4, 0.48),
        "rock",
        haze=0.06,
        mist=0.1,
        peaks=6,
        lean=c.between(0.3, 0.8),
        trees=4,
    )
    return View(sky, light, (faint, strong, _forest(c, 0.7, mist=0.0, trees=14)))


def _spires(c: _Choice) -> View:
    sky = Sky((0.10, 0.22, 0.46), (0.52, 0.64, 0.78), veil=c.between(0.1, 0.5))
    light = Light(c.sun(0.5), (1.5, 1.25, 0.98), _NOON.skylight, _NOON.haze)
    main = Range(
        c.between(0.12, 0.16),
        c.size(0.42, 0.5),
        "rock",
        haze=0.10,
        mist=0.2,
        peaks=6,
        towers=c.size(0.28, 0.36),
    )
    return View(sky, light, (main, *_near(c)))


def _desert(c: _Choice) -> View:
    sky = Sky((0.12, 0.26, 0.50), (0.62, 0.66, 0.70), veil=c.between(0.0, 0.4))
    light = Light(c.sun(0.45), (1.6, 1.3, 0.95), _NOON.skylight, (0.56, 0.56, 0.60))
    horizon = c.between(0.48, 0.56)
    far = Range(
        horizon - c.between(0.03, 0.04),
        c.size(0.12, 0.15),
        "desert",
        haze=0.62,
        steep=0.3,
        peaks=5,
        tilt=0.08,
    )
    mesas = Range(
        horizon - c.between(0.09, 0.13),
        c.size(0.24, 0.3),
        "desert",
        haze=0.3,
        mist=0.15,
        mesa=0.9,
        peaks=4,
        tilt=0.08,
    )
    sand = Plain(horizon, "desert", rocks=0.25, ripples=1.0, shrubs=c.between(0.0, 0.6))
    return View(sky, light, (far, mesas, sand))


def _rover(c: _Choice) -> View:
    sky = Sky((0.50, 0.50, 0.50), (0.66, 0.66, 0.66))
    light = Light(c.sun(0.5), (2.0, 2.0, 2.0), (0.24, 0.24, 0.24), (0.60, 0.60, 0.60))
    horizon = c.between(0.42, 0.48)
    far, near = (
        Range(
            horizon - c.between(low, low + 0.06),
            c.size(relief, relief * 1.3),
            "basalt",
            haze=haze,
            steep=0.33,
            peaks=5,
            tilt=0.1,
            gullies=0.6,
        )
        for low, relief, haze in ((0.2, 0.21, 0.4), (0.05, 0.13, 0.2))
    )
    ground = Plain(horizon, "basalt", rocks=0.8, haze=0.3)
    return View(sky, light, (far, near, ground), contrast=0.35)


_RECIPES: dict[Kind, Callable[[_Choice], View]] = {
    "clear": _clear,
    "hazy": _hazy,
    "cloudy": _cloudy,
    "snow": _snow,
    "foreground": _foreground,
    "spires": _spires,
    "desert": _desert,
    "rover": _rover,
}
