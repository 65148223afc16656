"""Second opinions: what two other detectors find, where the proposal follows a wrong ridge.

A detector whose costs lead it along a wrong ridge often has no trace of the right one in them. Two
extremes err elsewhere: one that trusts the sky model, and one that trusts edges alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from skyline_viz import Detector, DetectorConfig
from skyline_viz.arrays import U8, Int
from skyline_viz.method import Method

TRUST = 3.0
"""How much more the sky model counts than in the default, where it is trusted."""


def detectors(proposer: Method) -> list[Detector]:
    """The two detectors, with filters and sky model of what proposes, where it has some."""
    ours = proposer if isinstance(proposer, Detector) else Detector()
    default = DetectorConfig()
    trust = {"sky_weight": TRUST * default.sky_weight, "sky_cap": TRUST * default.sky_cap}
    edges = {"sky_weight": 0.0, "clear_sky": 0.0}
    return [replace(ours, config=default.with_settings(one), label="") for one in (trust, edges)]


def opinions(proposer: Method, photo: U8) -> Iterator[Int]:
    """Rows ``(W,)`` of the lines that the two find.

    Args:
        proposer: What made the proposal.
        photo: ``(H, W, 3)`` uint8 RGB.
    """
    for detector in detectors(proposer):
        yield detector.detect(photo).skyline.pixel_rows(len(photo)).astype(np.int32)
