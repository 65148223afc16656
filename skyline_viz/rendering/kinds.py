"""The kinds of rendered scenes."""

from collections.abc import Callable
from typing import Literal, TypeAlias, get_args

import numpy as np

from skyline_viz.rendering import hour_views, mountain_views, place_views, weather_views
from skyline_viz.rendering.terrain import Frame
from skyline_viz.rendering.views import Choice, View

Kind: TypeAlias = Literal[
    "clear",
    "hazy",
    "cloudy",
    "snow",
    "foreground",
    "spires",
    "desert",
    "rover",
    "blue",
    "banks",
    "overcast",
    "glacier",
    "dusk",
    "alpenglow",
    "night",
    "sea",
    "lake",
    "conifers",
    "grove",
    "village",
    "hikers",
    "aerial",
]
"""Name of a kind of scenes."""

KINDS: tuple[Kind, ...] = get_args(Kind)
"""The kinds of scenes. Each is seeded by its place, so that new ones come last."""

_RECIPES: dict[Kind, Callable[[Choice], View]] = {
    "clear": mountain_views.clear,
    "hazy": mountain_views.hazy,
    "cloudy": mountain_views.cloudy,
    "snow": mountain_views.snow,
    "foreground": mountain_views.foreground,
    "spires": mountain_views.spires,
    "desert": mountain_views.desert,
    "rover": mountain_views.rover,
    "blue": weather_views.blue,
    "banks": weather_views.banks,
    "overcast": weather_views.overcast,
    "glacier": weather_views.glacier,
    "dusk": hour_views.dusk,
    "alpenglow": hour_views.alpenglow,
    "night": hour_views.night,
    "sea": place_views.sea,
    "lake": place_views.lake,
    "conifers": place_views.conifers,
    "grove": place_views.grove,
    "village": place_views.village,
    "hikers": place_views.hikers,
    "aerial": place_views.aerial,
}


def compose(kind: Kind, frame: Frame, rng: np.random.Generator) -> View:
    """Choose sky, light, layers and camera of a scene."""
    return _RECIPES[kind](Choice(frame, rng))
