"""Views of mountains in haze, between clouds, and under a deep blue sky."""

from dataclasses import replace

from skyline_viz.rendering.air import Bank, Overcast
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.sky import Sky
from skyline_viz.rendering.terrain import Light
from skyline_viz.rendering.views import MOODS, Choice, Layer, View, forest, near, shaded

_WHITE = (0.95, 0.95, 0.96)
_GREY = (0.42, 0.45, 0.50)


def blue(c: Choice) -> View:
    """Pale blue ridges, the last only a few levels off the sky, behind a dark one."""
    skies = (
        ((0.26, 0.45, 0.74), (0.60, 0.73, 0.88)),
        ((0.40, 0.50, 0.66), (0.74, 0.77, 0.82)),
        ((0.16, 0.33, 0.62), (0.42, 0.60, 0.82)),
        ((0.50, 0.46, 0.50), (0.86, 0.72, 0.62)),
    )
    zenith, horizon = skies[c.index(4)]
    top = c.between(0.2, 0.42)
    haze = shaded(horizon, c.between(0.78, 0.95))
    haze = (haze[0] * c.between(0.86, 0.98), haze[1] * 0.985, haze[2])
    sky = Sky(zenith, horizon, low=top + 0.08, veil=max(0.0, c.between(-0.4, 0.4)))
    light = Light(c.sun(c.between(0.3, 0.6), 0.1), (0.9, 0.8, 0.68), (0.16, 0.20, 0.27), haze)
    layers: list[Layer] = []
    count = 2 + c.index(3)
    for k in range(count):
        veil = c.between(0.93, 0.985) - 0.33 * k / count
        spec = Range(
            top + c.between(0.0, 0.05),
            c.size(0.16, 0.4),
            ("heath", "alpine", "forest")[c.index(3)],
            peaks=4 + c.index(6),
            haze=veil,
            mist=1 - veil,
            steep=c.between(0.3, 0.6),
            snow=0.6,
        )
        layers.append(spec)
        top += c.between(0.05, 0.13)
    dark = forest(c, max(0.61, min(top + 0.04, 0.82)), mist=0.02, trees=c.between(5, 16))
    layers.append(replace(dark, lean=c.between(0.0, 0.7), cover=("forest", "rock")[c.index(2)]))
    return View(sky, light, tuple(layers), contrast=c.between(0.05, 0.4))


def banks(c: Choice) -> View:
    """Banks of cloud that look like ridges, behind the mountains and lying on them."""
    mood = MOODS[c.index(4)]
    top = c.between(0.22, 0.42)
    sky = Sky(mood.zenith, mood.horizon, low=top + 0.2, heaps=c.index(5))
    light = Light(c.sun(c.between(0.3, 0.6)), mood.sunlight, mood.skylight, mood.haze)
    bright = (0.96, 0.94, 0.91) if c.index(3) else shaded(mood.horizon, 0.85)
    grey = shaded(_GREY, c.between(0.5, 1.2))
    main = Range(
        top,
        c.size(0.36, 0.5),
        ("alpine", "heath", "rock")[c.index(3)],
        peaks=7,
        haze=c.between(0.05, 0.45),
        mist=0.25,
        snow=c.between(0.4, 1.2),
    )
    behind = [
        Bank(
            top + c.between(-0.16, 0.07),
            c.between(0.1, 0.4),
            bright,
            grey,
            relief=c.between(0.03, 0.1),
            soft=c.between(0.003, 0.05),
            broken=max(0.0, c.between(-0.3, 0.5)),
        )
        for _ in range(1 + c.index(3))
    ]
    before = [
        Bank(
            top + c.between(0.06, 0.3),
            c.between(0.02, 0.08),
            bright,
            shaded(bright, 0.75),
            strength=c.between(0.5, 0.97),
            relief=c.between(0.02, 0.05),
            soft=c.between(0.01, 0.05),
            broken=c.between(0.2, 0.7),
        )
        for _ in range(1 + c.index(2))
    ]
    return View(sky, light, (*behind, main, *before, *near(c)))


def overcast(c: Choice) -> View:
    """Mountains under a grey, rolling sheet of cloud."""
    top = c.between(0.16, 0.4)
    bright = c.between(0.35, 0.9)
    pale = shaded((0.97, 0.98, 1.0), bright)
    grey = shaded((0.42, 0.46, 0.52), bright * c.between(0.8, 1.5))
    haze = shaded((0.84, 0.88, 0.95), bright * 0.8)
    sky = Sky((0.22, 0.36, 0.56), shaded(pale, 0.95), low=top + 0.12)
    light = Light(c.sun(0.7), shaded(_WHITE, 0.4), shaded(_WHITE, 0.28), haze)
    sheet = Overcast(top + 0.12, pale, grey, c.between(0.6, 1.0), c.between(0.3, 1.8))
    far = Range(top + 0.04, c.size(0.3, 0.4), "heath", haze=0.7, mist=0.2)
    main = Range(
        top,
        c.size(0.4, 0.5),
        ("alpine", "forest", "rock", "snow")[c.index(4)],
        peaks=5 + c.index(5),
        haze=c.between(0.0, 0.4),
        mist=0.2,
        snow=c.between(-0.2, 1.0),
        trees=c.between(0, 6),
    )
    low = Bank(top - 0.02, 0.05, pale, grey, 0.7, broken=0.6)
    back: tuple[Layer, ...] = (sheet, low) if c.index(2) else (sheet,)
    return View(sky, light, (*back, far, main, *near(c)), contrast=c.between(0.1, 0.5))


def glacier(c: Choice) -> View:
    """Sunlit snow, brighter than the sky: under deep blue, or before white clouds."""
    deep = c.between(0.5, 1.6)
    zenith = shaded((0.03, 0.10, 0.30), deep)
    horizon = shaded((0.12, 0.30, 0.60), deep)
    if c.index(4) == 0:  # as through a polariser, or a film that turns blue into teal
        zenith, horizon = shaded((0.005, 0.13, 0.19), deep), shaded((0.02, 0.20, 0.27), deep)
    top = c.between(0.14, 0.32)
    clouds = c.index(3)
    sky = Sky(zenith, horizon, heaps=6 * clouds, veil=0.25 * clouds, low=top + 0.3)
    light = Light(c.sun(c.between(0.35, 0.6)), (1.25, 1.16, 1.02), (0.17, 0.22, 0.34), horizon)
    snow = c.between(-1.0, 0.35)
    main = Range(
        top,
        c.size(0.42, 0.6),
        "snow",
        peaks=4 + c.index(5),
        haze=c.between(0.0, 0.12),
        mist=0.12,
        snow=snow,
        steep=c.between(0.45, 0.75),
        gullies=c.between(0.5, 1.1),
    )
    slope = Range(
        c.between(0.58, 0.7),
        c.size(0.25, 0.35),
        ("snow", "alpine", "forest")[c.index(3)],
        snow=-1.0,
        mist=0.05,
        steep=0.4,
        trees=c.between(0, 9),
    )
    bank = Bank(top + 0.03, 0.3, _WHITE, (0.66, 0.70, 0.78), soft=0.01, broken=c.between(0, 0.5))
    back: tuple[Layer, ...] = (bank,) if clouds == 2 else ()
    return View(sky, light, (*back, main, slope), contrast=c.between(0.1, 0.4), grain=1.8)
