"""Views of other places: water, woods, villages, people, and the ground from the air."""

from dataclasses import replace

from skyline_viz.rendering.air import Bank, Glow, Overcast
from skyline_viz.rendering.built import Houses, Wires
from skyline_viz.rendering.camera import Camera
from skyline_viz.rendering.hour_views import TWILIGHTS
from skyline_viz.rendering.mountains import Range
from skyline_viz.rendering.people import People
from skyline_viz.rendering.plain import Plain
from skyline_viz.rendering.plants import Branches, Trees
from skyline_viz.rendering.sky import Sky
from skyline_viz.rendering.terrain import Light
from skyline_viz.rendering.views import MOODS, Choice, Layer, View, forest, hills, near, shaded
from skyline_viz.rendering.water import Water


def _day(c: Choice, low: float) -> tuple[Sky, Light]:
    """Sky and light of an hour of the day, with or without clouds, for a horizon at row `low`."""
    mood = MOODS[c.index(4)]
    veil, heaps = max(0.0, c.between(-0.3, 0.6)), max(0, c.index(16) - 7)
    bright = c.between(0.75, 1.1)
    zenith, horizon = shaded(mood.zenith, bright), shaded(mood.horizon, bright)
    sky = Sky(zenith, horizon, veil=veil, heaps=heaps, low=low)
    return sky, Light(c.sun(c.between(0.3, 0.66)), mood.sunlight, mood.skylight, mood.haze)


def _far(c: Choice, top: float) -> Range:
    """Mountains in the distance."""
    return Range(
        top,
        c.size(0.2, 0.42),
        ("alpine", "heath", "rock", "snow")[c.index(4)],
        peaks=5 + c.index(5),
        haze=c.between(0.15, 0.8),
        mist=0.15,
        snow=c.between(0.2, 1.1),
    )


def sea(c: Choice) -> View:
    """The horizon of a sea, open or behind headlands and islands."""
    horizon = c.between(0.3, 0.66)
    sky, light = _day(c, horizon)
    sun: tuple[Layer, ...] = ()
    if c.index(4) == 0:
        zenith, glowing, red = TWILIGHTS[c.index(len(TWILIGHTS))]
        sky = Sky(zenith, glowing, low=horizon, veil=c.between(0.0, 0.2))
        light = Light(c.sun(0.2), shaded(red, 0.2), shaded(glowing, 0.25), glowing)
        sun = (
            Glow(c.between(0, 1), horizon - c.between(0.0, 0.2), red, 0.4, 0.2, c.between(0, 18)),
        )
    hazy = c.index(3) == 0
    water = Water(
        horizon,
        c.between(0.15, 1.0),
        ((0.02, 0.07, 0.11), (0.01, 0.10, 0.11), (0.06, 0.09, 0.09))[c.index(3)],
        c.between(0.5, 0.9) if hazy else c.between(0.0, 0.4),
    )
    if hazy:
        light = replace(light, haze=shaded(sky.horizon, c.between(0.85, 0.97)))
    coast = [
        Range(
            horizon - c.between(0.02, 0.16),
            c.size(0.16, 0.26),
            ("heath", "rock")[c.index(2)],
            peaks=2 + c.index(5),
            steep=0.3,
            haze=c.between(0.2, 0.85),
            lean=c.between(0.2, 1.3),
            tilt=0.08,
        )
        for _ in range(c.index(3))
    ]
    bank = Bank(horizon - c.between(0.0, 0.1), 0.2, (0.9, 0.9, 0.9), shaded(sky.horizon, 0.7))
    back: tuple[Layer, ...] = (bank,) if c.index(3) == 0 else ()
    beach: tuple[Layer, ...] = ()
    if c.index(3) == 0:
        beach = (replace(hills(c, 0.78, trees=0), cover="rock"),)
    return View(sky, light, (*sun, *back, *coast, water, *beach))


def lake(c: Choice) -> View:
    """Mountains and their image in a lake."""
    shore = c.between(0.45, 0.7)
    sky, light = _day(c, shore)
    mountains = _far(c, shore - c.between(0.22, 0.4))
    wood = forest(c, shore - c.between(0.1, 0.2), haze=c.between(0.0, 0.3))
    wood = replace(wood, relief=c.size(0.22, 0.34), lean=c.between(0, 1.2))
    water = Water(shore, c.between(0.0, 0.35))
    trees = Trees("conifer", 3 + c.index(8), 1.02, c.between(0.2, 0.7), right=0.35)
    ahead: tuple[Layer, ...] = (trees,) if c.index(3) == 0 else ()
    return View(sky, light, (mountains, wood, water, *ahead))


