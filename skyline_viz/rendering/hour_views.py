"""Views of mountains at dusk and dawn, in the last light, and at night."""

from dataclasses import replace

from skyline_viz.rendering.air import Bank, Glow, Stars
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.plants import Trees
from skyline_viz.rendering.sky import Sky
from skyline_viz.rendering.terrain import Colour, Light
from skyline_viz.rendering.views import Choice, Layer, View, forest, shaded

TWILIGHTS: tuple[tuple[Colour, Colour, Colour], ...] = (
    ((0.02, 0.05, 0.16), (0.26, 0.22, 0.30), (0.85, 0.36, 0.10)),
    ((0.06, 0.10, 0.24), (0.50, 0.36, 0.36), (0.75, 0.30, 0.16)),
    ((0.16, 0.10, 0.14), (0.62, 0.28, 0.14), (0.60, 0.22, 0.03)),
    ((0.08, 0.14, 0.22), (0.38, 0.42, 0.44), (0.50, 0.36, 0.20)),
    ((0.01, 0.03, 0.09), (0.06, 0.11, 0.22), (0.12, 0.12, 0.12)),
)
"""Zenith, horizon and glow of dusk and dawn."""


def dusk(c: Choice) -> View:
    """Silhouettes before the glow of dusk or dawn, the far ones pale."""
    zenith, horizon, glow = TWILIGHTS[c.index(len(TWILIGHTS))]
    top = c.between(0.3, 0.58)
    sky = Sky(zenith, horizon, low=top + 0.15, veil=max(0.0, c.between(-0.5, 0.3)))
    light = Light(c.sun(0.2, -0.3), shaded(horizon, 0.06), shaded(horizon, 0.14), horizon)
    place = c.between(-0.1, 1.1)
    disc = c.between(6, 22) if c.index(3) == 0 else 0.0
    low = top + c.between(-0.12, 0.03)
    sun = Glow(place, low, glow, c.between(0.3, 1.4), c.between(0.1, 0.3), disc)
    streaks = [
        Bank(
            top - c.between(0.04, 0.28),
            c.between(0.01, 0.03),
            shaded(glow, 0.8),
            shaded(zenith, 1.6),
            c.between(0.3, 0.9),
            c.between(0.008, 0.03),
            broken=c.between(0.2, 0.6),
        )
        for _ in range(c.index(4))
    ]
    ridges = [
        Range(
            top + 0.07 * k,
            c.size(0.2, 0.4),
            ("rock", "forest", "heath")[c.index(3)],
            peaks=5 + c.index(5),
            haze=max(0.0, c.between(0.1, 0.6) - 0.3 * k),
            mist=0.15,
            trees=0 if k == 0 else 8,
        )
        for k in range(1 + c.index(3))
    ]
    trees = Trees("conifer", 4 + c.index(14), 1.0, c.between(0.2, 0.6))
    ahead: tuple[Layer, ...] = (trees,) if c.index(3) == 0 else ()
    layers = (sun, *streaks, *ridges, forest(c, max(0.62, min(top + 0.22, 0.84))), *ahead)
    return View(sky, light, layers, contrast=c.between(0.1, 0.4), grain=c.between(2, 6))


def alpenglow(c: Choice) -> View:
    """Peaks in the last red light, brighter than the sky, above dark slopes."""
    sky = Sky(
        shaded((0.13, 0.20, 0.38), c.between(0.5, 1.2)),
        shaded((0.50, 0.40, 0.46), c.between(0.5, 1.1)),
        low=0.5,
        veil=c.between(0.0, 0.4),
    )
    red = (1.5, c.between(0.45, 0.8), c.between(0.25, 0.45))
    light = Light(c.sun(0.12, 0.55), red, (0.13, 0.14, 0.22), (0.30, 0.28, 0.38))
    main = Range(
        c.between(0.16, 0.3),
        c.size(0.42, 0.54),
        ("snow", "rock", "alpine")[c.index(3)],
        peaks=4 + c.index(5),
        haze=c.between(0.0, 0.2),
        mist=0.3,
        snow=c.between(-0.5, 0.6),
        towers=c.size(0.1, 0.2) if c.index(3) == 0 else 0.0,
    )
    dark = replace(light, sunlight=(0.04, 0.04, 0.05), skylight=(0.05, 0.06, 0.09))
    slopes = forest(c, c.between(0.55, 0.72), mist=0.05)
    return View(sky, light if c.index(4) else dark, (main, slopes), grain=c.between(2, 4))


def night(c: Choice) -> View:
    """Mountains under stars, or in moonlight; the noise of a long exposure."""
    dim = c.between(0.3, 1.6)
    zenith, horizon = shaded((0.008, 0.012, 0.028), dim), shaded((0.022, 0.030, 0.050), dim)
    if c.index(3) == 0:  # the lamps of a town beyond the ridge
        horizon = shaded((0.075, 0.050, 0.030), dim)
    top = c.between(0.3, 0.6)
    sky = Sky(zenith, horizon, low=top + 0.1, veil=0.02)
    moonlit = c.between(0.0, 0.06)
    light = Light(c.sun(0.4), shaded((0.9, 1.0, 1.2), moonlit), shaded(horizon, 0.15), horizon)
    stars = Stars(60 + c.index(700), c.between(0.1, 0.8))
    moon = Glow(c.between(0, 1), c.between(0.05, 0.3), (0.08, 0.08, 0.09), 0.1, 0.1, 11.0)
    main = Range(
        top,
        c.size(0.3, 0.45),
        ("rock", "snow", "forest")[c.index(3)],
        peaks=6,
        haze=c.between(0.0, 0.3),
        snow=0.1,
    )
    above: tuple[Layer, ...] = (stars, moon) if c.index(3) == 0 else (stars,)
    layers = (*above, main, forest(c, max(0.62, min(0.85, top + 0.2))))
    return View(sky, light, layers, contrast=0.0, grain=c.between(3, 8))
