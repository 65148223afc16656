"""Variations of an example: what other cameras, places and weathers would have made of it."""

from __future__ import annotations

import cv2
import numpy as np

from skyline_viz.arrays import F32
from skyline_viz.sky_training.examples import COLUMNS, ROWS
from skyline_viz.sky_training.layers import Layers


def varied(layers: Layers, size: tuple[int, int], rng: np.random.Generator) -> Layers:
    """A part of a photo as another camera in another weather sees it, and its sky.

    Args:
        layers: Photo ``(ROWS, COLUMNS, 3)`` and sky ``(ROWS, COLUMNS)``, in [0, 1].
        size: Rows and columns of the network's input.
        rng: What is chosen.

    Returns:
        Photo ``(*size, 3)`` and sky ``(*size)``, float32 in [0, 1].
    """
    matrix = _view(size, rng)
    photo, sky = (_seen(image, matrix, size) for image in layers)
    if rng.random() < 0.5:
        photo, sky = photo[:, ::-1], sky[:, ::-1]
    photo = _weather(_light(photo, rng), rng)
    if rng.random() < 0.04:
        photo, sky = _barred(photo, sky, rng)
    if rng.random() < 0.2:
        photo = cv2.GaussianBlur(photo, (0, 0), rng.uniform(0.4, 1.4))
    if rng.random() < 0.35:
        grain = rng.normal(0, rng.uniform(0.005, 0.05), photo.shape).astype(np.float32)
        photo = photo + grain
    return np.clip(photo, 0, 1).astype(np.float32), np.ascontiguousarray(sky, np.float32)


def _view(size: tuple[int, int], rng: np.random.Generator) -> F32:
    """Where the input looks, as an affine map from its pixels to those of the example."""
    rows, columns = size
    high = wide = 1.0
    if rng.random() < 0.65:
        wide, high = rng.uniform(0.3, 1), rng.uniform(0.5, 1)
    down, across = rng.uniform(0, 1 - high) * ROWS, rng.uniform(0, 1 - wide) * COLUMNS
    matrix = np.array(
        [[wide * COLUMNS / columns, 0, across], [0, high * ROWS / rows, down], [0, 0, 1]]
    )
    if rng.random() < 0.35:  # a tilted camera; twice as much, seldom
        angle = np.clip(rng.normal(0, 0.09), -0.35, 0.35)
        stretch = float(np.exp(rng.normal(0, 0.4))) * rows / columns
        sine, cosine = np.sin(angle), np.cos(angle)
        turn = np.array([[cosine, -sine / stretch, 0], [sine * stretch, cosine, 0], [0, 0, 1]])
        middle = np.array([[1, 0, columns / 2], [0, 1, rows / 2], [0, 0, 1]])
        matrix = matrix @ middle @ turn @ np.linalg.inv(middle)
    return matrix[:2].astype(np.float32)


def _seen(image: F32, matrix: F32, size: tuple[int, int]) -> F32:
    seen: F32 = cv2.warpAffine(
        cv2.blur(image, (2, 2)) if abs(matrix[0, 0]) > 1.5 else image,
        matrix,
        size[::-1],
        flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return seen


def _light(photo: F32, rng: np.random.Generator) -> F32:
    """Exposure, contrast, white balance, and now and then no colour at all."""
    if rng.random() < 0.5:
        photo = np.maximum(photo, 0) ** np.float32(rng.uniform(0.55, 1.8))
    if rng.random() < 0.6:
        photo = photo * np.float32(rng.uniform(0.55, 1.4)) + np.float32(rng.uniform(-0.15, 0.15))
    if rng.random() < 0.5:
        photo = photo * rng.uniform(0.78, 1.28, (1, 1, 3)).astype(np.float32)
    if rng.random() < 0.2:
        photo = np.repeat(photo.mean(axis=2, keepdims=True), 3, axis=2)
    elif rng.random() < 0.2:
        grey = photo.mean(axis=2, keepdims=True)
        photo = grey + (photo - grey) * np.float32(rng.uniform(0.2, 1.8))
    return photo


def _weather(photo: F32, rng: np.random.Generator) -> F32:
    """Haze that thickens upwards, and a vignette."""
    rows, columns = photo.shape[:2]
    height = np.linspace(1, 0, rows, dtype=np.float32)[:, None, None]
    if rng.random() < 0.25:
        thick = np.float32(rng.uniform(0.15, 0.75)) * height
        air = rng.uniform(0.55, 1, (1, 1, 3)).astype(np.float32)
        photo = photo * (1 - thick) + air * thick
    if rng.random() < 0.2:
        x, y = np.linspace(-1, 1, columns), np.linspace(-1, 1, rows)
        dark = rng.uniform(0.1, 0.5) * (x[None, :] ** 2 + y[:, None] ** 2) / 2
        photo = photo * (1 - dark[..., None]).astype(np.float32)
    return photo


def _barred(photo: F32, sky: F32, rng: np.random.Generator) -> Layers:
    """With bars of one colour above and below, which belong to sky and terrain."""
    rows = len(photo)
    bar = int(rng.uniform(0.02, 0.16) * rows)
    photo, sky = photo.copy(), sky.copy()
    colour = rng.choice([0.0, 0.0, 1.0, rng.random()])
    photo[:bar], photo[rows - bar :] = colour, colour
    sky[:bar], sky[rows - bar :] = 1, 0
    return photo, sky
