"""A photo of a rugged ridge below a hazy sky, noise, and the two presets."""

import cv2
import numpy as np
import pytest

from skyline_viz.config import DetectorConfig
from skyline_viz.skyline import Skyline

CONFIGS = {"default": DetectorConfig(), "paper": DetectorConfig.paper()}
BOTH = pytest.mark.parametrize("config", CONFIGS.values(), ids=CONFIGS)


def mountains(height=120, width=180, seed=0):
    """Photo of a rugged ridge with rocks below a hazy sky, and its true skyline."""
    rng = np.random.default_rng(seed)
    columns = np.arange(width)
    rows = height * 0.45 + 0.1 * height * np.sin(columns / 19 + seed)
    rows += 0.05 * height * np.sin(columns / 7 + 2 * seed)
    truth = Skyline(np.round(rows))
    sky = np.linspace((110, 150, 220), (200, 215, 235), height)[:, None]
    rocks = cv2.resize(rng.uniform(30, 110, (height // 6, width // 6)), (width, height))
    terrain = rocks[:, :, None] * (1.0, 0.95, 0.8)
    photo = np.where(truth.to_mask(height)[:, :, None], sky, terrain)
    photo = cv2.GaussianBlur(photo, (0, 0), 0.6) + rng.normal(0, 1, photo.shape)
    return np.clip(photo, 0, 255).astype(np.uint8), truth


def random_photo(height, width, seed=0):
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), dtype=np.uint8)
