"""Compiled loops are loaded before the first photo, lest its time include that."""

from functools import cache

import numpy as np

from skyline_viz.detector import Detector


@cache
def warm_up() -> None:
    """Load the compiled loops of this process."""
    photo = np.full((32, 32, 3), 200, np.uint8)
    photo[16:] = 50
    Detector().detect(photo)
