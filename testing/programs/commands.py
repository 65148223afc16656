"""A small data set of photos with texture below a slanting line, and commands run on it."""

import os
import subprocess
import sys

import numpy as np

import skyline_viz as sv
from testing import ROOT

HEIGHT, WIDTH = 64, 96


def scene(number):
    """A photo with texture below a slanting line, and the line."""
    rng = np.random.default_rng(number)
    rows = np.round(20 + number + np.arange(WIDTH) * 0.1 * (number % 3))
    truth = sv.Skyline(rows)
    photo = np.full((HEIGHT, WIDTH, 3), (190, 200, 215), np.uint8)
    terrain = rng.integers(20, 110, (HEIGHT, WIDTH, 1), dtype=np.uint8)
    return np.where(truth.to_mask(HEIGHT)[..., None], photo, terrain), truth


def write_scene(path, number=0):
    sv.write_photo(path, scene(number)[0])
    return path


def write_scenes(root, count):
    """A plain data set: photos ``p0.png`` and so on, each with its truth."""
    for number in range(count):
        write_scene(root / "images" / f"p{number}.png", number)
        scene(number)[1].write_csv(root / "masks" / f"p{number}.csv")
    return root


def program(*words, **options):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "skyline_viz", *map(str, words)]
    return subprocess.run(  # noqa: PLW1510  # the status is what is tested
        command, capture_output=True, text=True, env=environment, timeout=120, **options
    )


def files(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def write_flat(root, count):
    """A plain data set of level ground, one row lower in each photo; all truths are row 21."""
    for number in range(count):
        photo = np.full((50, 60, 3), 200, np.uint8)
        photo[20 + number :] = 60
        sv.write_photo(root / "images" / f"h{number}.png", photo)
        sv.Skyline(np.full(60, 21.0)).write_csv(root / "masks" / f"h{number}.csv")
    return root
