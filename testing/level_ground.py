"""Pictures of level ground under a grey sky, for what is drawn over them."""

import numpy as np

from skyline_viz.rendering.noise import Noise
from skyline_viz.rendering.picture import Picture
from skyline_viz.rendering.terrain import Frame, Light

FRAME = Frame(120, 80)
SUN = Light((0.6, 0.0, 0.8), (1.0, 1.0, 1.0), (0.2, 0.2, 0.2), (0.6, 0.6, 0.6))
SKY = 0.7
HORIZON = 40


def level(horizon: int = HORIZON) -> Picture:
    """A picture with ground of 0.3 from a row on."""
    picture = Picture.of(FRAME, np.full((80, 120, 3), SKY, np.float32))
    share = np.broadcast_to(np.float32(np.arange(80)[:, None] >= horizon), (80, 120))
    picture.paint(share, np.full(3, 0.3, np.float32), "terrain")
    return picture


def noise(seed: int = 1) -> Noise:
    """Noise of a seed."""
    return Noise(np.random.default_rng(seed))


def dice(seed: int = 1) -> np.random.Generator:
    """Dice of a seed."""
    return np.random.default_rng(seed)
