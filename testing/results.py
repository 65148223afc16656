"""Photos that are quick to evaluate, and results made by hand."""

from pathlib import Path

import numpy as np

import skyline_viz as sv
from skyline_viz.evaluation.results import PhotoResult

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
