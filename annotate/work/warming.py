"""What the first gesture would have to wait for, done while the page is being opened."""

from functools import cache

import numpy as np

from annotate.engine.live_wire import LiveWire
from skyline_viz.detector import Detector
from skyline_viz.running import warming


@cache
def warm_up() -> None:
    """Load the compiled loops of guides, clicks and other lines, or compile and keep them."""
    warming.warm_up()
    photo = np.full((48, 64, 3), 200, np.uint8)
    photo[16:] = 120
    photo[32:] = 50
    wire = LiveWire(photo, Detector())
    wire.preview_guide([(2, 30), (60, 32)])
    wire.preview(32, 32, within=2)
    wire.alternatives()
    wire.refresh()
