"""Views of mountains by day: the kinds of the sample scenes."""

from skyline_viz.rendering.camera import Camera
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.plain import Plain
from skyline_viz.rendering.sky import Sky
from skyline_viz.rendering.terrain import Colour, Light
from skyline_viz.rendering.views import MOODS, NOON, Choice, View, forest, near

_HAZES: tuple[tuple[Colour, Colour, Colour], ...] = (
    ((0.36, 0.47, 0.62), (0.66, 0.70, 0.74), (0.60, 0.66, 0.72)),
    ((0.30, 0.46, 0.70), (0.62, 0.72, 0.82), (0.52, 0.65, 0.80)),
    ((0.40, 0.42, 0.50), (0.85, 0.66, 0.48), (0.72, 0.60, 0.50)),
)
"""Zenith, horizon and haze of hazy days."""


def clear(c: Choice) -> View:
    """Mountains in clear air."""
    mood = MOODS[c.index(4)]
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
    return View(sky, light, (far, main, *near(c)))


def hazy(c: Choice) -> View:
    """Wooded hills, one behind the other, in haze."""
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
        forest(c, 0.36, haze=0.64, mist=0.36, trees=3),
        forest(c, 0.50, haze=0.40, mist=0.5, trees=5),
        forest(c, 0.68, haze=0.12, mist=0.3),
    )
    return View(sky, light, terrain, contrast=0.1)


def cloudy(c: Choice) -> View:
    """Hills under heaped clouds."""
    sky = Sky(NOON.zenith, NOON.horizon, veil=c.between(0, 0.4), heaps=8 + c.index(8), low=0.6)
    light = Light(c.sun(0.6), NOON.sunlight, (0.24, 0.28, 0.35), NOON.haze)
    main = Range(
        c.between(0.36, 0.42), c.size(0.34, 0.42), "heath", haze=0.16, mist=0.2, steep=0.5, peaks=7
    )
    return View(sky, light, (main, *near(c)))


def snow(c: Choice) -> View:
    """Snow under a white sky."""
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


def foreground(c: Choice) -> View:
    """A faint range behind a near strong one."""
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
    return View(sky, light, (faint, strong, forest(c, 0.7, mist=0.0, trees=14)))


def spires(c: Choice) -> View:
    """Walls and needles."""
    sky = Sky((0.10, 0.22, 0.46), (0.52, 0.64, 0.78), veil=c.between(0.1, 0.5))
    light = Light(c.sun(0.5), (1.5, 1.25, 0.98), NOON.skylight, NOON.haze)
    main = Range(
        c.between(0.12, 0.16),
        c.size(0.42, 0.5),
        "rock",
        haze=0.10,
        mist=0.2,
        peaks=6,
        towers=c.size(0.28, 0.36),
    )
    return View(sky, light, (main, *near(c)))


def desert(c: Choice) -> View:
    """Table mountains behind sand."""
    sky = Sky((0.12, 0.26, 0.50), (0.62, 0.66, 0.70), veil=c.between(0.0, 0.4))
    light = Light(c.sun(0.45), (1.6, 1.3, 0.95), NOON.skylight, (0.56, 0.56, 0.60))
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


def rover(c: Choice) -> View:
    """Hills of another planet, in grey."""
    sky = Sky((0.50, 0.50, 0.50), (0.66, 0.66, 0.66))
    light = Light(c.sun(0.5), (2.0, 2.0, 2.0), (0.24, 0.24, 0.24), (0.60, 0.60, 0.60))
    horizon = c.between(0.42, 0.48)
    far, close = (
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
    return View(sky, light, (far, close, ground), contrast=0.35, camera=Camera(grey=True))
