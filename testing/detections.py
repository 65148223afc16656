"""Photos for detections that are right, or wrong for a known reason, presets, and results."""

from pathlib import Path

import cv2
import numpy as np
import pytest

import skyline_viz as sv
from skyline_viz.config import DetectorConfig
from skyline_viz.detector import Detector
from skyline_viz.evaluation.results import PhotoResult
from skyline_viz.rendering import render
from skyline_viz.sky_model import SkyModel
from skyline_viz.skyline import Skyline

WITHOUT_SKY = Detector(config=DetectorConfig(sky_weight=0.0))
"""The default without the sky model, for failures that are there to be diagnosed."""


def hazy():
    """The detection of a scene whose ridge is lost in haze, and its truth."""
    scene = render("hazy", 2)
    return WITHOUT_SKY.detect(scene.photo), scene.truth


def flat():
    """A photo with a level ridge in row 60, and its detection, which is right."""
    photo = np.full((120, 300, 3), 200, np.uint8)
    photo[60:] = 60
    return WITHOUT_SKY.detect(photo)


def flat_truth(wrong, by, visible=None):
    """The ridge, off in some columns."""
    rows = np.full(300, 60.0)
    rows[wrong] -= by
    return Skyline(rows=rows, visible=np.ones(300, bool) if visible is None else visible)


def lines_in_the_sky(count):
    """A ridge that fades, and lines above it, the strongest one uppermost."""
    photo = np.full((160, 300, 3), 215, np.uint8)
    photo[120:] = 60
    photo[120:, 80:220] = 165
    for number in range(count):
        row = 30 + 22 * number
        photo[row : row + 8, 60:240] = 20 + 8 * number
        for side in (range(40, 60), range(240, 260)):  # the way there, in steps of a few rows
            for at, column in enumerate(side):
                way = (20 - at if column < 150 else at + 1) / 20
                top = int(row + (110 - row) * way)
                photo[top : top + 8, column] = 20 + 8 * number
    return photo, Skyline(rows=np.full(300, 120.0))


def write_dataset(folder, detection, truth):
    """A plain data set of one photo, a."""
    for name in ("images", "masks"):
        (folder / name).mkdir(parents=True)
    cv2.imwrite(str(folder / "images" / "a.png"), detection.photo[..., ::-1])
    truth.write_csv(folder / "masks" / "a.csv")


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


HEIGHT, WIDTH = 64, 96


def slanting(number: int) -> tuple[np.ndarray, sv.Skyline]:
    """A photo with texture below a slanting line, and the line."""
    rng = np.random.default_rng(number)
    rows = np.round(20 + number + np.arange(WIDTH) * 0.1 * (number % 3))
    truth = sv.Skyline(rows)
    photo = np.full((HEIGHT, WIDTH, 3), (190, 200, 215), np.uint8)
    terrain = rng.integers(20, 110, (HEIGHT, WIDTH, 1), dtype=np.uint8)
    return np.where(truth.to_mask(HEIGHT)[..., None], photo, terrain), truth


def write_slanting(root: Path, count: int = 5) -> tuple[sv.DatasetItem, ...]:
    """A plain data set of such photos, ``p0`` to ``p4``."""
    (root / "images").mkdir(parents=True)
    for number in range(count):
        photo, truth = slanting(number)
        sv.write_photo(root / "images" / f"p{number}.png", photo)
        truth.write_csv(root / "masks" / f"p{number}.csv")
    return sv.open_dataset(root).items


def result(name: str = "a", error: float = 0.0, **changes) -> PhotoResult:
    """A result with such an error."""
    values = {
        "name": name,
        "a_err": error,
        "worst_error": error,
        "worst_column": 0,
        "segmentation_accuracy": 1.0,
        "gross_miss": False,
        "seconds": 0.5,
        "height": 100,
        "width": 10,
    }
    return PhotoResult(**(values | changes))


class NoSky(SkyModel):
    """A sky model that sees terrain everywhere."""

    def sky(self, photo):
        return np.zeros((4, 4), np.float32)


class Halves(SkyModel):
    """A sky model that sees a level line in the middle of the left half, and terrain elsewhere."""

    def sky(self, photo):
        seen = np.zeros((40, 40), np.float32)
        seen[:20, :20] = 1
        return seen


def unseen(kind=NoSky):
    """A detector with such a sky model."""
    return Detector(sky=kind("blind", b""), label="blind")


def half_a_line(height=120, width=160):
    """A photo with a level line in the middle of its left half, and terrain in greys elsewhere.

    It gets darker to the right, for what is of one grey is a bar beside the picture. Two lines of
    dots below keep the line from being the only edge there is.
    """
    greys = np.linspace(100, 40, width).astype(np.uint8)
    photo = np.repeat(np.broadcast_to(greys, (height, width))[..., None], 3, axis=2)
    photo[: height // 2, : width // 2] = 210
    for row in (height // 2 + 20, height // 2 + 40):
        photo[row : row + 4, ::8] = 250
    return photo
