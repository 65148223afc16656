"""Detections that are right or wrong for a known reason, and small data sets of them."""

import cv2
import numpy as np

from skyline_viz.skyline import Skyline


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
