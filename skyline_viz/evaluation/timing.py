"""How long methods take for one photo, all in one run on one machine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter

import cv2

from skyline_viz.arrays import U8
from skyline_viz.method import Method

SIZE = (519, 1388)
"""Rows and columns of the photo, as in the paper's Table VI."""

TIMES = 3
"""Detections of each method, the fastest of which counts; one more goes before, unmeasured."""


@dataclass(frozen=True)
class Timing:
    """Time of a method."""

    name: str
    """Its name."""

    seconds: float
    """Of one detection."""


def time_methods(methods: Mapping[str, Method], photo: U8) -> list[Timing]:
    """Time methods on one core; the rounds go through all methods, so that all share the noise.

    Args:
        methods: The methods by name.
        photo: ``(H, W, 3)`` uint8 RGB; brought to `SIZE` where it has another one.
    """
    if photo.shape[:2] != SIZE:
        photo = cv2.resize(photo, SIZE[::-1], interpolation=cv2.INTER_AREA)
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        fastest = dict.fromkeys(methods, float("inf"))
        for method in methods.values():
            method.detect(photo)
        for _ in range(TIMES):
            for name, method in methods.items():
                start = perf_counter()
                method.detect(photo)
                fastest[name] = min(fastest[name], perf_counter() - start)
    finally:
        cv2.setNumThreads(threads)
    return [Timing(name, seconds) for name, seconds in fastest.items()]
