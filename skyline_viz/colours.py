"""The project's colours: lines, and colour maps of values, the same wherever they are shown."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

import cv2
import numpy as np
import numpy.typing as npt

from skyline_viz.arrays import U8, read_only

if TYPE_CHECKING:
    from skyline_viz.bins import Bins

Colour: TypeAlias = tuple[int, int, int]

PATH: Colour = (0xFF, 0x2D, 0x95)
"""Magenta: the detected skyline."""

TRUTH: Colour = (0x00, 0xD1, 0xB2)
"""Turquoise: the truth."""

ALTERNATIVE: Colour = (0xFF, 0xD4, 0x00)
"""Yellow: another line to compare with."""

ANCHOR: Colour = (0xFF, 0xFF, 0xFF)
"""White: pixels that an annotator has fixed."""

HALO: Colour = (20, 20, 20)
"""What surrounds a line, so that it reads on snow as well as on rock."""

_UNIFORM = {
    "viridis": cv2.COLORMAP_VIRIDIS,
    "inferno": cv2.COLORMAP_INFERNO,
    "magma": cv2.COLORMAP_MAGMA,
    "twilight_shifted": cv2.COLORMAP_TWILIGHT_SHIFTED,
}

_BLUE_TO_RED = (
    "053061", "2166AC", "4393C3", "92C5DE", "D1E5F0", "F7F7F7",
    "FDDBC7", "F4A582", "D6604D", "B2182B", "67001F",
)  # fmt: skip  # ColorBrewer's RdBu, which colour-vision deficiency leaves two-sided

_DIVERGING = {
    "blue_red": _BLUE_TO_RED,
    "blue_grey_red": (
        "3B6FD4", "5B84C8", "7A93B4", "8E959C", "8C8C8C", "9C8F8A", "BB8478", "DC6E5E", "FF5040",
    ),
    "blue_or_red": (  # as RdBu, the other way round in brightness: alike is as dark as the back
        "B9DDF9", "7DBBEE", "4596DB", "2670B0", "1E4C79", "141414",
        "7E2B1E", "B84A31", "E2714F", "F6A383", "FCD7C5",
    ),
}  # fmt: skip


@lru_cache(maxsize=16)
def colour_map(name: str) -> U8:
    """A colour map as a table ``(256, 3)`` uint8 RGB.

    ``viridis``, ``inferno`` and ``magma`` are perceptually uniform, ``twilight_shifted`` is cyclic,
    ``blue_red`` has white in its middle; for black backgrounds ``blue_grey_red`` has grey, so that
    red is the brightest, and ``blue_or_red`` black; ``gray`` is what it says. The ending ``_r``
    turns a map round.

    >>> colour_map("blue_red")[[0, 255]].tolist()
    [[5, 48, 97], [103, 0, 31]]

    Raises:
        KeyError: There is no such map.
    """
    if name.endswith("_r"):
        table = colour_map(name[:-2])[::-1].copy()
    elif name in _DIVERGING:
        anchors = np.array([[*bytes.fromhex(one)] for one in _DIVERGING[name]])
        places = np.linspace(0, len(anchors) - 1, 256)
        between = [np.interp(places, np.arange(len(anchors)), one) for one in anchors.T]
        table = np.rint(np.stack(between, axis=1)).astype(np.uint8)
    elif name == "gray":
        table = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)
    else:
        steps = np.arange(256, dtype=np.uint8)[:, None]
        table = cv2.applyColorMap(steps, _UNIFORM[name])[:, 0, ::-1].copy()
    read_only(table)
    return table


def coloured(name: str, values: npt.NDArray[np.floating]) -> U8:
    """Colours ``(..., 3)`` uint8 RGB of values in [0, 1]; those beyond take the end's colour."""
    colours: U8 = colour_map(name)[np.clip(values * 256, 0, 255).astype(np.uint8)]
    return colours


@lru_cache(maxsize=4)
def bin_legend(bins: Bins) -> tuple[tuple[str, Colour], ...]:
    """Words and colour of each bin: its orientation as a hue, brighter with strength."""
    hues = coloured("twilight_shifted", np.arange(bins.orientations) / bins.orientations)
    legend = []
    for index in range(bins.count):
        row, orientation = divmod(index, bins.orientations)
        strength = row % bins.strengths
        bright = 0.55 + 0.45 * strength / max(bins.strengths - 1, 1)
        red, green, blue = (int(bright * one) for one in hues[orientation].tolist())
        legend.append((bins.label(index), (red, green, blue)))
    return tuple(legend)