def conifers(c: Choice) -> View:
    """Firs before the mountains; the tallest reach above the ridge."""
    top = c.between(0.22, 0.45)
    sky, light = _day(c, top + 0.15)
    if c.index(3) == 0:
        light = replace(light, sunlight=(0.12, 0.12, 0.12))
    left = c.between(0.0, 0.6) if c.index(2) else 0.0
    back = Trees("conifer", 10 + c.index(30), c.between(0.8, 0.9), c.between(0.15, 0.3), haze=0.15)
    front = Trees(
        "conifer",
        3 + c.index(14),
        1.02,
        c.between(0.35, 0.95),
        left,
        left + c.between(0.3, 1.0),
    )
    hill = forest(c, c.between(0.6, 0.75))
    layers: tuple[Layer, ...] = (_far(c, top), hill, back, front)
    if c.index(2):  # on a wooded ridge they are the skyline
        crest = Trees("conifer", 10 + c.index(60), 0.0, c.between(0.04, 0.16))
        layers = (forest(c, top, mist=0.0, trees=9), crest, hill, front)
    return View(sky, light, layers, contrast=c.between(0.1, 0.4))


def grove(c: Choice) -> View:
    """Broad or bare trees before hills, some of them above the ridge."""
    top = c.between(0.28, 0.5)
    sky, light = _day(c, top + 0.15)
    shape = ("crown", "crown", "bare")[c.index(3)]
    autumn = ((0.085, 0.105, 0.035), (0.26, 0.13, 0.03), (0.16, 0.15, 0.04))[c.index(3)]
    left = c.between(0.0, 0.5)
    trees = Trees(
        "crown" if shape == "crown" else "bare",
        2 + c.index(8),
        c.between(0.85, 1.05),
        c.between(0.25, 0.8),
        left,
        left + c.between(0.4, 0.8),
        pale=autumn,
    )
    hedge = Trees("crown", 8 + c.index(30), c.between(0.72, 0.8), c.between(0.05, 0.14), haze=0.1)
    meadow = Plain(c.between(0.66, 0.74), "heath", rocks=0.1, haze=0.1)
    branches = Branches((-1.0, 1.0)[c.index(2)], c.between(0.25, 0.7))
    ahead: tuple[Layer, ...] = (branches,) if c.index(3) == 0 else ()
    return View(sky, light, (_far(c, top), meadow, hedge, trees, *ahead))


def village(c: Choice) -> View:
    """Houses before the mountains, on the hill or above the ridge, often behind wires."""
    top = c.between(0.25, 0.5)
    sky, light = _day(c, top + 0.15)
    town = c.index(3) == 0
    houses = Houses(
        3 + c.index(12),
        c.between(0.68, 0.9),
        c.between(0.06, 0.2) if c.index(3) else c.between(0.25, 0.6),
        towers=c.index(2),
        flat=town,
        haze=c.between(0.0, 0.2),
    )
    ground = Plain(c.between(0.64, 0.7), "heath", rocks=0.1) if c.index(2) else forest(c, 0.6)
    trees = Trees("crown", 4 + c.index(12), 0.86, c.between(0.06, 0.16))
    wires = Wires(
        c.between(0.02, 0.5),
        1 + c.index(5),
        c.between(0.01, 0.06),
        c.between(0.01, 0.12),
        c.between(-0.2, 0.2),
        c.between(0.7, 2.4),
        c.index(3),
    )
    ahead: tuple[Layer, ...] = (wires,) if c.index(2) else ()
    return View(sky, light, (_far(c, top), ground, houses, trees, *ahead))


def hikers(c: Choice) -> View:
    """People before the view, as in most people's photos."""
    top = c.between(0.2, 0.45)
    sky, light = _day(c, top + 0.15)
    people = People(1 + c.index(3), c.between(0.3, 0.95), c.between(1.0, 1.12))
    return View(sky, light, (_far(c, top), *near(c), people))


def aerial(c: Choice) -> View:
    """The ground from an aircraft that banks: a far, hazy and steep horizon."""
    horizon = c.between(0.3, 0.65)
    sky, light = _day(c, horizon)
    grey = c.between(0.6, 1.0)
    sheet = Overcast(horizon, shaded((0.97, 0.97, 0.97), grey), shaded((0.6, 0.62, 0.66), grey))
    hazy = c.between(0.5, 0.98)
    pale = shaded((0.97, 0.96, 0.96), c.between(0.7, 1.0))
    if c.index(2):  # the small cameras of aircraft burn out the sky
        sky = replace(sky, zenith=shaded(pale, c.between(0.5, 0.95)), horizon=pale)
    light = replace(light, haze=shaded(sky.horizon, c.between(0.5, 0.9)))
    far = Range(
        horizon - c.between(0.003, 0.03),
        c.size(0.05, 0.1),
        "forest",
        haze=hazy,
        steep=0.25,
        tilt=0.06,
    )
    ground = Plain(horizon, "heath", rocks=0.0, haze=hazy, fields=c.between(35, 160))
    back: tuple[Layer, ...] = (sheet,) if c.index(2) else ()
    roll = c.between(-0.24, 0.24)
    return View(sky, light, (*back, far, ground), camera=Camera(roll=roll, vignette=0.8))
