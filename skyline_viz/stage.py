"""A stage of a detection as data: its values, what they are in words, and how to show them.

Whoever shows or explains a detection loops over its stages, so a new one appears everywhere.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy.typing as npt

from skyline_viz.arrays import F32, Int

Where: TypeAlias = Literal["mask", "edges", "photo", "columns"]
"""Where the values of a stage are: a yes or no for every pixel ``(H, W)``, a value at each edge
pixel ``(n,)``, at every pixel ``(H, W)``, or in each column ``(W,)``."""


@dataclass(frozen=True)
class Quantity:
    """What values are, and how they are shown: all of a stage but its values."""

    name: str
    """Its name."""

    colour_map: str = "viridis"
    """A colour map of `skyline_viz.colours`; uniform, so that it reads with colour-blindness."""

    unit: str = ""
    """What stands behind the value; nothing for plain numbers."""

    span: tuple[float, float] = (0.0, 1.0)
    """Part of the colour map that is used: its black end would be lost on a black background."""

    contrast: float = 1.0
    """Below 1, small values get more of the colours: they grow with this power of the value."""

    low: float | None = None
    """Value of the first colour; the smallest one of the map unless given."""

    high: float | None = None
    """Value of the last colour; the largest one of the map unless given."""

    about: str = ""
    """What it is, in words, as the title of its view; the name unless given."""

    group: str = ""
    """What it belongs to, as the parent of its path in a recording: ``tensor``, ``maps``."""

    tabs: tuple[str, ...] = ("Stages",)
    """Which tabs of the viewer show it: ``Stages``, ``Tensor``."""

    smooth: bool = False
    """Whether a map changes so slowly that small recordings keep it of all pixels, not of edges."""

    word: str = ""
    """What hovering a pixel shows before the value; the name unless given."""

    @property
    def title(self) -> str:
        """What it is, in words."""
        return self.about or self.name.capitalize()

    @property
    def low_is_bright(self) -> bool:
        """Whether low values are the bright ones, as with costs."""
        return self.colour_map.endswith("_r")

    def label(self, value: float, step: float) -> str:
        """Name, value and unit, with as many digits as a step can tell apart.

        >>> Quantity("strength", unit=" grey levels/px").label(41.23, step=0.1)
        'strength 41.2 grey levels/px'
        """
        digits = max(0, math.ceil(-math.log10(step)))
        return f"{self.word or self.name} {value:.{digits}f}{self.unit}"


@dataclass(frozen=True, eq=False)
class Stage:
    """What a stage has found in a photo."""

    quantity: Quantity
    """What its values are, and how they are shown."""

    values: npt.NDArray[Any]
    """``(H, W)``, ``(n,)`` or ``(W,)``, as `where` says; NaN is no value."""

    where: Where
    """Where the values are."""

    dense: Callable[[], F32] | None = None
    """Gives what all pixels show ``(H, W)``, where that is more than the values: of a stage that is
    kept at edge pixels all others, too; of costs NaN where pixels are ruled out. It may take as
    long as the stage."""

    at: Callable[[Int, Int], F32] | None = None
    """Gives what pixels at some rows and columns ``(k,)``, in ascending order of rows, show, where
    that is less work than `dense`."""

    legend: tuple[tuple[str, tuple[int, int, int]], ...] = ()
    """Words and colour of each value, where these are whole numbers that name something."""

    def map(self) -> npt.NDArray[Any] | None:
        """What all pixels show, ``(H, W)``; None where only edge pixels or columns have a value."""
        if self.dense:
            return self.dense()
        return self.values if self.where in ("mask", "photo") else None

    def __repr__(self) -> str:
        """One line, as a console shows it."""
        shape = " x ".join(map(str, self.values.shape))
        unit = f" in {self.unit}" if self.unit else ""
        return f"Stage({self.name!r}, {shape} {self.values.dtype}{unit}, {self.where})"

    @property
    def name(self) -> str:
        """Its name."""
        return self.quantity.name

    @property
    def about(self) -> str:
        """What it is, in words."""
        return self.quantity.title

    @property
    def unit(self) -> str:
        """The unit of its values; nothing for plain numbers."""
        return self.quantity.unit.strip()

    @property
    def colour_map(self) -> str:
        """Its colour map, see `skyline_viz.colours`."""
        return self.quantity.colour_map


SKY = Quantity(
    "sky",
    low=0.0,
    high=1.0,
    smooth=True,
    about="Sky (probability): bright where seen",
)
EDGES = Quantity("edges", "gray", about="Edges")
STRENGTH = Quantity(
    "strength",
    "inferno",
    " grey levels/px",
    (0.08, 1.0),
    low=0.0,
    about="Gradient strength (grey levels/px)",
    group="tensor",
    tabs=("Stages", "Tensor"),
)
COHERENCE = Quantity(
    "coherence",
    low=0.0,
    high=1.0,
    about="Coherence: bright where all gradients point one way",
    group="tensor",
    tabs=("Tensor",),
)
ORIENTATION = Quantity(
    "orientation",
    "twilight_shifted",
    "°",
    low=0.0,
    high=180.0,
    about="Orientation of the gradient (degrees): dark where it is weak",
    group="tensor",
    tabs=("Tensor",),
)
BIN = Quantity(
    "bin",
    "twilight_shifted",
    about="Bin: hue is orientation (degrees), brighter is stronger",
    tabs=("Tensor",),
)
SCORE = Quantity(
    "score", "blue_grey_red", low=0.0, high=1.0, about="Score: red like skyline, blue not"
)
COST = Quantity(
    "cost",
    "magma_r",
    span=(0.0, 0.88),
    contrast=0.5,
    about="Nodal cost, all terms: bright is cheap",
    word="nodal cost",
)
PATH = Quantity("path", unit=" px", about="Path: row of the skyline", tabs=())
DETOUR = Quantity(
    "detour",
    "magma_r",
    " dearer than the path",
    (0.0, 0.88),
    0.5,
    low=0.0,
    about="Min-marginals (cost): how much dearer the best path through a pixel is",
    tabs=("Search",),
)

FUSED = Quantity(
    "score and strength",
    "magma_r",
    span=(0.0, 0.88),
    low=0.0,
    about="Score and strength (cost): bright is cheap",
    word="score and strength cost",
)
ADDED = Quantity(
    "added",
    "magma_r",
    span=(0.0, 0.88),
    low=0.0,
    about="Clear sky and sky model (cost): bright is cheap",
    group="terms",
    word="clear sky and sky model cost",
)
"""What our own terms come to, which all pixels pay."""

FORWARD = Quantity(
    "forward",
    "magma_r",
    span=(0.0, 0.88),
    contrast=0.5,
    low=0.0,
    about="Forward table (cost): dearer than the cheapest way to its column",
    group="search",
    tabs=("Search",),
    word="way from the left dearer by",
)
BACK = Quantity(
    "back",
    "blue_red",
    unit=" rows",
    about="Back pointers (rows): blue comes from above, red from below",
    group="search",
    tabs=("Search",),
    word="comes from",
)
LINK = Quantity(
    "link",
    "magma_r",
    span=(0.0, 0.88),
    low=0.0,
    about="Link cost of that step: bright is cheap",
    group="search",
    tabs=("Search",),
    word="link costs",
)

OURS = (SKY, EDGES, STRENGTH, COHERENCE, ORIENTATION, BIN, SCORE, FUSED, COST)
"""The stages of our detector that can be laid over the photo, in their order."""


def of_term(name: str) -> Quantity:
    """How a term of the nodal cost is shown as a map."""
    return Quantity(
        name,
        "magma_r",
        span=(0.0, 0.88),
        about=f"{name.capitalize()} (cost): bright is cheap",
        group="terms",
        tabs=("Terms",),
        word=f"{name} costs",
    )
