"""Draw what the skyline is, for the page and the docs: python -m tools.guideline_pictures."""

from pathlib import Path

import cv2
import numpy as np
from PIL import Image

from skyline_viz.overlay import draw_overlay
from skyline_viz.rendering.scenes import render

ROOT = Path(__file__).parents[1]
PLACE = ROOT / "annotate" / "static" / "guideline"
SHEET = ROOT / "docs" / "guideline.jpg"

SCENES = {
    "trees": ("conifers", 1, "plain"),
    "houses": ("village", 4, "plain"),
    "people": ("hikers", 2, "plain"),
    "masts": ("village", 1, "plain"),
    "cloud": ("banks", 25, "plain"),
    "fog": ("blue", 5, "plain"),
    "water": ("lake", 2, "plain"),
    "frame": ("cloudy", 19, "any"),
}
"""Kind, seed and camera of each picture."""

WIDTH, HEIGHT = 400, 250
VEIL = 0.45  # of a hidden column


def drawn(kind, seed, camera):
    """A rendered scene with its true line, and a grey band where that is hidden."""
    scene = render(kind, seed, WIDTH, HEIGHT, camera=camera)
    picture = draw_overlay(scene.photo, scene.truth).astype(np.float32)
    hidden = ~scene.truth.visible
    picture[:, hidden] = (1 - VEIL) * picture[:, hidden] + VEIL * 128
    return np.rint(picture).astype(np.uint8)


def main():
    """Write each picture, and a sheet of all."""
    cv2.setNumThreads(1)
    PLACE.mkdir(exist_ok=True)
    pictures = [drawn(*scene) for scene in SCENES.values()]
    for name, picture in zip(SCENES, pictures, strict=True):
        Image.fromarray(picture).save(PLACE / f"{name}.jpg", quality=80, optimize=True)
    half = len(pictures) // 2
    rows = [np.hstack(pictures[:half]), np.hstack(pictures[half:])]
    Image.fromarray(np.vstack(rows)).save(SHEET, quality=80, optimize=True)
    print(PLACE, SHEET)


if __name__ == "__main__":
    main()
