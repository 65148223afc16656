"""A detection in processor time of one thread, as a multiple of what everybody knows.

OpenCV's Canny runs in several threads, ours in one. So that ratios hold on other machines, all run
in one thread here, in turn, and the fastest of several runs of each counts.
"""

import statistics
from collections.abc import Sequence
from functools import partial
from typing import Any

import cv2
import numpy as np
from skimage.graph import MCP, route_through_array

from benchmarks.table import markdown
from benchmarks.turns import fastest
from skyline_viz import Detector
from skyline_viz.arrays import F32, U8
from skyline_viz.path import shortest_path

PEERS = 3
"""Photos on which the searches of scikit-image run, which take a hundred times as long."""


def measured(photos: Sequence[U8], large: Sequence[U8]) -> str:
    """The table.

    Args:
        photos: Photos of usual size.
        large: Large ones.
    """
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        rows = [
            *_detections("", photos),
            *(row for size, some in _by_size(large).items() for row in _detections(size, some)),
            *_searches(photos[:PEERS]),
        ]
    finally:
        cv2.setNumThreads(threads)
    table = markdown(["processor time of one thread", "median", "smallest", "largest"], rows)
    return f"All in one thread, in turn, the fastest of several runs of each:\n\n{table}"


def _by_size(photos: Sequence[U8]) -> dict[str, list[U8]]:
    found: dict[str, list[U8]] = {}
    for photo in photos:
        megapixels = round(photo[..., 0].size / 1e6)
        found.setdefault(f" of {megapixels} megapixels", []).append(photo)
    return found


def _detections(size: str, photos: Sequence[U8]) -> list[list[str]]:
    """Detections against Canny in grey, and in colour at the thresholds that are used."""
    detector = Detector()
    detector.detect(photos[0])
    grey_ratios, colour_ratios = [], []
    for photo in photos:
        thresholds = detector.detect(photo).thresholds
        grey = cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)
        seconds = fastest(
            {
                "detection": partial(detector.detect, photo),
                "grey": partial(cv2.Canny, grey, 50, 220),
                "colour": partial(cv2.Canny, photo, *thresholds),
            }
        )
        grey_ratios.append(seconds["detection"] / seconds["grey"])
        colour_ratios.append(seconds["detection"] / seconds["colour"])
    return [
        _row(f"a detection{size} / Canny in grey", grey_ratios),
        _row(f"a detection{size} / Canny in colour, at the same thresholds", colour_ratios),
    ]


def _searches(photos: Sequence[U8]) -> list[list[str]]:
    """The searches of scikit-image through the same costs, against a whole detection."""
    detector = Detector()
    found: dict[str, list[float]] = {}
    for photo in photos:
        cost, config = detector.detect(photo).cost, detector.config
        seconds = fastest(
            {
                "": partial(detector.detect, photo),
                "our path search": partial(shortest_path, cost, config.delta, config.link_weight),
                "`route_through_array` of scikit-image": partial(_route, cost),
                "its `MCP`": partial(_mcp, cost),
            },
            repeats=2,
        )
        whole = seconds.pop("")
        for name, taken in seconds.items():
            found.setdefault(f"{name} / a whole detection", []).append(taken / whole)
    return [_row(name, ratios) for name, ratios in found.items()]


def _route(cost: F32) -> Any:  # noqa: ANN401
    """From the left edge to the right one, which it only does from pixel to pixel."""
    padded = np.pad(cost, ((0, 0), (1, 1)), constant_values=1e-6)
    ends = (0, 0), (0, padded.shape[1] - 1)
    return route_through_array(padded, *ends, fully_connected=True, geometric=False)


def _mcp(cost: F32) -> Any:  # noqa: ANN401
    return MCP(cost).find_costs([(row, 0) for row in range(len(cost))])


def _row(name: str, ratios: Sequence[float]) -> list[str]:
    cells = statistics.median(ratios), min(ratios), max(ratios)
    return [name, *(f"{one:.2f}" for one in cells)]
