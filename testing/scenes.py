"""Drawn scenes of which the skyline is known to the pixel: two tones, and what lies over them."""

import cv2
import numpy as np


def two_tones(rows, height, sky, ground):
    """A photo of one colour above a line ``(W,)`` and of another one from it on down."""
    photo = np.empty((height, len(rows), 3), np.uint8)
    photo[:] = sky
    photo[np.arange(height)[:, None] >= np.asarray(rows)[None, :]] = ground
    return photo


def noise(height, width, seed=0):
    """A picture of nothing but grain, which no frame looks like."""
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), dtype=np.uint8)


def framed(picture, colour=(0, 0, 0), *, left=0, right=0, top=0, bottom=0):
    """A picture with bars of a colour around it."""
    return cv2.copyMakeBorder(
        picture, top, bottom, left, right, cv2.BORDER_CONSTANT, value=tuple(map(int, colour))
    )


def written(photo, place, text="Gipfel, 1.8.2014", *, size=0.4, colour=(255, 120, 0)):
    """A photo with a line of text, which begins at a column and a row."""
    return cv2.putText(photo.copy(), text, place, cv2.FONT_HERSHEY_SIMPLEX, size, colour, 1)


def compressed(photo, quality):
    """A photo after a JPEG file of a quality."""
    _, file = cv2.imencode(".jpg", photo[:, :, ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])
    return np.ascontiguousarray(cv2.imdecode(file, cv2.IMREAD_COLOR)[:, :, ::-1])
