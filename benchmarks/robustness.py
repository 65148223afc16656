"""How the detector holds on photos unlike those it was trained on.

The real photographs, changed as other cameras and places would: each is tested with a filter bank
trained on the unchanged photographs of the other fold. A_err is scaled to a height of 519 rows.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from benchmarks.table import markdown
from skyline_viz import (
    Detector,
    DetectorConfig,
    Skyline,
    TrainingConfig,
    a_err,
    is_gross_miss,
    open_dataset,
    train,
)
from skyline_viz.arrays import U8
from skyline_viz.sky_model import SkyModel

HEIGHT = 519
Labelled = tuple[U8, Skyline]


def resized(example: Labelled, width: int, height: int) -> Labelled:
    """The photo squeezed or stretched to another size, which changes its slopes."""
    photo, truth = example
    smaller = width < photo.shape[1]
    how = cv2.INTER_AREA if smaller else cv2.INTER_CUBIC
    centres = (np.arange(width) + 0.5) * (truth.width / width) - 0.5
    rows = np.interp(centres, np.arange(truth.width), truth.rows) * (height / len(photo))
    nearest = np.clip(np.rint(centres).astype(int), 0, truth.width - 1)
    changed = cv2.resize(photo, (width, height), interpolation=how)
    return changed, Skyline(rows=rows.astype(np.float32), visible=truth.visible[nearest])


def cropped(example: Labelled, index: int) -> Labelled:
    """A square of the photo: its left, middle or right."""
    photo, truth = example
    left = (0, 434, 869)[index % 3]
    part = slice(left, left + len(photo))
    return photo[:, part].copy(), Skyline(rows=truth.rows[part], visible=truth.visible[part])


def little_sky(example: Labelled) -> Labelled:
    """All but the lowest 40 rows of the sky cut off."""
    photo, truth = example
    top = max(0, int(truth.rows.min()) - 40)
    return photo[top:].copy(), Skyline(rows=truth.rows - top, visible=truth.visible)


def little_terrain(example: Labelled) -> Labelled:
    """All but the highest 60 rows of the terrain cut off."""
    photo, truth = example
    return photo[: int(truth.rows.max()) + 60].copy(), truth


def toned(example: Labelled, change: Callable[[U8], U8]) -> Labelled:
    """The photo with other values, the line where it was."""
    return change(example[0]), example[1]


def _noisy(photo: U8) -> U8:
    noise = np.random.default_rng(0).normal(0, 8, photo.shape)
    return np.clip(photo + noise, 0, 255).astype(np.uint8)


def _flat(photo: U8) -> U8:
    return np.clip((photo.astype(np.float32) - 128) * 0.6 + 128, 0, 255).astype(np.uint8)


def _grey(photo: U8) -> U8:
    return np.repeat(cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)[:, :, None], 3, axis=2)


VARIATIONS: dict[str, Callable[[Labelled, int], Labelled]] = {
    "as they are": lambda example, _: example,
    "squeezed to 519x519: slopes 2.7 times steeper": lambda example, _: resized(example, 519, 519),
    "squeezed to 350x519: 4 times steeper": lambda example, _: resized(example, 350, 519),
    "stretched to 519x800: 4 times steeper": lambda example, _: resized(example, 519, 800),
    "a square cut out": cropped,
    "half the size": lambda example, _: resized(example, 694, 260),
    "one and a half times the size": lambda example, _: resized(example, 2082, 778),
    "little sky": lambda example, _: little_sky(example),
    "little terrain": lambda example, _: little_terrain(example),
    "in grey": lambda example, _: toned(example, _grey),
    "contrast x 0.6": lambda example, _: toned(example, _flat),
    "noise, sigma 8": lambda example, _: toned(example, _noisy),
    "out of focus, sigma 1.5": lambda example, _: toned(
        example, lambda photo: cv2.GaussianBlur(photo, (0, 0), 1.5)
    ),
}


PRESETS = {
    "`paper()`": DetectorConfig.paper(),
    "`paper()`, delta 4, link 0.1": replace(DetectorConfig.paper(), delta=4, link_weight=0.1),
    "default": DetectorConfig(),
}


def varied(web: Path, sky: SkyModel) -> str:
    """The published method, the same on steeper paths, and the default under every variation.

    Args:
        web: Folder of the Web photographs.
        sky: A sky model that has not seen them.
    """
    items = [item for item in open_dataset(web) if item.truth_path]
    examples = [(item.photo(), item.truth()) for item in items]
    rows = {name: [name] for name in VARIATIONS}
    for config in PRESETS.values():
        training = TrainingConfig.of(config)
        detectors = [
            Detector(train(examples[1 - fold :: 2], config=training), config, sky=sky)
            for fold in (0, 1)
        ]
        for name, vary in VARIATIONS.items():
            errors = []
            for index, example in enumerate(examples):
                photo, truth = vary(example, index)
                found = detectors[index % 2].detect(photo).skyline
                errors.append(a_err(found, truth) * HEIGHT / len(photo))
            gross = sum(is_gross_miss(error, HEIGHT) for error in errors)
            rows[name] += [
                f"{np.mean(errors):.2f}",
                f"{np.median(errors):.2f}",
                f"{sum(error < 4 for error in errors)}/{len(errors)}",
                str(gross),
            ]
    header = ["A_err in px at 519 rows"]
    for preset in PRESETS:
        header += [f"{preset} mean", "median", "< 4 px", "gross"]
    return f"## The same photographs, changed\n\n{markdown(header, rows.values())}"
